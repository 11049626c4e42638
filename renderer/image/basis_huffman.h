// SPDX-License-Identifier: MIT
// The Huffman tables of BasisLZ: canonical codes as in Deflate (RFC 1951, 3.2.2), of up to 16 bits and 16383 symbols,
// sent as run-length coded code lengths. KTX 2.0 specification, "Compressed Huffman Tables".
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/image/bit_reader.h"

namespace candela {

class HuffmanTable {
  public:
    // A table without symbols: decoding with it throws.
    HuffmanTable() = default;
    // lengths: bits of each symbol's code, 0 for symbols that do not occur. Throws ImageError unless the codes fill the
    // whole code space or there is only one.
    explicit HuffmanTable(std::span<const uint8_t> lengths);

    // Reads one symbol. Throws ImageError where no code matches.
    uint32_t decode(BitReader& bits) const;

  private:
    static constexpr unsigned max_length = 16;
    static constexpr unsigned fast_bits = 10;
    struct Entry {
        uint16_t symbol = 0;
        uint16_t length = 0;  // 0: the code is longer than fast_bits, or there is none
    };
    std::vector<Entry> fast_;                                                      // by the next fast_bits bits
    std::vector<uint16_t> symbols_;                                                // by length, then by value
    std::array<uint32_t, max_length + 1> first_code_{}, first_index_{}, count_{};  // of each length
};

HuffmanTable read_huffman_table(BitReader& bits);

}  // namespace candela
