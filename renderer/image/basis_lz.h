// SPDX-License-Identifier: MIT
// ETC1S pictures under BasisLZ: two codebooks for all mip levels, and per picture one or two slices of Huffman-coded
// indices into them. KTX 2.0 specification, appendices "BasisLZ Global Data" and "BasisLZ/ETC1S Bitstream
// Specification"; the texels of an ETC1 block: Khronos Data Format Specification, 21.1. All throw ImageError.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "renderer/image/basis_huffman.h"
#include "renderer/image/image.h"

namespace candela {

class BasisLz {
  public:
    // What a picture's second slice holds.
    enum class SecondSlice : uint8_t { none, alpha, green };

    // The supercompression global data of a file with that many pictures (mip levels).
    BasisLz(std::span<const std::byte> global_data, size_t pictures);

    // The picture of a mip level, from that level's bytes. Alpha is 255 unless a slice gives it.
    ImageRgba8 decode(size_t picture, std::span<const std::byte> level, int width, int height,
                      SecondSlice second) const;

  private:
    friend class SliceReader;
    struct Slices {
        uint32_t flags = 0;
        uint32_t offset = 0, bytes = 0, second_offset = 0, second_bytes = 0;
    };

    void read_endpoints(std::span<const std::byte> bytes, size_t count);
    void read_selectors(std::span<const std::byte> bytes, size_t count);
    void read_tables(std::span<const std::byte> bytes);

    std::vector<Slices> pictures_;
    std::vector<std::array<Rgba8, 4>> palettes_;     // the four colours of each endpoint, by selector value
    std::vector<std::array<uint8_t, 4>> selectors_;  // 2 bits a texel, one byte a row, the left texel lowest
    HuffmanTable endpoint_prediction_, endpoint_delta_, selector_, selector_run_;
    uint32_t history_size_ = 0;
};

}  // namespace candela
