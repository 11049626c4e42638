// SPDX-License-Identifier: MIT
// Little-endian numbers in a byte string. The caller has checked that they are there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace candela {

inline uint64_t read_little_endian(std::span<const std::byte> bytes, size_t offset, size_t count) {
    uint64_t out = 0;
    for (size_t i = 0; i < count; ++i)
        out |= static_cast<uint64_t>(bytes[offset + i]) << (8 * i);
    return out;
}
inline uint16_t read_u16(std::span<const std::byte> bytes, size_t offset) {
    return static_cast<uint16_t>(read_little_endian(bytes, offset, 2));
}
inline uint32_t read_u32(std::span<const std::byte> bytes, size_t offset) {
    return static_cast<uint32_t>(read_little_endian(bytes, offset, 4));
}
inline uint64_t read_u64(std::span<const std::byte> bytes, size_t offset) {
    return read_little_endian(bytes, offset, 8);
}

}  // namespace candela
