// SPDX-License-Identifier: MIT
// One decoder and encoder per format, each in its own file; codec.h chooses among them. All throw ImageError.
#pragma once

#include <span>
#include <string_view>

#include "renderer/image/codec.h"

namespace candela {

enum class ImageFormat : uint8_t { unknown, png, jpeg, webp, ktx2, exr, hdr };
ImageFormat sniff_format(std::span<const std::byte> bytes);

// Throws when the size is 0 or over the limits. pixel_bytes: of the decoded picture.
void check_size(uint64_t width, uint64_t height, const DecodeLimits& limits, size_t pixel_bytes = sizeof(Rgba8));

ImageRgba8 decode_png(std::span<const std::byte> bytes, const DecodeLimits& limits);
// By the packaged library alone.
ImageRgba8 decode_png_with_libpng(std::span<const std::byte> bytes, const DecodeLimits& limits);
ImageRgba8 decode_jpeg(std::span<const std::byte> bytes, const DecodeLimits& limits);
ImageRgba8 decode_webp(std::span<const std::byte> bytes, const DecodeLimits& limits);
ImageRgba8 decode_ktx2(std::span<const std::byte> bytes, const DecodeLimits& limits);
ImageRgba32f decode_exr(std::span<const std::byte> bytes, const DecodeLimits& limits);
ImageRgba32f decode_hdr(std::span<const std::byte> bytes, const DecodeLimits& limits);

}  // namespace candela
