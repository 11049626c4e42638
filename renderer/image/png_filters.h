// SPDX-License-Identifier: MIT
// Undoing the filters of PNG rows (PNG specification, 9) for pixels of three or four 8-bit channels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/image/image.h"

namespace candela {

// Rows as they are inflated, each a byte that names its filter and the pixels, to RGBA; alpha 255 where there are three
// channels. Four bytes after the last row must be readable. The rows may lie in the same memory as out, where they end
// no less than unfilter_ahead_bytes after what is written. False: a row names no filter.
bool unfilter_rows(const uint8_t* rows, size_t channels, size_t width, size_t height, Rgba8* out);

// How much longer than the pixels that memory is.
constexpr size_t unfilter_ahead_bytes(size_t width, size_t height) {
    return 4 * width + height + 4;
}

}  // namespace candela
