// SPDX-License-Identifier: MIT
#include "renderer/image/basis_lz.h"

#include "renderer/image/byte_order.h"

namespace candela {

namespace {

[[noreturn]] void throw_broken(const std::string& what) {
    throw ImageError("broken KTX2: " + what);
}

std::span<const std::byte> section(std::span<const std::byte> bytes, uint64_t offset, uint64_t length,
                                   const char* name) {
    if (offset > bytes.size() || length > bytes.size() - offset)
        throw_broken(std::string(name) + " lies outside of its data");
    return bytes.subspan(offset, length);
}

// Khronos Data Format Specification, table "ETC1 intensity modifiers": the smaller and the larger of each pair.
constexpr int modifiers[8][2] = {{2, 8}, {5, 17}, {9, 29}, {13, 42}, {18, 60}, {24, 80}, {33, 106}, {47, 183}};

// The four colours that an endpoint stands for: its base colour widened to 8 bits, darker and lighter.
std::array<Rgba8, 4> palette_of(const std::array<uint32_t, 3>& base, uint32_t intensity) {
    const auto& [near, far] = modifiers[intensity];
    const int offsets[4] = {-far, -near, near, far};
    std::array<Rgba8, 4> out;
    for (size_t k = 0; k < 4; ++k) {
        out[k].a = 255;
        for (int c = 0; c < 3; ++c) {
            const uint32_t five = base[static_cast<size_t>(c)];
            const auto eight = static_cast<int>(five << 3 | five >> 2);
            out[k][c] = static_cast<uint8_t>(std::clamp(eight + offsets[k], 0, 255));
        }
    }
    return out;
}

// Recently used selectors: a used one moves halfway to the front, a new one overwrites the back half in turn.
class SelectorHistory {
  public:
    explicit SelectorHistory(size_t size) : values_(size), rover_(size / 2) {}
    void add(uint32_t value) {
        if (values_.empty()) return;
        values_[rover_++] = value;
        if (rover_ == values_.size()) rover_ = values_.size() / 2;
    }
    uint32_t use(size_t index) {
        if (index >= values_.size()) throw_broken("a selector lies beyond the history of selectors");
        const uint32_t value = values_[index];
        std::swap(values_[index], values_[index / 2]);
        return value;
    }

  private:
    std::vector<uint32_t> values_;
    size_t rover_;
};

// Numbers in chunks of `digit_bits` bits with one more that says whether another chunk follows.
uint32_t take_chunked(BitReader& bits, unsigned digit_bits) {
    uint32_t value = 0;
    for (unsigned shift = 0; shift < 32; shift += digit_bits) {
        const uint32_t chunk = bits.take(digit_bits + 1);
        value |= (chunk & ((1u << digit_bits) - 1)) << shift;
        if (chunk >> digit_bits == 0) return value;
    }
    throw_broken("a run length has more than 32 bits");
}

}  // namespace

// Reads the blocks of one slice in raster order.
class SliceReader {
  public:
    SliceReader(const BasisLz& book, std::span<const std::byte> bytes, uint32_t columns)
        : book_(book),
          bits_(bytes),
          history_(book.history_size_),
          row_above_(columns),
          row_(columns),
          predictions_below_((columns + 1) / 2) {}

    // Indices into palettes_ and selectors_, in range.
    struct Block {
        uint32_t endpoint, selector;
    };
    Block next(uint32_t x, uint32_t y) {
        if (x == 0) std::swap(row_, row_above_);
        const uint32_t endpoint = next_endpoint(x, y);
        row_[x] = left_ = endpoint;
        const uint32_t selector = next_selector();
        if (endpoint >= book_.palettes_.size()) throw_broken("an endpoint index is out of range");
        if (selector >= book_.selectors_.size()) throw_broken("a selector index is out of range");
        return {endpoint, selector};
    }

  private:
    uint32_t next_endpoint(uint32_t x, uint32_t y);
    void read_predictions(uint32_t x, uint32_t y);
    uint32_t next_selector();

