// SPDX-License-Identifier: MIT
#include "renderer/image/uastc.h"

#include "renderer/image/byte_order.h"
#include "renderer/image/codec.h"
#include "renderer/image/uastc_tables.h"

namespace candela {

namespace {

using namespace uastc;

// The 128 bits of a block, taken from the lowest upwards.
class BlockBits {
  public:
    explicit BlockBits(std::span<const std::byte> block) : low_(read_u64(block, 0)), high_(read_u64(block, 8)) {}
    unsigned take(unsigned count) {  // 0 ≤ count ≤ 32
        const auto bits = static_cast<unsigned>(low_ & ((uint64_t{1} << count) - 1));
        low_ = low_ >> count | (high_ << (63 - count) << 1);
        high_ >>= count;
        return bits;
    }

  private:
    uint64_t low_, high_;
};

const Pattern& take_pattern(BlockBits& bits, const Mode& mode) {
    const auto choose = [&](std::span<const Pattern> patterns, unsigned count_bits) -> const Pattern& {
        const unsigned index = bits.take(count_bits);
        if (index >= patterns.size()) throw ImageError("broken KTX2: a UASTC block has a reserved partition");
        return patterns[index];
    };
    switch (mode.patterns) {
        case Patterns::two:
            return choose(patterns_of_two, 5);
        case Patterns::three:
            return choose(patterns_of_three, 4);
        case Patterns::two_of_three:
            return choose(patterns_of_two_of_three, 5);
        default:
            return patterns_of_one[0];
    }
}

unsigned subset_count(Patterns patterns) {
    return patterns == Patterns::one ? 1 : patterns == Patterns::three ? 3 : 2;
}

// Packed digits, five trits or three quints at a time, come before the plain bits of all values.
void take_endpoints(BlockBits& bits, unsigned mode_index, unsigned count, uint8_t* out) {
    const Mode& mode = modes[mode_index];
    unsigned digits[18] = {};
    if (mode.radix != 1) {
        // A last group of fewer trits has fewer bits; quints always come in threes.
        constexpr uint8_t trit_bits[] = {0, 2, 4, 5, 7, 8}, quint_bits = 7;
        const unsigned group = mode.radix == 3 ? 5 : 3;
        for (unsigned first = 0; first < count; first += group) {
            const unsigned here = std::min(group, count - first);
            unsigned packed = bits.take(mode.radix == 3 ? trit_bits[here] : quint_bits);
            for (unsigned k = 0; k < here; ++k, packed /= mode.radix)
                digits[first + k] = packed % mode.radix;
        }
    }
    for (unsigned i = 0; i < count; ++i)
        out[i] = endpoint_values[mode_index][digits[i] << mode.bits | bits.take(mode.bits)];
}

// R, G, B and A at both ends of a subset's line of colours.
struct Ends {
    std::array<uint16_t, 4> low{255, 255, 255, 255}, high{255, 255, 255, 255};
};

// From the subset's endpoint values; luminance stands for all three colours.
Ends ends_of(const uint8_t* values, unsigned components) {
    Ends out;
    for (unsigned channel = 0; channel < 4; ++channel) {
        const unsigned component = components == 2 ? channel / 3 : channel;
        if (component >= components) break;
        out.low[channel] = values[2 * component];
        out.high[channel] = values[2 * component + 1];
    }
    return out;
}

// "Weight Application" for all channels of all texels. Ends widened to 16 bits are 257 times the byte, so that the
// result (257 t + 32) >> 14, t = low · (64 − weight) + high · weight, needs no more than 16 bits when split at the
// byte.
void interpolate(const std::array<std::array<uint16_t, 4>, 16>& low,
                 const std::array<std::array<uint16_t, 4>, 16>& high,
                 const std::array<std::array<uint16_t, 4>, 16>& weight, std::span<Rgba8, 16> out) {
    for (size_t i = 0; i < 16; ++i) {
        for (size_t c = 0; c < 4; ++c) {
            const auto t = static_cast<uint16_t>(low[i][c] * (64 - weight[i][c]) + high[i][c] * weight[i][c]);
            out[i][static_cast<int>(c)] = static_cast<uint8_t>((t + ((t + 32) >> 8)) >> 6);
        }
    }
}

}  // namespace

void decode_uastc_block(std::span<const std::byte, uastc_block_bytes> block, std::span<Rgba8, 16> texels) {
    BlockBits bits(block);
    const unsigned mode_index = mode_of_bits[static_cast<unsigned>(block[0]) & 127u];
    if (mode_index >= mode_count) throw ImageError("broken KTX2: a UASTC block has the reserved mode");
    const Mode& mode = modes[mode_index];
    bits.take(mode.code_bits);
    if (mode_index == solid_mode) {
        Rgba8 color;
        for (int c = 0; c < 4; ++c)
            color[c] = static_cast<uint8_t>(bits.take(8));
        std::fill(texels.begin(), texels.end(), color);
        return;
    }

    // The fields in their order: hints, which channel the second plane's weights are for, partition, endpoints.
    bits.take(mode.hint_bits);
    unsigned second_plane_channel = 3;
    if (mode.planes == 2 && mode.components != 2) second_plane_channel = bits.take(2);
    const Pattern& pattern = take_pattern(bits, mode);
    const unsigned subsets = subset_count(mode.patterns);
    uint8_t endpoints[18];
    take_endpoints(bits, mode_index, 2u * mode.components * subsets, endpoints);
    Ends ends[3];
    for (unsigned s = 0; s < subsets; ++s)
        ends[s] = ends_of(endpoints + 2u * mode.components * s, mode.components);

    // One weight a texel and plane, raster order; that of a subset's first texel lacks its highest bit, which is zero.
    const auto& weights = weight_values[mode.weight_bits];
    std::array<std::array<uint16_t, 4>, 16> low, high, weight;
    for (size_t i = 0; i < 16; ++i) {
        const unsigned stored_bits = mode.weight_bits - (pattern.anchor[i] ? 1u : 0u);
        low[i] = ends[pattern.subset[i]].low;
        high[i] = ends[pattern.subset[i]].high;
        weight[i].fill(weights[bits.take(stored_bits)]);
        if (mode.planes == 2) weight[i][second_plane_channel] = weights[bits.take(stored_bits)];
    }
    interpolate(low, high, weight, texels);
}

ImageRgba8 decode_uastc(std::span<const std::byte> blocks, int width, int height) {
    ImageRgba8 out(width, height);
    std::array<Rgba8, 16> texels;
    for (int top = 0; top < height; top += 4) {
        for (int left = 0; left < width; left += 4) {
            decode_uastc_block(blocks.first<uastc_block_bytes>(), texels);
            blocks = blocks.subspan(uastc_block_bytes);
            const int rows = std::min(4, height - top), columns = std::min(4, width - left);
            for (int row = 0; row < rows; ++row)
                std::copy_n(texels.begin() + 4 * row, columns, &out(left, top + row));
        }
    }
    return out;
}

}  // namespace candela
