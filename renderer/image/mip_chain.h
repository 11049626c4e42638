// SPDX-License-Identifier: MIT
// Smaller copies of an image, each half as wide and high as the one before, for lookups that stand for many texels.
#pragma once

#include <vector>

#include "renderer/image/image.h"

namespace candela {

enum class MipColors : uint8_t {
    plain,
    alpha_weighted,  // texels count as much as they are opaque: what lies hidden under alpha 0 does not bleed out
};

// Levels 1, 2, … down to a single texel; empty for an image of one texel. Each texel is the mean of the area that it
// covers (whole texels of even sizes, shares of texels of odd ones), RGB of sRGB images averaged in linear light and
// stored as sRGB again, alpha averaged as it is.
std::vector<ImageRgba8> make_mip_chain(const ImageRgba8& image, MipColors colors);

}  // namespace candela
