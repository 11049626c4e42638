// SPDX-License-Identifier: MIT
// UASTC blocks of every mode, packed here at the bit positions that the specification lists from known endpoints and
// weights, against texels by the plain rules of ASTC with the specification's own tables.
#include "renderer/image/uastc.h"

#include <random>

#include "renderer/image/codec.h"
#include "tests/support/ktx2_writer.h"

namespace candela {
namespace {

// Tables of the specification: partitions by the subset of each texel.
const std::vector<std::string> two_subsets = {
    "0011001100110011", "0001000100010001", "1000100010001000", "0001001100110111", "1111111011101100",
    "0011011101111111", "1110110010000000", "1111111011001000", "0000000000010011", "1100100000000000",
    "0000000101111111", "1111111111101000", "1110100000000000", "1111111100000000", "0000111111111111",
    "1111111111110000", "1000111011111111", "1111111101110001", "0111001100010000", "0011000100000000",
    "0000100011001110", "1111111101110011", "1000110011001110", "0011000100010000", "1111011101110011",
    "0110011001100110", "1111000000001111", "1010101010101010", "1111000011110000", "1001001101101100"};
const std::vector<std::string> three_subsets = {"0000000011221122", "1111111100002222", "1111000000002222",
                                                "1111222200000000", "1120112011201120", "0112011201120112",
                                                "0211021102110211", "2000200021112111", "2012201220122012",
                                                "1111000022221111", "0022001100110022"};
const std::vector<std::string> two_of_three_subsets = {
    "0000111100000000", "0010001000100010", "1100110010000000", "0000000100110011", "1111111100001111",
    "0100010001000100", "0001001111111111", "0111001100110011", "1100000000111100", "0111011100000000",
    "0000000011101110", "1100000000001100", "0111001100000000", "0000000111111111", "1111111111110110",
    "1100110011001000", "1111111110001000", "0011011011001000", "1111011100000000"};
const std::vector<std::string> one_subset = {"0000000000000000"};

struct Layout {
    unsigned code, code_bits, components;
    const std::vector<std::string>* partitions;
    unsigned weight_bits, planes;
    unsigned radix, bits;                                                        // of endpoints
    int partition_at, partition_bits, plane_at, digits_at, bits_at, weights_at;  // -1: no such field
};
// "List of UASTC Modes". Mode 8 has no such fields.
const Layout layouts[19] = {
    {0x01, 4, 3, &one_subset, 4, 1, 3, 6, -1, 0, -1, 19, 29, 65},
    {0x35, 6, 3, &one_subset, 2, 1, 1, 8, -1, 0, -1, -1, 21, 69},
    {0x1d, 5, 3, &two_subsets, 3, 1, 1, 4, 20, 5, -1, -1, 25, 73},
    {0x03, 5, 3, &three_subsets, 2, 1, 3, 2, 20, 4, -1, 24, 53, 89},
    {0x13, 5, 3, &two_subsets, 2, 1, 5, 3, 20, 5, -1, 25, 53, 89},
    {0x0b, 5, 3, &one_subset, 3, 1, 1, 8, -1, 0, -1, -1, 20, 68},
    {0x1b, 5, 3, &one_subset, 2, 2, 5, 5, -1, 0, 20, 22, 36, 66},
    {0x07, 5, 3, &two_of_three_subsets, 2, 1, 5, 3, 20, 5, -1, 25, 53, 89},
    {0x17, 5, 4, &one_subset, 1, 1, 1, 8, -1, 0, -1, -1, -1, -1},
    {0x0f, 5, 4, &two_subsets, 2, 1, 1, 4, 28, 5, -1, -1, 33, 97},
    {0x02, 3, 4, &one_subset, 4, 1, 3, 4, -1, 0, -1, 20, 33, 65},
    {0x00, 2, 4, &one_subset, 2, 2, 3, 4, -1, 0, 19, 21, 34, 66},
    {0x06, 3, 4, &one_subset, 3, 1, 3, 6, -1, 0, -1, 20, 33, 81},
    {0x1f, 5, 4, &one_subset, 1, 2, 1, 8, -1, 0, 28, -1, 30, 94},
    {0x0d, 5, 4, &one_subset, 2, 1, 1, 8, -1, 0, -1, -1, 28, 92},
    {0x05, 7, 2, &one_subset, 4, 1, 1, 8, -1, 0, -1, -1, 30, 62},
    {0x15, 6, 2, &two_subsets, 2, 1, 1, 8, 29, 5, -1, -1, 34, 98},
    {0x25, 6, 2, &one_subset, 2, 2, 1, 8, -1, 0, -1, -1, 29, 61},
    {0x09, 4, 3, &one_subset, 5, 1, 1, 5, -1, 0, -1, -1, 19, 49},
};

// "BISE Endpoint Decoding Dequantization Tables": the lower half of each range's values in rising order; the upper half
// mirrors it and is what odd stored values mean.
unsigned endpoint_value(unsigned radix, unsigned bits, unsigned stored) {
    const unsigned levels = radix << bits;
    if (levels == 16) return stored * 17;
    if (levels == 32) return stored << 3 | stored >> 2;
    if (levels == 256) return stored;
    const unsigned rest = stored % (1u << bits), rank = rest / 2 * radix + (stored >> bits);
    static const unsigned of_12[] = {0, 23, 46, 69, 92, 116};
    static const unsigned of_40[] = {0, 6, 13, 19, 26, 32, 39, 45, 52, 58, 65, 71, 78, 84, 91, 97, 104, 110, 117, 123};
    static const unsigned of_48[] = {0,  5,  11, 16, 21, 27, 32, 38,  43,  48,  54,  59,
                                     65, 70, 76, 81, 86, 92, 97, 103, 108, 113, 119, 124};
    static const unsigned of_five[] = {0, 1, 3, 4, 6};
    const unsigned low = levels == 12    ? of_12[rank]
                         : levels == 40  ? of_40[rank]
                         : levels == 48  ? of_48[rank]
                         : levels == 160 ? rank / 5 * 8 + of_five[rank % 5]
                                         : rank / 3 * 4 + rank % 3;
    return rest % 2 == 0 ? low : 255 - low;
}

// "UASTC Weight Tables".
unsigned weight_value(unsigned bits, unsigned stored) {
    static const std::vector<std::vector<unsigned>> tables = {
        {},
        {0, 64},
        {0, 21, 43, 64},
        {0, 9, 18, 27, 37, 46, 55, 64},
        {0, 4, 8, 12, 17, 21, 25, 29, 35, 39, 43, 47, 52, 56, 60, 64},
        {0,  2,  4,  6,  8,  10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30,
         34, 36, 38, 40, 42, 44, 46, 48, 50, 52, 54, 56, 58, 60, 62, 64}};
    return tables[bits][stored];
}

uint8_t interpolate(unsigned low, unsigned high, unsigned weight) {
    low = low << 8 | low;
    high = high << 8 | high;
    return static_cast<uint8_t>((low * (64 - weight) + high * weight + 32) >> 6 >> 8);
}

struct Block {
    std::array<std::byte, 16> bytes{};
    std::array<Rgba8, 16> texels;
    void set(int at, unsigned count, unsigned value) {
        for (unsigned i = 0; i < count; ++i) {
            const auto bit = static_cast<unsigned>(at) + i;
            const auto mask = static_cast<std::byte>(1u << bit % 8);
            bytes[bit / 8] = (value >> i & 1u) != 0 ? bytes[bit / 8] | mask : bytes[bit / 8] & ~mask;
        }
    }
};

Block random_block(unsigned mode, unsigned partition, std::mt19937& random) {
    const Layout& layout = layouts[mode];
    const auto below = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
    Block block;
    for (std::byte& byte : block.bytes)
        byte = static_cast<std::byte>(below(256));  // hints and what nobody reads
    block.set(0, layout.code_bits, layout.code);
    const std::string& subsets = (*layout.partitions)[partition];
    if (layout.partition_at >= 0)
        block.set(layout.partition_at, static_cast<unsigned>(layout.partition_bits), partition);
    unsigned second_plane = 3;
    if (layout.plane_at >= 0) block.set(layout.plane_at, 2, second_plane = below(4));

    // Endpoints: digits in groups, then the remaining bits of each.
    const auto subset_count = static_cast<unsigned>(*std::max_element(subsets.begin(), subsets.end()) - '0') + 1;
    std::vector<unsigned> endpoints(2 * layout.components * subset_count);
    for (size_t i = 0; i < endpoints.size(); ++i) {
        endpoints[i] = below(layout.radix << layout.bits);
        block.set(layout.bits_at + static_cast<int>(i * layout.bits), layout.bits, endpoints[i]);
    }
    if (layout.radix != 1) {
        const size_t group = layout.radix == 3 ? 5 : 3;
        int at = layout.digits_at;
        for (size_t first = 0; first < endpoints.size(); first += group) {
            unsigned packed = 0, states = 1;
            for (size_t i = first; i < std::min(first + group, endpoints.size()); ++i, states *= layout.radix)
                packed += (endpoints[i] >> layout.bits) * states;
            unsigned width = 0;
            while (1u << width < states)
                ++width;
            block.set(at, width, packed);
            at += static_cast<int>(width);
        }
    }

    // Weights: the first texel of each subset has one bit less.
    int at = layout.weights_at;
    for (size_t i = 0; i < 16; ++i) {
        const bool first_of_subset = subsets.find(subsets[i]) == i;
        const unsigned width = layout.weight_bits - (first_of_subset ? 1 : 0);
        unsigned weights[2] = {};
        for (unsigned plane = 0; plane < layout.planes; ++plane) {
            weights[plane] = below(1u << width);
            block.set(at, width, weights[plane]);
            at += static_cast<int>(width);
        }
        for (unsigned channel = 0; channel < 4; ++channel) {
            const unsigned component = layout.components == 2 ? (channel == 3 ? 1 : 0) : channel;
            if (component >= layout.components) {
                block.texels[i][static_cast<int>(channel)] = 255;
                continue;
            }
            const unsigned plane = layout.planes == 2 && channel == second_plane ? 1 : 0;
            const size_t pair = 2 * (layout.components * static_cast<unsigned>(subsets[i] - '0') + component);
            block.texels[i][static_cast<int>(channel)] =
                interpolate(endpoint_value(layout.radix, layout.bits, endpoints[pair]),
                            endpoint_value(layout.radix, layout.bits, endpoints[pair + 1]),
                            weight_value(layout.weight_bits, weights[plane]));
        }
    }
    return block;
}

TEST(Uastc, BlocksOfEveryModeAndPartition) {
    std::mt19937 random(7);
    for (unsigned mode = 0; mode < 19; ++mode) {
        if (mode == 8) continue;
        const auto partitions = static_cast<unsigned>(layouts[mode].partitions->size());
        for (unsigned trial = 0; trial < 300; ++trial) {
            const Block block = random_block(mode, trial % partitions, random);
            std::array<Rgba8, 16> texels;
            decode_uastc_block(block.bytes, texels);
            ASSERT_EQ(texels, block.texels) << "mode " << mode << ", partition " << trial % partitions;
        }
    }
}

TEST(Uastc, SolidBlocksAndReservedOnes) {
    const test::Bytes solid = test::solid_uastc_block(1, 127, 200, 255);
    std::array<Rgba8, 16> texels;
    decode_uastc_block(std::span(solid).first<16>(), texels);
    for (const Rgba8& texel : texels)
        EXPECT_EQ(texel, Rgba8(1, 127, 200, 255));

    Block reserved_mode;
    reserved_mode.set(0, 7, 0x45);
    EXPECT_THROW(decode_uastc_block(reserved_mode.bytes, texels), ImageError);
    // One past the last partition of each list.
    for (const unsigned mode : {2u, 3u, 7u}) {
        Block block;
        block.set(0, layouts[mode].code_bits, layouts[mode].code);
        const auto past = static_cast<unsigned>(layouts[mode].partitions->size());
        block.set(layouts[mode].partition_at, static_cast<unsigned>(layouts[mode].partition_bits), past);
        EXPECT_THROW(decode_uastc_block(block.bytes, texels), ImageError) << "mode " << mode;
        block.set(layouts[mode].partition_at, static_cast<unsigned>(layouts[mode].partition_bits), past - 1);
        EXPECT_NO_THROW(decode_uastc_block(block.bytes, texels)) << "mode " << mode;
    }
}

}  // namespace
}  // namespace candela
