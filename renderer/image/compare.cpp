// SPDX-License-Identifier: MIT
#include "renderer/image/compare.h"

#include <stdexcept>

namespace candela {

namespace {

void check_sizes(const ImageRgba32f& a, const ImageRgba32f& b) {
    if (a.width() != b.width() || a.height() != b.height()) throw std::invalid_argument("the pictures differ in size");
}

double mean_of_channels(const ImageRgba32f& image) {
    double sum = 0;
    for (const Vec4& p : image.pixels())
        sum += static_cast<double>(p.r) + static_cast<double>(p.g) + static_cast<double>(p.b);
    return sum / (3.0 * static_cast<double>(image.size()));
}

// What counts as the square of a dark reference.
double floor_square(double reference_mean) {
    return 0.01 * reference_mean * reference_mean;
}

}  // namespace

ImageDifference compare_images(const ImageRgba32f& a, const ImageRgba32f& b) {
    check_sizes(a, b);
    return a.empty() ? ImageDifference{} : compare_images(a, b, flip_map(a, b));
}

ImageDifference compare_images(const ImageRgba32f& a, const ImageRgba32f& b, const Image<float>& flip) {
    check_sizes(a, b);
    ImageDifference out;
    if (a.empty()) return out;
    const double count = 3.0 * static_cast<double>(a.size());
    const double least_square = floor_square(mean_of_channels(b));
    double squares = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const auto reference = static_cast<double>(b.pixels()[i][c]);
            const double difference = static_cast<double>(a.pixels()[i][c]) - reference;
            squares += difference * difference;
            out.mae += std::abs(difference) / count;
            out.signed_mean += difference / count;
            out.max_abs = std::max(out.max_abs, std::abs(difference));
            const double scale = reference * reference + least_square;
            if (difference != 0) out.rel_mse += difference * difference / std::max(scale, 1e-30) / count;
        }
    }
    out.rmse = std::sqrt(squares / count);
    for (const float value : flip.pixels())
        out.flip += static_cast<double>(value) / static_cast<double>(flip.size());
    return out;
}

PictureComparison compare_with_maps(const ImageRgba32f& a, const ImageRgba32f& b) {
    check_sizes(a, b);
    PictureComparison out;
    if (a.empty()) return out;
    const Image<float> flip = flip_map(a, b);
    out.difference = compare_images(a, b, flip);
    out.maps = ImageRgba32f(a.width(), a.height());
    const double mean = mean_of_channels(b), least_square = floor_square(mean);
    for (size_t i = 0; i < a.size(); ++i) {
        const Vec3 test(a.pixels()[i]), reference(b.pixels()[i]);
        double square = 0;
        for (int c = 0; c < 3; ++c) {
            const double truth = static_cast<double>(reference[c]), off = static_cast<double>(test[c]) - truth;
            square += off * off / std::max(truth * truth + least_square, 1e-30) / 3;
        }
        const double scale = static_cast<double>(luminance(reference)) + 0.1 * mean;
        const double off = static_cast<double>(luminance(test)) - static_cast<double>(luminance(reference));
        out.maps.pixels()[i] =
            Vec4(static_cast<float>(off / std::max(scale, 1e-30)), static_cast<float>(square), flip.pixels()[i], 0);
    }
    return out;
}

}  // namespace candela
