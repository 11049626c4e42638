// SPDX-License-Identifier: MIT
// Pictures of how far each pixel has come. One difference of replicates is a poor estimate, so that errors are pooled
// over 5 × 5 pixels.
#include "renderer/film/replicates.h"

namespace candela {

namespace {

constexpr uint32_t reach = 2;

// Sums over the square around each pixel, and how many went into them.
struct Pooled {
    std::vector<float> sums, counts;
    // Negative where there is none.
    float mean(size_t i) const { return counts[i] > 0 ? sums[i] / counts[i] : -1.0f; }
};

// For rows [row_begin, row_end) of what read(y, values) says of a row; negative values are unknown and left out.
template <typename Read>
Pooled pool(Vec2u extent, uint32_t row_begin, uint32_t row_end, Read&& read) {
    const uint32_t width = extent.x;
    Pooled out;
    out.sums.resize(size_t{row_end - row_begin} * width);
    out.counts.resize(out.sums.size());
    std::vector<float> values(width);
    const uint32_t first = row_begin > reach ? row_begin - reach : 0, last = std::min(row_end + reach, extent.y);
    for (uint32_t y = first; y < last; ++y) {
        // Each row is read once, pooled along itself, and added to the rows that it reaches.
        read(y, std::span(values));
        const uint32_t to_begin = std::max(y > reach ? y - reach : 0, row_begin);
        const uint32_t to_end = std::min(y + reach + 1, row_end);
        for (uint32_t x = 0; x < width; ++x) {
            float sum = 0, count = 0;
            for (uint32_t u = x > reach ? x - reach : 0; u < std::min(x + reach + 1, width); ++u) {
                if (values[u] < 0) continue;
                sum += values[u];
                count += 1;
            }
            for (uint32_t to = to_begin; to < to_end; ++to) {
                out.sums[size_t{to - row_begin} * width + x] += sum;
                out.counts[size_t{to - row_begin} * width + x] += count;
            }
        }
    }
    return out;
}

}  // namespace

void map_rows(const Film& film, double mean_luminance, uint32_t row_begin, uint32_t row_end, Frame& frame) {
    const uint32_t width = film.extent().x;
    const Pooled error = pool(film.extent(), row_begin, row_end, [&](uint32_t y, std::span<float> values) {
        relative_half_differences(film, mean_luminance, y, values);
    });
    for (uint32_t y = row_begin; y < row_end; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            const FilmPixel& pixel = film.at({x, y});
            const auto traced = static_cast<float>(std::max(pixel.count + pixel.non_finite, 1u));
            const auto segments = static_cast<float>(pixel.segments);
            frame.maps(static_cast<int>(x), static_cast<int>(y)) =
                Vec4(error.mean(size_t{y - row_begin} * width + x), static_cast<float>(pixel.count),
                     (segments + static_cast<float>(pixel.shadow_rays)) / traced, segments / traced);
        }
    }
}

std::vector<float> standard_error_map(const Film& film) {
    const uint32_t width = film.extent().x;
    const Pooled squares = pool(film.extent(), 0, film.extent().y, [&](uint32_t y, std::span<float> values) {
        for (uint32_t x = 0; x < width; ++x) {
            const float half = half_difference(film.at({x, y}));
            values[x] = half < 0 ? half : half * half;
        }
    });
    std::vector<float> out(squares.sums.size());
    for (size_t i = 0; i < out.size(); ++i) {
        const float mean = squares.mean(i);
        out[i] = mean < 0 ? std::numeric_limits<float>::quiet_NaN() : std::sqrt(mean);
    }
    return out;
}

}  // namespace candela
