// SPDX-License-Identifier: MIT
// UASTC LDR 4×4: blocks of 128 bits that are a subset of ASTC in a layout of their own. UASTC LDR 4x4 Texture
// Specification (Binomial); unquantisation, partitions and interpolation: Khronos Data Format Specification, chapter
// "ASTC Compressed Texture Image Formats", with 8-bit results of linear (not sRGB) decoding, as encoders assume.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "renderer/image/image.h"

namespace candela {

inline constexpr size_t uastc_block_bytes = 16;

// The 16 texels of a block, row by row. Throws ImageError where its mode or its partition is reserved.
void decode_uastc_block(std::span<const std::byte, uastc_block_bytes> block, std::span<Rgba8, 16> texels);

// Blocks in raster order, as many as cover the picture: the caller has checked it.
ImageRgba8 decode_uastc(std::span<const std::byte> blocks, int width, int height);

}  // namespace candela
