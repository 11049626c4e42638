// SPDX-License-Identifier: MIT
// What a film says of its own error. The samples of a pixel belong to two independent replicates with n0 and n1 samples
// and means A and B. The pixel's value is m = (n0·A + n1·B)/n, and with n0 ≈ n1 the difference of the replicates has
// Var(A − B) = Var A + Var B ≈ 4 Var m, whatever correlation there is inside a replicate. For a nearly normal A − B,
// E|A − B| = sqrt(2/π)·2·SE(m): so sqrt(π/2)·|A − B|/2 estimates the standard error without bias.
#include "renderer/film/film.h"

namespace candela {

namespace {

constexpr double half_normal = 1.2533141373155003;  // sqrt(π/2)

// |A − B|/2, or a negative number while one replicate has no sample.
double half_difference(const FilmPixel& pixel) {
    const uint32_t even = (pixel.count + 1) / 2;
    const uint32_t odd = pixel.count / 2;
    if (odd == 0) return -1.0;
    const double a = static_cast<double>(pixel.even_luminance_sum) / even;
    const double total = static_cast<double>(luminance(pixel.radiance_sum));
    const double b = (total - static_cast<double>(pixel.even_luminance_sum)) / odd;
    return 0.5 * std::abs(a - b);
}

double mean_of(const FilmPixel& pixel) {
    return pixel.count == 0 ? 0.0 : static_cast<double>(luminance(pixel.radiance_sum)) / pixel.count;
}

}  // namespace

FilmStatistics measure(const Film& film) {
    FilmStatistics out;
    out.min_samples = film.pixels().empty() ? 0 : 0xffffffffu;
    double luminance_sum = 0;
    for (const FilmPixel& pixel : film.pixels()) {
        out.total_samples += pixel.count;
        out.non_finite += pixel.non_finite;
        out.min_samples = std::min(out.min_samples, pixel.count);
        luminance_sum += mean_of(pixel);
    }
    const auto pixels = static_cast<double>(std::max<size_t>(film.pixels().size(), 1));
    out.mean_samples = static_cast<double>(out.total_samples) / pixels;
    out.mean_luminance = luminance_sum / pixels;

    // The mean over pixels of the relative standard error; dark pixels count against a tenth of the picture's mean.
    out.relative_error = std::numeric_limits<double>::quiet_NaN();
    if (out.min_samples < 2) return out;
    double error_sum = 0;
    for (const FilmPixel& pixel : film.pixels()) {
        const double scale = mean_of(pixel) + 0.1 * out.mean_luminance;
        if (scale > 0) error_sum += half_normal * half_difference(pixel) / scale;
    }
    out.relative_error = error_sum / pixels;
    return out;
}

std::vector<float> standard_error_map(const Film& film) {
    const auto width = static_cast<int>(film.extent().x);
    const auto height = static_cast<int>(film.extent().y);
    constexpr int reach = 2;
    std::vector<float> out(film.pixels().size(), std::numeric_limits<float>::quiet_NaN());
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            // One difference is a poor estimate; the root mean square over 5 × 5 pixels is a usable one.
            double squares = 0;
            int count = 0;
            for (int v = std::max(y - reach, 0); v <= std::min(y + reach, height - 1); ++v) {
                for (int u = std::max(x - reach, 0); u <= std::min(x + reach, width - 1); ++u) {
                    const double d = half_difference(film.at(Vec2u(u, v)));
                    if (d < 0) continue;
                    squares += d * d;
                    ++count;
                }
            }
            if (count > 0) {
                out[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)] =
                    static_cast<float>(std::sqrt(squares / count));
            }
        }
    }
    return out;
}

}  // namespace candela