    const BasisLz& book_;
    BitReader bits_;
    SelectorHistory history_;
    std::vector<uint32_t> row_above_, row_;    // endpoint indices
    std::vector<uint32_t> predictions_below_;  // of each 2×2 group, for its lower two blocks
    uint32_t predictions_ = 0, last_predictions_ = 0, prediction_repeats_ = 0;
    uint32_t left_ = 0;
    uint32_t selector_repeats_ = 0;
};

// One symbol tells for a group of 2×2 blocks, two bits each, where their endpoints come from.
void SliceReader::read_predictions(uint32_t x, uint32_t y) {
    constexpr uint32_t repeat_symbol = 256, least_repeats = 3;
    if (y % 2 == 1) {
        predictions_ = predictions_below_[x / 2];
        return;
    }
    if (prediction_repeats_ > 0) {
        --prediction_repeats_;
    } else if (const uint32_t symbol = book_.endpoint_prediction_.decode(bits_); symbol == repeat_symbol) {
        prediction_repeats_ = take_chunked(bits_, 4) + least_repeats - 1;
    } else {
        last_predictions_ = symbol;
    }
    predictions_ = last_predictions_;
    predictions_below_[x / 2] = predictions_ >> 4 & 15u;
}

uint32_t SliceReader::next_endpoint(uint32_t x, uint32_t y) {
    if (x % 2 == 0) read_predictions(x, y);
    const uint32_t prediction = predictions_ & 3u;
    predictions_ >>= 2;
    constexpr const char* outside = "an endpoint is predicted from outside of the picture";
    switch (prediction) {
        case 0:
            if (x == 0) throw_broken(outside);
            return left_;
        case 1:
            if (y == 0) throw_broken(outside);
            return row_above_[x];
        case 2:
            if (x == 0 || y == 0) throw_broken(outside);
            return row_above_[x - 1];
        default: {
            // The difference from the block before, modulo the size of the codebook.
            const auto count = static_cast<uint32_t>(book_.palettes_.size());
            const uint32_t index = left_ + book_.endpoint_delta_.decode(bits_);
            return index >= count ? index - count : index;
        }
    }
}

uint32_t SliceReader::next_selector() {
    constexpr uint32_t least_repeats = 3, open_ended_run = 63;
    const auto count = static_cast<uint32_t>(book_.selectors_.size());
    if (selector_repeats_ > 0) {
        --selector_repeats_;
        return history_.use(0);
    }
    const uint32_t symbol = book_.selector_.decode(bits_);
    if (symbol < count) {
        history_.add(symbol);
        return symbol;
    }
    // Beyond the codebook the symbols mean places of the history, and the last one a run of its first place.
    if (symbol != count + book_.history_size_) return history_.use(symbol - count);
    const uint32_t run = book_.selector_run_.decode(bits_);
    selector_repeats_ = (run == open_ended_run ? take_chunked(bits_, 7) : run) + least_repeats - 1;
    return history_.use(0);
}

BasisLz::BasisLz(std::span<const std::byte> data, size_t pictures) {
    constexpr size_t header_bytes = 20, descriptor_bytes = 20;
    const auto header = section(data, 0, header_bytes, "the header of the codebooks");
    const size_t endpoint_count = read_u16(header, 0), selector_count = read_u16(header, 2);
    const uint64_t endpoint_bytes = read_u32(header, 4), selector_bytes = read_u32(header, 8);
    const uint64_t table_bytes = read_u32(header, 12);

    const auto descriptors = section(data, header_bytes, pictures * descriptor_bytes, "the list of slices");
    for (size_t i = 0; i < pictures; ++i) {
        const auto at = descriptors.subspan(i * descriptor_bytes, descriptor_bytes);
        pictures_.push_back({read_u32(at, 0), read_u32(at, 4), read_u32(at, 8), read_u32(at, 12), read_u32(at, 16)});
    }
    uint64_t offset = header_bytes + descriptors.size();
    read_endpoints(section(data, offset, endpoint_bytes, "the codebook of endpoints"), endpoint_count);
    offset += endpoint_bytes;
    read_selectors(section(data, offset, selector_bytes, "the codebook of selectors"), selector_count);
    offset += selector_bytes;
    read_tables(section(data, offset, table_bytes, "the Huffman tables"));
}

// "ETC1S Endpoint Codebooks": differences from the entry before, by tables that depend on its value.
void BasisLz::read_endpoints(std::span<const std::byte> bytes, size_t count) {
    BitReader bits(bytes);
    HuffmanTable color_delta[3];
    for (HuffmanTable& table : color_delta)
        table = read_huffman_table(bits);
    const HuffmanTable intensity_delta = read_huffman_table(bits);
    const bool grey = bits.take(1) != 0;

    palettes_.reserve(count);
    std::array<uint32_t, 3> color{16, 16, 16};
    uint32_t intensity = 0;
    for (size_t i = 0; i < count; ++i) {
        intensity = (intensity + intensity_delta.decode(bits)) & 7u;
        for (size_t c = 0; c < (grey ? 1u : 3u); ++c) {
            const size_t range = color[c] <= 9 ? 0 : color[c] <= 21 ? 1 : 2;
            color[c] = (color[c] + color_delta[range].decode(bits)) & 31u;
        }
        if (grey) color[1] = color[2] = color[0];
        palettes_.push_back(palette_of(color, intensity));
    }
}

// "ETC1S Selector Codebooks": raw, or all but the first as exclusive-or with the entry before.
void BasisLz::read_selectors(std::span<const std::byte> bytes, size_t count) {
    BitReader bits(bytes);
    if (bits.take(2) != 0) throw_broken("the codebook of selectors is of an unknown kind");
    const bool raw = bits.take(1) != 0;
    const HuffmanTable delta = raw ? HuffmanTable{} : read_huffman_table(bits);
    selectors_.reserve(count);
    std::array<uint8_t, 4> rows{};
    for (size_t i = 0; i < count; ++i) {
        for (uint8_t& row : rows) {
            row = raw || i == 0 ? static_cast<uint8_t>(bits.take(8)) : static_cast<uint8_t>(row ^ delta.decode(bits));
        }
        selectors_.push_back(rows);
    }
}

// "ETC1S Slice Huffman Tables".
void BasisLz::read_tables(std::span<const std::byte> bytes) {
    BitReader bits(bytes);
    endpoint_prediction_ = read_huffman_table(bits);
    endpoint_delta_ = read_huffman_table(bits);
    selector_ = read_huffman_table(bits);
    selector_run_ = read_huffman_table(bits);
    history_size_ = bits.take(13);
}

ImageRgba8 BasisLz::decode(size_t picture, std::span<const std::byte> level, int width, int height,
                           SecondSlice second) const {
    const Slices& slices = pictures_.at(picture);
    constexpr uint32_t predicted_frame = 2;
    if ((slices.flags & predicted_frame) != 0) throw_broken("a picture depends on another frame of an animation");
    if ((slices.second_bytes != 0) != (second != SecondSlice::none))
        throw_broken("the number of slices is not that of its channels");

    ImageRgba8 out(width, height);
    const auto columns = static_cast<uint32_t>((width + 3) / 4), rows = static_cast<uint32_t>((height + 3) / 4);
    const auto read_slice = [&](std::span<const std::byte> bytes, const auto& store) {
        SliceReader reader(*this, bytes, columns);
        for (uint32_t y = 0; y < rows; ++y) {
            for (uint32_t x = 0; x < columns; ++x) {
                const auto [endpoint, selector] = reader.next(x, y);
                const std::array<Rgba8, 4>& palette = palettes_[endpoint];
                const int left = static_cast<int>(4 * x), top = static_cast<int>(4 * y);
                for (int row = 0; row < std::min(4, height - top); ++row) {
                    unsigned values = selectors_[selector][static_cast<size_t>(row)];
                    for (int column = 0; column < std::min(4, width - left); ++column, values >>= 2)
                        store(out(left + column, top + row), palette[values & 3u]);
                }
            }
        }
    };
    read_slice(section(level, slices.offset, slices.bytes, "a slice"),
               [](Rgba8& texel, const Rgba8& color) { texel = color; });
    if (second == SecondSlice::none) return out;
    // The three channels of a single one are equal; green is what other decoders take.
    const auto bytes = section(level, slices.second_offset, slices.second_bytes, "an alpha or green slice");
    if (second == SecondSlice::alpha) {
        read_slice(bytes, [](Rgba8& texel, const Rgba8& color) { texel.a = color.g; });
    } else {
        read_slice(bytes, [](Rgba8& texel, const Rgba8& color) { texel.g = color.g; });
    }
    return out;
}

}  // namespace candela
