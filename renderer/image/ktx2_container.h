// SPDX-License-Identifier: MIT
// The container KTX 2.0 as far as KHR_texture_basisu allows it: one two-dimensional picture with its mip levels, in
// ETC1S under BasisLZ or in UASTC, plain or under Zstandard. KTX File Format Specification 2.0; the data format
// descriptor: Khronos Data Format Specification. Throws ImageError for damage and for what the extension forbids.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/image/codec.h"

namespace candela {

struct Ktx2File {
    enum class Blocks : uint8_t { etc1s, uastc };
    enum class Channels : uint8_t { rgb, rgba, red, red_green };
    enum class Transfer : uint8_t { unspecified, linear, srgb };
    struct Level {
        std::span<const std::byte> data;  // within the file
        uint64_t uncompressed_bytes = 0;
        int width = 0, height = 0;
    };

    Blocks blocks = Blocks::uastc;
    Channels channels = Channels::rgb;
    bool zstandard = false;                     // levels are compressed further
    Transfer transfer = Transfer::unspecified;  // what the descriptor says; values are decoded as stored
    std::span<const std::byte> global_data;     // of BasisLZ
    std::vector<Level> levels;                  // at least one, the largest first
};

// The file must outlive the result.
Ktx2File parse_ktx2(std::span<const std::byte> bytes, const DecodeLimits& limits);

}  // namespace candela
