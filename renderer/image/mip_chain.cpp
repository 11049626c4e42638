// SPDX-License-Identifier: MIT
#include "renderer/image/mip_chain.h"

#include <array>

#include "renderer/image/tone.h"

namespace candela {

namespace {

// Linear light in 16 bits: finer than sRGB bytes lie, even at black, where they are 1/3294 apart.
constexpr uint32_t linear_max = 65535;

std::array<uint16_t, 256> make_linear_table() {
    std::array<uint16_t, 256> table{};
    for (size_t i = 0; i < table.size(); ++i) {
        const float linear = linear_from_srgb(static_cast<float>(i) / 255.0f);
        table[i] = static_cast<uint16_t>(std::lround(linear * static_cast<float>(linear_max)));
    }
    return table;
}

// The nearest sRGB byte of every 16th linear value.
std::array<uint8_t, 4096> make_srgb_table() {
    std::array<uint8_t, 4096> table{};
    for (size_t i = 0; i < table.size(); ++i) {
        const float linear = (static_cast<float>(i) + 0.5f) / 4096.0f;
        table[i] = static_cast<uint8_t>(std::lround(255.0f * srgb_from_linear(linear)));
    }
    return table;
}

const std::array<uint16_t, 256> linear_table = make_linear_table();
const std::array<uint8_t, 4096> srgb_table = make_srgb_table();

// The sum of texels times their shares; its mean.
struct TexelSum {
    uint64_t r = 0, g = 0, b = 0, a = 0, weight = 0, color_weight = 0;

    void add(const Rgba8& p, uint64_t share, MipColors colors) {
        const uint64_t color_share = colors == MipColors::alpha_weighted ? share * p.a : share;
        r += color_share * linear_table[p.r];
        g += color_share * linear_table[p.g];
        b += color_share * linear_table[p.b];
        a += share * p.a;
        color_weight += color_share;
        weight += share;
    }
    Rgba8 mean() const {
        const uint64_t divisor = std::max<uint64_t>(color_weight, 1);
        return {srgb_table[r / divisor >> 4], srgb_table[g / divisor >> 4], srgb_table[b / divisor >> 4],
                static_cast<uint8_t>((a + weight / 2) / weight)};
    }
};

// Which texels of a row of `from` texels the texel i of `to` covers, and how much of each, in units of 1/to of a texel.
struct Cover {
    int first = 0, last = 0;
    std::array<uint64_t, 3> share{};
};

Cover cover_of(int i, int from, int to) {
    Cover out;
    const int begin = i * from, end = (i + 1) * from;
    out.first = begin / to;
    out.last = (end - 1) / to;
    for (int k = out.first; k <= out.last; ++k) {
        out.share[static_cast<size_t>(k - out.first)] =
            static_cast<uint64_t>(std::min(end, (k + 1) * to) - std::max(begin, k * to));
    }
    return out;
}

void halve_row(const ImageRgba8& from, ImageRgba8& to, int y, MipColors colors) {
    // Two by two texels weigh the same; odd sizes share texels between neighbours.
    const Cover rows = cover_of(y, from.height(), to.height());
    for (int x = 0; x < to.width(); ++x) {
        const Cover columns = cover_of(x, from.width(), to.width());
        TexelSum sum, plain;
        for (int j = rows.first; j <= rows.last; ++j) {
            for (int i = columns.first; i <= columns.last; ++i) {
                const uint64_t share = rows.share[static_cast<size_t>(j - rows.first)] *
                                       columns.share[static_cast<size_t>(i - columns.first)];
                sum.add(from(i, j), share, colors);
                if (colors == MipColors::alpha_weighted) plain.add(from(i, j), share, MipColors::plain);
            }
        }
        // Where nothing is opaque, the colour does not matter, but it is kept.
        to(x, y) = sum.color_weight == 0 ? plain.mean() : sum.mean();
    }
}

// Two by two texels of equal shares: the same numbers as halve_row has.
Rgba8 mean_of_four(const Rgba8& p, const Rgba8& q, const Rgba8& r, const Rgba8& s) {
    const auto color = [&](int c) {
        const uint32_t sum =
            uint32_t{linear_table[p[c]]} + linear_table[q[c]] + linear_table[r[c]] + linear_table[s[c]];
        return srgb_table[sum >> 6];
    };
    const uint32_t alpha = uint32_t{p.a} + q.a + r.a + s.a;
    return {color(0), color(1), color(2), static_cast<uint8_t>((alpha + 2) >> 2)};
}

Rgba8 weighted_mean_of_four(const Rgba8& p, const Rgba8& q, const Rgba8& r, const Rgba8& s) {
    const uint32_t alpha = uint32_t{p.a} + q.a + r.a + s.a;
    if (alpha == 0 || alpha == 4 * 255) return mean_of_four(p, q, r, s);
    const auto color = [&](int c) {
        const uint32_t sum = uint32_t{p.a} * linear_table[p[c]] + uint32_t{q.a} * linear_table[q[c]] +
                             uint32_t{r.a} * linear_table[r[c]] + uint32_t{s.a} * linear_table[s[c]];
        return srgb_table[sum / alpha >> 4];
    };
    return {color(0), color(1), color(2), static_cast<uint8_t>((alpha + 2) >> 2)};
}

void halve_even_row(const ImageRgba8& from, ImageRgba8& to, int y, MipColors colors) {
    const Rgba8* upper = &from(0, 2 * y);
    const Rgba8* lower = &from(0, 2 * y + 1);
    const bool weighted = colors == MipColors::alpha_weighted;
    for (int x = 0; x < to.width(); ++x) {
        const Rgba8 &p = upper[2 * x], &q = upper[2 * x + 1], &r = lower[2 * x], &s = lower[2 * x + 1];
        to(x, y) = weighted ? weighted_mean_of_four(p, q, r, s) : mean_of_four(p, q, r, s);
    }
}

}  // namespace

std::vector<ImageRgba8> make_mip_chain(const ImageRgba8& image, MipColors colors) {
    std::vector<ImageRgba8> levels;
    const ImageRgba8* from = &image;
    while (from->width() > 1 || from->height() > 1) {
        ImageRgba8 to = ImageRgba8::unfilled(std::max(from->width() / 2, 1), std::max(from->height() / 2, 1));
        const bool even = from->width() % 2 == 0 && from->height() % 2 == 0;
        for (int y = 0; y < to.height(); ++y) {
            if (even) {
                halve_even_row(*from, to, y, colors);
            } else {
                halve_row(*from, to, y, colors);
            }
        }
        levels.push_back(std::move(to));
        from = &levels.back();
    }
    return levels;
}

}  // namespace candela
