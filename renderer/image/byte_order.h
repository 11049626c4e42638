// SPDX-License-Identifier: MIT
// Numbers in a byte string, little-endian where the name says nothing else. The caller has checked that they are there.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace candela {

template <typename T>
T read_little_endian(std::span<const std::byte> bytes, size_t offset) {
    static_assert(std::endian::native == std::endian::little);
    T out;
    std::memcpy(&out, bytes.data() + offset, sizeof(T));
    return out;
}
inline uint16_t read_u16(std::span<const std::byte> bytes, size_t offset) {
    return read_little_endian<uint16_t>(bytes, offset);
}
inline uint32_t read_u32(std::span<const std::byte> bytes, size_t offset) {
    return read_little_endian<uint32_t>(bytes, offset);
}
inline uint64_t read_u64(std::span<const std::byte> bytes, size_t offset) {
    return read_little_endian<uint64_t>(bytes, offset);
}
inline uint32_t read_big_endian_u32(std::span<const std::byte> bytes, size_t offset) {
    return __builtin_bswap32(read_u32(bytes, offset));
}

}  // namespace candela
