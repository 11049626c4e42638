// SPDX-License-Identifier: MIT
// Integer hashes for decorrelating pixels, dimensions and hits. All are bijections or built from them.
#pragma once

#include <cstdint>

namespace candela {

// A 32-bit bijective mixer with low bias ("lowbias32", Wellons 2018, hash-prospector).
inline constexpr uint32_t hash_u32(uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

inline constexpr uint32_t hash_combine(uint32_t seed, uint32_t value) {
    return hash_u32(seed ^ (value + 0x9e3779b9u + (seed << 6) + (seed >> 2)));
}

// The 24 high bits as a float in [0, 1).
inline constexpr float unit_float(uint32_t x) {
    return static_cast<float>(x >> 8) * 0x1p-24f;
}

}  // namespace candela
