// SPDX-License-Identifier: MIT
// WebP through libwebp.
#include <webp/decode.h>

#include "renderer/image/codecs.h"

namespace candela {

ImageRgba8 decode_webp(std::span<const std::byte> bytes, const DecodeLimits& limits) {
    const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
    int width = 0, height = 0;
    if (WebPGetInfo(data, bytes.size(), &width, &height) == 0)
        throw ImageError("broken WebP: its header cannot be read");
    check_size(static_cast<uint64_t>(width), static_cast<uint64_t>(height), limits);
    ImageRgba8 out(width, height);
    if (WebPDecodeRGBAInto(data, bytes.size(), &out(0, 0).r, out.size() * sizeof(Rgba8), width * 4) == nullptr) {
        throw ImageError("broken WebP: its data cannot be decoded");
    }
    return out;
}

}  // namespace candela
