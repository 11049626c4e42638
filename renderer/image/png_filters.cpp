// SPDX-License-Identifier: MIT
#include "renderer/image/png_filters.h"

#include <array>
#include <bit>
#include <cstring>
#include <vector>

namespace candela {

namespace {

using Bytes4 = std::array<uint8_t, 4>;
// Two pixels of four channels: sums and differences of bytes do not overflow.
using Bytes8 [[gnu::vector_size(8)]] = uint8_t;
using Lanes8 [[gnu::vector_size(16)]] = int16_t;

enum Filter : uint8_t { none, sub, up, average, paeth };

// One row or a pair of them, pixel by pixel; `channels` of a pixel are stored, the fourth is its alpha.
template <size_t channels>
struct Rows {
    static constexpr uint8_t opaque = channels == 3 ? 255 : 0;

    static Bytes4 load(const uint8_t* pixel) {
        Bytes4 out;
        std::memcpy(&out, pixel, sizeof(out));
        return out;
    }
    static Bytes4 load(const Rgba8* pixel) { return load(&pixel->r); }

    static Lanes8 widen(Bytes4 first, Bytes4 second) {
        return __builtin_convertvector((std::bit_cast<Bytes8>(std::array{first, second})), Lanes8);
    }
    static std::array<Bytes4, 2> narrow(Lanes8 pixels) {
        return std::bit_cast<std::array<Bytes4, 2>>(__builtin_convertvector(pixels, Bytes8));
    }
    static void store(Rgba8* pixel, Bytes4 value) {
        value[3] |= opaque;
        std::memcpy(pixel, &value, sizeof(value));
    }

    static Lanes8 magnitude(Lanes8 x) { return x < 0 ? -x : x; }

    // Whichever of a (left), b (above) and c (above left) is nearest to a + b - c; the first of equals.
    static Lanes8 paeth_predictor(Lanes8 a, Lanes8 b, Lanes8 c) {
        const Lanes8 from_a = b - c, from_b = a - c;
        const Lanes8 pa = magnitude(from_a), pb = magnitude(from_b), pc = magnitude(from_a + from_b);
        const Lanes8 b_or_c = pb <= pc ? b : c;
        const auto a_is_nearest = (pa <= pb) & (pa <= pc);
        return a_is_nearest ? a : b_or_c;
    }

    template <typename Predict>
    static void unfilter(const uint8_t* row, const Rgba8* above, size_t width, Rgba8* out, Predict predict) {
        Lanes8 a{}, c{};
        for (size_t x = 0; x < width; ++x) {
            const Lanes8 b = widen(load(above + x), Bytes4{});
            a = (widen(load(row + channels * x), Bytes4{}) + predict(a, b, c)) & 255;
            c = b;
            store(out + x, narrow(a)[0]);
        }
    }

    // Each pixel waits for the one before it: so two rows go at once, the lower one pixel behind the upper, which is
    // above it then.
    static void unfilter_paeth_pair(const uint8_t* upper, const uint8_t* lower, const Rgba8* above, size_t width,
                                    Rgba8* out) {
        Lanes8 a{}, c{};
        const auto advance = [&](Bytes4 above_upper, Bytes4 from_upper, Bytes4 from_lower) {
            const Lanes8 b = __builtin_shufflevector(widen(above_upper, Bytes4{}), a, 0, 1, 2, 3, 8, 9, 10, 11);
            a = (widen(from_upper, from_lower) + paeth_predictor(a, b, c)) & 255;
            c = b;
            return narrow(a);
        };
        Rgba8* out_lower = out + width;
        store(out, advance(load(above), load(upper), Bytes4{})[0]);
        for (size_t x = 1; x < width; ++x) {
            const std::array<Bytes4, 2> pixels =
                advance(load(above + x), load(upper + channels * x), load(lower + channels * (x - 1)));
            store(out + x, pixels[0]);
            store(out_lower + x - 1, pixels[1]);
        }
        store(out_lower + width - 1, advance(Bytes4{}, Bytes4{}, load(lower + channels * (width - 1)))[1]);
    }

    static bool unfilter_all(const uint8_t* rows, size_t width, size_t height, Rgba8* out) {
        const std::vector<Rgba8> nothing(width, Rgba8(0));
        const Rgba8* above = nothing.data();
        const size_t row_bytes = 1 + channels * width;
        for (size_t y = 0; y < height; ++y) {
            const uint8_t* row = rows + y * row_bytes + 1;
            Rgba8* to = out + y * width;
            const auto by = [&](auto predict) { unfilter(row, above, width, to, predict); };
            switch (row[-1]) {
                case none:
                    by([](Lanes8, Lanes8, Lanes8) { return Lanes8{}; });
                    break;
                case sub:
                    by([](Lanes8 a, Lanes8, Lanes8) { return a; });
                    break;
                case up:
                    by([](Lanes8, Lanes8 b, Lanes8) { return b; });
                    break;
                case average:
                    by([](Lanes8 a, Lanes8 b, Lanes8) { return (a + b) >> 1; });
                    break;
                case paeth:
                    if (y + 1 < height && row[row_bytes - 1] == paeth) {
                        unfilter_paeth_pair(row, row + row_bytes, above, width, to);
                        to += width;
                        ++y;
                    } else {
                        by(paeth_predictor);
                    }
                    break;
                default:
                    return false;
            }
            above = to;
        }
        return true;
    }
};

}  // namespace

bool unfilter_rows(const uint8_t* rows, size_t channels, size_t width, size_t height, Rgba8* out) {
    return channels == 3 ? Rows<3>::unfilter_all(rows, width, height, out)
                         : Rows<4>::unfilter_all(rows, width, height, out);
}

}  // namespace candela
