// SPDX-License-Identifier: MIT
#include "renderer/image/compare.h"

#include <stdexcept>

namespace candela {

ImageDifference compare_images(const ImageRgba32f& a, const ImageRgba32f& b) {
    if (a.width() != b.width() || a.height() != b.height()) throw std::invalid_argument("the pictures differ in size");
    ImageDifference out;
    if (a.empty()) return out;
    const double count = 3.0 * static_cast<double>(a.size());
    double reference_mean = 0;
    for (const Vec4& p : b.pixels())
        reference_mean += static_cast<double>(p.r) + static_cast<double>(p.g) + static_cast<double>(p.b);
    reference_mean /= count;

    const double floor_square = 0.01 * reference_mean * reference_mean;
    double squares = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const auto reference = static_cast<double>(b.pixels()[i][c]);
            const double difference = static_cast<double>(a.pixels()[i][c]) - reference;
            squares += difference * difference;
            out.mae += std::abs(difference) / count;
            out.signed_mean += difference / count;
            out.max_abs = std::max(out.max_abs, std::abs(difference));
            const double scale = reference * reference + floor_square;
            if (difference != 0) out.rel_mse += difference * difference / std::max(scale, 1e-30) / count;
        }
    }
    out.rmse = std::sqrt(squares / count);
    const Image<float> flip = flip_map(a, b);
    for (const float value : flip.pixels())
        out.flip += static_cast<double>(value) / static_cast<double>(flip.size());
    return out;
}

}  // namespace candela
