// SPDX-License-Identifier: MIT
#include "app/viewer/map_view.h"

namespace candela {

namespace {

// 1, 2 or 5 times a power of ten.
double round_above(double value) {
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * power >= value) return step * power;
    }
    return 10 * power;
}

}  // namespace

const char* title_of(PixelMap map) {
    constexpr const char* titles[] = {"error of each pixel", "samples per pixel", "rays per sample",
                                      "bounces per sample"};
    return titles[static_cast<size_t>(map)];
}

const char* title_of(const MapView& view) {
    if (!view.metric) return title_of(view.map);
    constexpr const char* titles[] = {"difference from the reference", "squared error", "FLIP"};
    return titles[static_cast<size_t>(*view.metric)];
}

// Differences run from minus to plus half of the reference's value, squared errors over six decades.
HeatScale scale_of(ReferenceMetric metric) {
    if (metric == ReferenceMetric::signed_difference) return {-0.5f, 0.5f, false};
    if (metric == ReferenceMetric::relative_square) return {1e-6f, 1, true};
    return {0, 1, false};
}

HeatScale scale_of(PixelMap map, const ImageRgba32f& maps) {
    if (map == PixelMap::error) return {1e-3f, 1, true};
    double sum = 0, squares = 0, largest = 0;
    for (const Vec4& pixel : maps.pixels()) {
        const auto value = static_cast<double>(pixel[static_cast<int>(map)]);
        sum += value;
        squares += value * value;
        largest = std::max(largest, value);
    }
    // A few costly pixels do not darken the others.
    const double n = static_cast<double>(std::max<size_t>(maps.size(), 1)), mean = sum / n;
    const double nearly_all = std::min(largest, mean + 3 * std::sqrt(std::max(squares / n - mean * mean, 0.0)));
    return {0, static_cast<float>(nearly_all > 0 ? round_above(nearly_all) : 1), false};
}

}  // namespace candela
