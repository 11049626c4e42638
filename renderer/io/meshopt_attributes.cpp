// SPDX-License-Identifier: MIT
// Formats: KHR_meshopt_compression, appendix A "Mode 0: attributes" and appendix B "Filter 4: color".
#include "renderer/io/meshopt_attributes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace candela {
namespace {

constexpr uint8_t version_1 = 0xa1;
constexpr uint64_t group_elements = 16;
constexpr uint64_t smallest_tail = 24;

class AttributesDecoder {
  public:
    AttributesDecoder(std::span<const std::byte> body, std::span<const std::byte> baseline,
                      std::span<const std::byte> channels)
        : body_(body), channels_(channels), stride_(baseline.size()) {
        std::memcpy(last_.data(), baseline.data(), baseline.size());
    }

    bool decode(uint64_t count, std::byte* out) {
        const uint64_t block_elements = std::min<uint64_t>((8192 / stride_) & ~(group_elements - 1), 256);
        while (count > 0) {
            const uint64_t elements = std::min(count, block_elements);
            if (!decode_block(elements, out)) return false;
            std::memcpy(last_.data(), out + (elements - 1) * stride_, stride_);
            out += elements * stride_;
            count -= elements;
        }
        return body_.empty();
    }

  private:
    // The next bytes of the stream, or nothing where it ends before.
    std::span<const std::byte> take(uint64_t bytes) {
        if (bytes > body_.size()) return {};
        const auto taken = body_.first(bytes);
        body_ = body_.subspan(bytes);
        return taken;
    }

    // One block holds each byte of the elements by itself, as differences.
    bool decode_block(uint64_t elements, std::byte* out) {
        const auto control = take(stride_ / 4);
        if (control.empty()) return false;
        for (uint64_t k = 0; k < stride_; k += 4) {
            for (uint64_t j = 0; j < 4; ++j) {
                const int mode = (std::to_integer<int>(control[k / 4]) >> (2 * j)) & 3;
                if (!decode_bytes(mode, elements, deltas_[j])) return false;
            }
            if (!undo_deltas(std::to_integer<uint32_t>(channels_[k / 4]), elements, k, out)) return false;
        }
        return true;
    }

    bool decode_bytes(int control_mode, uint64_t elements, std::array<uint8_t, 256>& out) {
        if (control_mode == 2) {
            std::fill_n(out.begin(), elements, uint8_t{0});
            return true;
        }
        if (control_mode == 3) {
            const auto literal = take(elements);
            if (literal.empty()) return false;
            std::memcpy(out.data(), literal.data(), elements);
            return true;
        }
        constexpr int bits_of[2][4] = {{0, 1, 2, 4}, {1, 2, 4, 8}};
        const uint64_t groups = (elements + group_elements - 1) / group_elements;
        const auto header = take((groups + 3) / 4);
        if (header.empty()) return false;
        for (uint64_t g = 0; g < groups; ++g) {
            const int selector = (std::to_integer<int>(header[g / 4]) >> (2 * (g % 4))) & 3;
            if (!decode_group(bits_of[control_mode][selector], out.data() + g * group_elements)) return false;
        }
        return true;
    }

    // 16 values of that many bits; those with all bits set follow as whole bytes.
    bool decode_group(int bits, uint8_t* out) {
        if (bits == 0) {
            std::fill_n(out, group_elements, uint8_t{0});
            return true;
        }
        const auto packed = take(group_elements * static_cast<uint64_t>(bits) / 8);
        if (packed.empty()) return false;
        if (bits == 8) {
            std::memcpy(out, packed.data(), group_elements);
            return true;
        }
        const int per_byte = 8 / bits;
        const int sentinel = (1 << bits) - 1;
        for (uint64_t i = 0; i < group_elements; ++i) {
            const int byte = std::to_integer<int>(packed[i / static_cast<uint64_t>(per_byte)]);
            const int place = static_cast<int>(i % static_cast<uint64_t>(per_byte));
            // Single bits run from the least significant on, wider values from the most significant.
            const int shift = bits == 1 ? place : 8 - bits * (place + 1);
            int value = (byte >> shift) & sentinel;
            if (value == sentinel) {
                const auto whole = take(1);
                if (whole.empty()) return false;
                value = std::to_integer<int>(whole[0]);
            }
            out[i] = static_cast<uint8_t>(value);
        }
        return true;
    }

