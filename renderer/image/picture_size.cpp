// SPDX-License-Identifier: MIT
#include "renderer/image/picture_size.h"

#include <cstring>

#include <webp/decode.h>

namespace candela {
namespace {

class Head {
  public:
    explicit Head(std::span<const std::byte> bytes) : bytes_(bytes) {}

    bool begins_with(const char* text, size_t length) const {
        return bytes_.size() >= length && std::memcmp(bytes_.data(), text, length) == 0;
    }
    size_t size() const { return bytes_.size(); }
    uint32_t at(size_t i) const { return std::to_integer<uint32_t>(bytes_[i]); }
    uint32_t big_endian(size_t i, size_t count) const {
        uint32_t value = 0;
        for (size_t k = 0; k < count; ++k)
            value = value << 8 | at(i + k);
        return value;
    }
    uint32_t little_endian_32(size_t i) const { return at(i) | at(i + 1) << 8 | at(i + 2) << 16 | at(i + 3) << 24; }

  private:
    std::span<const std::byte> bytes_;
};

// The first frame header among the segments (ITU-T T.81, B.2.2).
std::optional<PictureSize> jpeg_size(const Head& head) {
    for (size_t i = 2; i + 9 <= head.size() && head.at(i) == 0xff;) {
        const uint32_t marker = head.at(i + 1);
        if (marker == 0xff) {
            ++i;
            continue;
        }
        const bool is_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (is_frame) return PictureSize{head.big_endian(i + 7, 2), head.big_endian(i + 5, 2), true};
        i += 2 + head.big_endian(i + 2, 2);
    }
    return std::nullopt;
}

// Colour types without alpha (PNG, 11.2.2), and no transparent colour among the chunks before the pixels.
bool png_is_opaque(const Head& head) {
    if (head.size() < 26 || head.at(25) > 3) return false;
    for (size_t i = 8; i + 8 <= head.size();) {
        const uint32_t name = head.big_endian(i + 4, 4);
        if (name == 0x49444154) return true;   // IDAT
        if (name == 0x74524e53) return false;  // tRNS
        i += size_t{12} + head.big_endian(i, 4);
    }
    return false;
}

}  // namespace

std::optional<PictureSize> picture_size(std::span<const std::byte> encoded) {
    const Head head(encoded);
    if (head.begins_with("\x89PNG\r\n\x1a\n", 8) && head.size() >= 24) {
        return PictureSize{head.big_endian(16, 4), head.big_endian(20, 4), png_is_opaque(head)};
    }
    if (head.begins_with("\xff\xd8", 2)) return jpeg_size(head);
    if (head.begins_with("\xabKTX 20\xbb\r\n\x1a\n", 12) && head.size() >= 28) {
        return PictureSize{head.little_endian_32(20), head.little_endian_32(24), false};
    }
    WebPBitstreamFeatures webp;
    if (head.begins_with("RIFF", 4) &&
        WebPGetFeatures(reinterpret_cast<const uint8_t*>(encoded.data()), encoded.size(), &webp) == VP8_STATUS_OK) {
        return PictureSize{static_cast<uint32_t>(webp.width), static_cast<uint32_t>(webp.height), webp.has_alpha == 0};
    }
    return std::nullopt;
}

}  // namespace candela
