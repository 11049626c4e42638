// SPDX-License-Identifier: MIT
// How far two pictures differ.
#pragma once

#include "renderer/image/image.h"

namespace candela {

struct ImageDifference {
    double rmse = 0;     // root of the mean squared difference over pixels and channels
    double rel_mse = 0;  // mean over pixels and channels of (a-b)² / (b² + (0.1 · mean of b)²)
    double mae = 0;      // mean absolute difference
    double flip = 0;     // mean FLIP error (Andersson et al. 2020) of the clipped sRGB pictures, 67 pixels per degree
    double signed_mean = 0;  // mean of a - b
    double max_abs = 0;
};

// a is the test, b the reference; both linear; sizes must match, else std::invalid_argument.
ImageDifference compare_images(const ImageRgba32f& a, const ImageRgba32f& b);

// The same where the FLIP errors are known.
ImageDifference compare_images(const ImageRgba32f& a, const ImageRgba32f& b, const Image<float>& flip);

// The channels of PictureComparison::maps.
enum class ReferenceMetric : uint8_t {
    signed_difference,  // of luminances, relative to the reference's and a tenth of its mean
    relative_square,    // a pixel's part of rel_mse
    flip
};

struct PictureComparison {
    ImageDifference difference;
    ImageRgba32f maps;
};

// How far a is from the reference b, as numbers and pixel by pixel; sizes must match, else std::invalid_argument.
PictureComparison compare_with_maps(const ImageRgba32f& a, const ImageRgba32f& b);

// Per-pixel FLIP error in [0,1].
Image<float> flip_map(const ImageRgba32f& a, const ImageRgba32f& b);

}  // namespace candela
