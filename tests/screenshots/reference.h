// SPDX-License-Identifier: MIT
// A stored picture of what the viewer shows, with the variance that its noise has from seed to seed.
#pragma once

#include <filesystem>

#include "renderer/image/image.h"

namespace candela::test {

inline constexpr int reference_renders = 64;

// Of display values in [0,1], per channel, over reference_renders renders of different seeds: the mean of each pixel,
// the variance of a single render (the sample variance, over n − 1), and that of the mean over each block of 8×8
// pixels: neighbours that share paths have noise in common. In the file they stand below each other, the blocks to the
// left.
struct Reference {
    ImageRgb32f mean, variance;
    ImageRgb32f block_variance;  // a pixel for each block
};

Reference make_reference(const std::vector<ImageRgba8>& renders);

void write_reference(const std::filesystem::path& path, const Reference& reference);
// Throws ImageError.
Reference read_reference(const std::filesystem::path& path);

// How far a render of a new seed lies from the reference, in standard scores z = (value − mean) / σ, where σ² adds the
// render's variance, the reference's and that of rounding to 8 bits.
struct Deviation {
    double mean_square_z = 0;           // of all pixels and channels
    double mean_square_z_error = 0;     // its standard error
    double expected_mean_square_z = 0;  // of normal noise: Student's t has (n − 1) / (n − 3)
    double worst_block_z = 0;           // largest |z| of the mean over a block
    int worst_x = 0, worst_y = 0;       // its top left pixel

    // worst_block_z of a few hundred blocks stays below 5 but for one time in some thousands.
    bool acceptable() const {
        return mean_square_z < expected_mean_square_z + 5 * mean_square_z_error && worst_block_z < 5;
    }
};
Deviation compare(const ImageRgba8& render, const Reference& reference);

}  // namespace candela::test
