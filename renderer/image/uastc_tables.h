// SPDX-License-Identifier: MIT
// What the modes and partitions of UASTC mean, computed at compile time from the rules of the specifications.
#pragma once

#include <array>
#include <cstdint>

namespace candela::uastc {

// Which of the three lists of partitions a mode's pattern number counts in.
enum class Patterns : uint8_t { one, two, three, two_of_three };

struct Mode {
    uint8_t code, code_bits;  // how the block begins, lowest bit first
    uint8_t hint_bits;        // for transcoders; skipped
    uint8_t radix, bits;      // endpoints are digit · 2^bits + rest, digits of base 1, 3 or 5
    uint8_t components;       // 2: luminance and alpha, 3: RGB, 4: RGBA
    Patterns patterns;
    uint8_t planes, weight_bits;
};

inline constexpr unsigned solid_mode = 8, mode_count = 19;

// UASTC specification, "Field Definitions" (codes) and "List of UASTC Modes".
inline constexpr Mode modes[mode_count] = {
    {0x01, 4, 15, 3, 6, 3, Patterns::one, 1, 4}, {0x35, 6, 15, 1, 8, 3, Patterns::one, 1, 2},
    {0x1d, 5, 15, 1, 4, 3, Patterns::two, 1, 3}, {0x03, 5, 15, 3, 2, 3, Patterns::three, 1, 2},
    {0x13, 5, 15, 5, 3, 3, Patterns::two, 1, 2}, {0x0b, 5, 15, 1, 8, 3, Patterns::one, 1, 3},
    {0x1b, 5, 15, 5, 5, 3, Patterns::one, 2, 2}, {0x07, 5, 15, 5, 3, 3, Patterns::two_of_three, 1, 2},
    {0x17, 5, 0, 1, 8, 4, Patterns::one, 0, 0},  // one colour, RGBA
    {0x0f, 5, 23, 1, 4, 4, Patterns::two, 1, 2}, {0x02, 3, 17, 3, 4, 4, Patterns::one, 1, 4},
    {0x00, 2, 17, 3, 4, 4, Patterns::one, 2, 2}, {0x06, 3, 17, 3, 6, 4, Patterns::one, 1, 3},
    {0x1f, 5, 23, 1, 8, 4, Patterns::one, 2, 1}, {0x0d, 5, 23, 1, 8, 4, Patterns::one, 1, 2},
    {0x05, 7, 23, 1, 8, 2, Patterns::one, 1, 4}, {0x15, 6, 23, 1, 8, 2, Patterns::two, 1, 2},
    {0x25, 6, 23, 1, 8, 2, Patterns::one, 2, 2}, {0x09, 4, 15, 1, 5, 3, Patterns::one, 1, 5},
};

// The mode by the first 7 bits of a block; mode_count: reserved.
inline constexpr std::array<uint8_t, 128> mode_of_bits = [] {
    std::array<uint8_t, 128> out{};
    out.fill(mode_count);
    for (uint8_t m = 0; m < mode_count; ++m) {
        for (unsigned bits = modes[m].code; bits < out.size(); bits += 1u << modes[m].code_bits)
            out[bits] = m;
    }
    return out;
}();

// Data Format Specification, "Endpoint Unquantization": plain bits are repeated; digit D and rest combine as
// T = D·C + B, whose bits are flipped where the lowest bit of the rest is set.
constexpr uint8_t unquantized_endpoint(unsigned radix, unsigned bits, unsigned value) {
    if (radix == 1) {
        unsigned out = 0;
        for (int shift = 8 - static_cast<int>(bits); shift > -static_cast<int>(bits); shift -= static_cast<int>(bits))
            out |= shift >= 0 ? value << shift : value >> -shift;
        return static_cast<uint8_t>(out);
    }
    const unsigned rest = value & ((1u << bits) - 1), high = rest >> 1;
    unsigned b = 0, c = 0;
    switch (radix * 10 + bits) {
        case 32:  // B = b000b0bb0
            c = 93;
            b = high << 8 | high << 4 | high << 2 | high << 1;
            break;
        case 34:  // dcb000dcb
            c = 22;
            b = high << 6 | high;
            break;
        case 36:  // fedcb000f
            c = 5;
            b = high << 4 | high >> 4;
            break;
        case 53:  // cb0000cbc
            c = 26;
            b = high << 7 | high << 1 | high >> 1;
            break;
        case 55:  // edcb0000e
            c = 6;
            b = high << 5 | high >> 3;
            break;
        default:
            break;
    }
    const unsigned flip = (rest & 1u) != 0 ? 511 : 0;
    const unsigned t = ((value >> bits) * c + b) ^ flip;
    return static_cast<uint8_t>((flip & 0x80u) | t >> 2);
}

// Endpoints in 0..255 by their stored value; modes of one radix and number of bits share nothing but the rule.
inline constexpr std::array<std::array<uint8_t, 256>, mode_count> endpoint_values = [] {
    std::array<std::array<uint8_t, 256>, mode_count> out{};
    for (unsigned m = 0; m < mode_count; ++m) {
        for (unsigned value = 0; value < unsigned{modes[m].radix} << modes[m].bits; ++value)
            out[m][value] = unquantized_endpoint(modes[m].radix, modes[m].bits, value);
    }
    return out;
}();

// "Weight Unquantization": bits repeated to 6, then stretched so that the largest is 64.
inline constexpr std::array<std::array<uint8_t, 32>, 6> weight_values = [] {
    std::array<std::array<uint8_t, 32>, 6> out{};
    for (unsigned bits = 1; bits <= 5; ++bits) {
        for (unsigned value = 0; value < 1u << bits; ++value) {
            unsigned six = 0;
            for (int shift = 6 - static_cast<int>(bits); shift > -static_cast<int>(bits);
                 shift -= static_cast<int>(bits))
                six |= shift >= 0 ? value << shift : value >> -shift;
            out[bits][value] = static_cast<uint8_t>(six > 32 ? six + 1 : six);
        }
    }
    return out;
}();

// A partition of a block into subsets, and the first texel of each, whose weight is stored with one bit less.
struct Pattern {
    uint8_t subset[16] = {};
    bool anchor[16] = {};
};

// "Partition Pattern Generation" for blocks of 4×4 texels.
constexpr uint32_t hash52(uint32_t p) {
    p ^= p >> 15;
    p -= p << 17;
    p += p << 7;
    p += p << 4;
    p ^= p >> 5;
    p += p << 16;
    p ^= p >> 7;
    p ^= p >> 3;
    p ^= p << 6;
    p ^= p >> 17;
    return p;
}

constexpr Pattern make_pattern(uint32_t seed, unsigned subsets) {
    Pattern out;
    seed += (subsets - 1) * 1024;
    const uint32_t random = hash52(seed);
    const unsigned shift_of_three = subsets == 3 ? 6 : 5, shift_of_seed = (seed & 2) != 0 ? 4 : 5;
    const unsigned even = (seed & 1) != 0 ? shift_of_seed : shift_of_three;
    const unsigned odd = (seed & 1) != 0 ? shift_of_three : shift_of_seed;
    // Four planes over the block; a texel belongs to the highest.
    const auto slope = [&](unsigned at, unsigned shift) {
        const unsigned nibble = random >> at & 15u;
        return nibble * nibble >> shift;
    };
    bool seen[3] = {};
    for (unsigned i = 0; i < 16; ++i) {
        const unsigned x = i % 4 * 2, y = i / 4 * 2;
        const unsigned heights[3] = {
            (slope(0, even) * x + slope(4, odd) * y + (random >> 14)) & 63u,
            (slope(8, even) * x + slope(12, odd) * y + (random >> 10)) & 63u,
            subsets < 3 ? 0 : (slope(16, even) * x + slope(20, odd) * y + (random >> 6)) & 63u,
        };
        unsigned subset = 0;
        for (unsigned k = 1; k < 3; ++k) {
            if (heights[k] > heights[subset]) subset = k;
        }
        out.subset[i] = static_cast<uint8_t>(subset);
        out.anchor[i] = !seen[subset];
        seen[subset] = true;
    }
    return out;
}

template <size_t n>
constexpr std::array<Pattern, n> make_patterns(const uint16_t (&seeds)[n], unsigned subsets) {
    std::array<Pattern, n> out{};
    for (size_t i = 0; i < n; ++i)
        out[i] = make_pattern(seeds[i], subsets);
    return out;
}

// The ASTC seeds of the partitions that ASTC and BC7 have in common: UASTC specification, tables "UASTC/BC7 2-Subset",
// "3-Subset" and "2-Subset ASTC 3-Subset BC7 Partition Pattern Table".
inline constexpr uint16_t seeds_of_two[] = {28, 20,  16,  29, 91,  9,   107, 72,  149, 204, 50,  114, 496, 17,  78,
                                            39, 252, 828, 43, 156, 116, 210, 476, 273, 684, 359, 246, 195, 694, 524};
inline constexpr uint16_t seeds_of_three[] = {260, 74, 32, 156, 183, 15, 745, 0, 335, 902, 254};
inline constexpr uint16_t seeds_of_two_of_three[] = {36,  48,  61,  137, 161, 183, 226, 281, 302, 307,
                                                     479, 495, 593, 594, 605, 799, 812, 988, 993};

inline constexpr auto patterns_of_one = [] {
    std::array<Pattern, 1> out{};
    out[0].anchor[0] = true;
    return out;
}();
inline constexpr auto patterns_of_two = make_patterns(seeds_of_two, 2);
inline constexpr auto patterns_of_three = make_patterns(seeds_of_three, 3);
inline constexpr auto patterns_of_two_of_three = make_patterns(seeds_of_two_of_three, 2);

}  // namespace candela::uastc
