// SPDX-License-Identifier: MIT
// The header of an OpenEXR file, checked before the library sees it: the library allocates whatever sizes it reads.
#pragma once

#include <span>

#include "renderer/image/codec.h"

namespace candela {

// Throws ImageError unless every attribute lies in the file, the picture and its tiles keep to the limits, and the file
// is of one part with pixels of the picture's own resolution.
void check_exr_header(std::span<const std::byte> bytes, const DecodeLimits& limits);

}  // namespace candela
