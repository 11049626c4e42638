// SPDX-License-Identifier: MIT
// How large an encoded picture is, as its head says, without decoding it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace candela {

struct PictureSize {
    uint32_t width = 0, height = 0;
    bool opaque = false;  // the format has no alpha, or the head says that this picture has none
};

// Of PNG, JPEG, WebP or KTX2; nothing where the head is none of theirs or ends too early.
std::optional<PictureSize> picture_size(std::span<const std::byte> encoded);

}  // namespace candela
