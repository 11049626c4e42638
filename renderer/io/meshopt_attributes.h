// SPDX-License-Identifier: MIT
// What KHR_meshopt_compression adds to EXT_meshopt_compression and the packaged library does not know: version 1 of the
// ATTRIBUTES stream, and the COLOR filter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace candela {

// Whether an ATTRIBUTES stream is of version 1.
bool is_attributes_v1(std::span<const std::byte> encoded);

// Fills out with count elements of stride bytes; false where the stream is damaged. stride is a multiple of 4 up to
// 256, out has count · stride bytes.
bool decode_attributes_v1(std::span<const std::byte> encoded, uint64_t count, uint64_t stride,
                          std::span<std::byte> out);

// YCoCg with alpha to RGBA, in place: elements of four components of stride / 4 bytes each (4 or 8).
void decode_color_filter(std::span<std::byte> elements, uint64_t stride);

}  // namespace candela
