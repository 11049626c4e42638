// SPDX-License-Identifier: MIT
// What the two replicates of a pixel say of its error.
#pragma once

#include "renderer/film/film.h"

namespace candela {

// Dark pixels count against this part of the picture's mean.
inline constexpr double error_floor = 0.1;

inline float mean_of(const FilmPixel& pixel) {
    return pixel.count == 0 ? 0.0f : luminance(pixel.radiance_sum) / static_cast<float>(pixel.count);
}

// Half the difference of the replicates' means; negative while one of them has no sample.
inline float half_difference(const FilmPixel& pixel) {
    const uint32_t even = (pixel.count + 1) / 2;
    const uint32_t odd = pixel.count / 2;
    if (odd == 0) return -1.0f;
    const double a = static_cast<double>(pixel.even_luminance_sum) / even;
    const double total = static_cast<double>(luminance(pixel.radiance_sum));
    const double b = (total - static_cast<double>(pixel.even_luminance_sum)) / odd;
    return static_cast<float>(0.5 * std::abs(a - b));
}

// Half the differences of a row of pixels, relative to the pixel's value (kept within what its neighbours say) and the
// floor; negative while unknown. out has the film's width.
void relative_half_differences(const Film& film, double mean_luminance, uint32_t y, std::span<float> out) noexcept;

}  // namespace candela
