// SPDX-License-Identifier: MIT
// WebP through libwebp.
#include <webp/decode.h>

#include "renderer/image/codecs.h"

namespace candela {

ImageRgba8 decode_webp(std::span<const std::byte> bytes, const DecodeLimits& limits) {
    const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK)
        throw ImageError("broken WebP: its header cannot be read");
    if (features.has_animation != 0) throw ImageError("the WebP file is an animation, not a picture");
    check_size(static_cast<uint64_t>(features.width), static_cast<uint64_t>(features.height), limits);
    ImageRgba8 out(features.width, features.height);
    if (WebPDecodeRGBAInto(data, bytes.size(), &out(0, 0).r, out.size() * sizeof(Rgba8), features.width * 4) ==
        nullptr) {
        throw ImageError("broken WebP: its data cannot be decoded");
    }
    return out;
}

}  // namespace candela
