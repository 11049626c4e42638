// SPDX-License-Identifier: MIT
// PNG as most textures are: 8-bit RGB or RGBA, not interlaced, without palette or transparent colour. Such a file is
// inflated as a whole by libdeflate, into the memory of its pixels, in about half the time that libpng takes.
#pragma once

#include <optional>
#include <span>

#include "renderer/image/codec.h"

namespace candela {

// Nothing where the file is of another kind, or anything about it is unusual or broken: what is wrong with it, and what
// can be made of it all the same, libpng tells. (Zlib, which libpng uses, is stricter about tables of codes: it refuses
// some streams that libdeflate reads, in full and with the right checksum.) Throws only where the picture is over the
// limits, before memory is taken for it. Takes that of the pixels, a row and a byte for each row; and while it inflates
// that of the compressed bytes, where they are stored in several pieces.
std::optional<ImageRgba8> decode_truecolor_png(std::span<const std::byte> bytes, const DecodeLimits& limits);

}  // namespace candela
