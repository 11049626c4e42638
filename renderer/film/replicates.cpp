// SPDX-License-Identifier: MIT
#include "renderer/film/replicates.h"

namespace candela {

namespace {

struct Range {
    float low, high;
};

// The third smallest and the third largest of nine.
Range inner_range(std::array<float, 9> v) noexcept {
    // A sorting network of 25 exchanges (Knuth, The Art of Computer Programming 3, section 5.3.4).
    constexpr uint8_t exchanges[][2] = {{0, 1}, {3, 4}, {6, 7}, {1, 2}, {4, 5}, {7, 8}, {0, 1}, {3, 4}, {6, 7},
                                        {0, 3}, {3, 6}, {0, 3}, {1, 4}, {4, 7}, {1, 4}, {2, 5}, {5, 8}, {2, 5},
                                        {1, 3}, {5, 7}, {2, 6}, {4, 6}, {2, 4}, {2, 3}, {5, 6}};
    for (const auto& [i, j] : exchanges) {
        const float small = std::min(v[i], v[j]);
        v[j] = std::max(v[i], v[j]);
        v[i] = small;
    }
    return {v[2], v[6]};
}

}  // namespace

void relative_half_differences(const Film& film, double mean_luminance, uint32_t y, std::span<float> out) noexcept {
    const uint32_t width = film.extent().x, height = film.extent().y;
    const uint32_t rows[3] = {y > 0 ? y - 1 : 0, y, std::min(y + 1, height - 1)};
    const auto floor = static_cast<float>(error_floor * mean_luminance);

    // Means of the three columns around a pixel; the one that is new replaces the oldest.
    std::array<float, 9> around{};
    const auto read_column = [&](uint32_t x, size_t slot) {
        for (size_t i = 0; i < 3; ++i)
            around[3 * slot + i] = mean_of(film.at({x, rows[i]}));
    };
    read_column(0, 2);
    read_column(0, 0);
    for (uint32_t x = 0; x < width; ++x) {
        read_column(std::min(x + 1, width - 1), (x + 1) % 3);
        const FilmPixel& pixel = film.at({x, y});
        const float half = half_difference(pixel);
        if (half <= 0.0f) {
            out[x] = half;
            continue;
        }
        // The pixel's own mean goes up with a bright sample as the difference does, which would hide every firefly.
        // But a lamp as small as a pixel is believed by half of what the dimmer replicate has of it.
        const Range range = inner_range(around);
        const float mean = mean_of(pixel), dimmer = mean - half;
        const float scale = std::clamp(mean, range.low, std::max(range.high, 0.5f * dimmer)) + floor;
        out[x] = scale > 0.0f ? half / scale : 0.0f;
    }
}

}  // namespace candela