    // Sums up the differences of the four bytes of a channel, whose mode says what they are differences of.
    bool undo_deltas(uint32_t channel, uint64_t elements, uint64_t k, std::byte* out) {
        const uint32_t mode = channel & 15;
        const uint32_t rotation = channel >> 4;
        if (mode > 2 || (mode < 2 && rotation != 0)) return false;
        uint32_t last = 0;
        std::memcpy(&last, last_.data() + k, 4);
        for (uint64_t i = 0; i < elements; ++i) {
            const uint32_t delta = deltas_[0][i] | uint32_t{deltas_[1][i]} << 8 | uint32_t{deltas_[2][i]} << 16 |
                                   uint32_t{deltas_[3][i]} << 24;
            if (mode == 0) {
                last = sum<8>(last, delta);
            } else if (mode == 1) {
                last = sum<16>(last, delta);
            } else {
                last ^= std::rotr(delta, static_cast<int>(rotation));
            }
            std::memcpy(out + i * stride_ + k, &last, 4);
        }
        return true;
    }

    // Each of the 32 / bits parts by itself, the differences zigzag-encoded.
    template <uint32_t bits>
    static uint32_t sum(uint32_t values, uint32_t zigzag) {
        constexpr uint32_t mask = (1u << bits) - 1;
        uint32_t out = 0;
        for (uint32_t shift = 0; shift < 32; shift += bits) {
            const uint32_t z = (zigzag >> shift) & mask;
            const uint32_t delta = (z & 1) != 0 ? ~(z >> 1) : z >> 1;
            out |= (((values >> shift) + delta) & mask) << shift;
        }
        return out;
    }

    std::span<const std::byte> body_, channels_;
    uint64_t stride_;
    std::array<std::byte, 256> last_{};
    std::array<std::array<uint8_t, 256>, 4> deltas_{};
};

template <typename Unsigned>
void decode_colors(std::span<std::byte> elements) {
    constexpr auto largest = static_cast<float>(static_cast<Unsigned>(~Unsigned{0}));
    for (uint64_t at = 0; at + 4 * sizeof(Unsigned) <= elements.size(); at += 4 * sizeof(Unsigned)) {
        Unsigned in[4];
        std::memcpy(in, elements.data() + at, sizeof(in));
        // The highest bit of alpha tells how many bits there are; without one nothing can be read from it.
        const auto scale_bits = std::max<unsigned>(std::bit_width(static_cast<uint32_t>(in[3])), 1);
        const int one = (1 << scale_bits) - 1;
        // Two's complement of as many bits as a component has.
        const auto signed_value = [](Unsigned value) {
            constexpr int unused_bits = 32 - 8 * static_cast<int>(sizeof(Unsigned));
            return static_cast<int32_t>(uint32_t{value} << unused_bits) >> unused_bits;
        };
        const int y = in[0], co = signed_value(in[1]), cg = signed_value(in[2]);
        int alpha = in[3] & (one >> 1);
        alpha = (alpha << 1) | (alpha & 1);
        const int rgba[4] = {y + co - cg, y + cg, y - co - cg, alpha};
        const float scale = largest / static_cast<float>(one);
        Unsigned out[4];
        for (int c = 0; c < 4; ++c) {
            const float value = std::round(static_cast<float>(rgba[c]) * scale);
            out[c] = static_cast<Unsigned>(std::clamp(value, 0.0f, largest));
        }
        std::memcpy(elements.data() + at, out, sizeof(out));
    }
}

}  // namespace

bool is_attributes_v1(std::span<const std::byte> encoded) {
    return !encoded.empty() && std::to_integer<uint8_t>(encoded[0]) == version_1;
}

bool decode_attributes_v1(std::span<const std::byte> encoded, uint64_t count, uint64_t stride,
                          std::span<std::byte> out) {
    // Header, blocks, padding, the element before the first, the modes of the channels.
    const uint64_t channels = stride / 4;
    const uint64_t tail = std::max(stride + channels, smallest_tail);
    if (!is_attributes_v1(encoded) || encoded.size() < 1 + tail || out.size() < count * stride) return false;
    const auto end = encoded.last(stride + channels);
    AttributesDecoder decoder(encoded.subspan(1, encoded.size() - 1 - tail), end.first(stride), end.last(channels));
    return decoder.decode(count, out.data());
}

void decode_color_filter(std::span<std::byte> elements, uint64_t stride) {
    if (stride == 4) {
        decode_colors<uint8_t>(elements);
    } else {
        decode_colors<uint16_t>(elements);
    }
}

}  // namespace candela
