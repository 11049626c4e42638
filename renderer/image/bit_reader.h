// SPDX-License-Identifier: MIT
// Bits of a byte string in the order of Deflate and BasisLZ: the lowest bit of each byte first. Reading past the end
// throws ImageError.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "renderer/image/byte_order.h"
#include "renderer/image/codec.h"

namespace candela {

class BitReader {
  public:
    explicit BitReader(std::span<const std::byte> bytes) : rest_(bytes) {}

    // The next count ≤ 32 bits, zeros beyond the end.
    uint32_t peek(unsigned count) {
        if (held_bits_ < count) refill();
        return static_cast<uint32_t>(held_ & ((uint64_t{1} << count) - 1));
    }
    // Drops bits that were peeked.
    void skip(unsigned count) {
        if (count > held_bits_) throw ImageError("broken KTX2: a bit stream ends too early");
        held_ >>= count;
        held_bits_ -= count;
    }
    uint32_t take(unsigned count) {
        const uint32_t bits = peek(count);
        skip(count);
        return bits;
    }

  private:
    void refill() {
        if (rest_.size() >= 8) {  // as many whole bytes of the next eight as there is room for
            held_ |= read_u64(rest_, 0) << held_bits_;
            rest_ = rest_.subspan((63 - held_bits_) / 8);
            held_bits_ |= 56;
            return;
        }
        for (; held_bits_ <= 56 && !rest_.empty(); rest_ = rest_.subspan(1), held_bits_ += 8)
            held_ |= static_cast<uint64_t>(rest_.front()) << held_bits_;
    }

    std::span<const std::byte> rest_;
    uint64_t held_ = 0;
    unsigned held_bits_ = 0;
};

}  // namespace candela
