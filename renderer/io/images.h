// SPDX-License-Identifier: MIT
// Decoding all images of a file at once, several at a time.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "renderer/image/codec.h"
#include "renderer/image/image.h"

namespace candela {

struct DecodedImage {
    ImageRgba8 pixels;  // empty when error is set
    std::string error;  // one line; empty: decoded
};

struct ImageDecodeOptions {
    DecodeLimits limits;
    // Decoded bytes of all images together; images that would exceed it fail with an error naming the limit.
    uint64_t max_total_bytes = uint64_t{16} << 30;
    unsigned threads = 0;                       // 0: all cores
    std::function<void(float)> progress;        // 0..1, never falling, from the calling thread only
    const std::atomic<bool>* cancel = nullptr;  // set: images not yet begun fail with "cancelled"
};

// One result per input, in order; a damaged image never stops the others. An empty span fails with "no data".
std::vector<DecodedImage> decode_images(std::span<const std::span<const std::byte>> encoded,
                                        const ImageDecodeOptions& options = {});

}  // namespace candela
