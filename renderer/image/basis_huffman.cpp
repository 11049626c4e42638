// SPDX-License-Identifier: MIT
#include "renderer/image/basis_huffman.h"

namespace candela {

namespace {

[[noreturn]] void throw_bad_table(const char* what) {
    throw ImageError(std::string("broken KTX2: a Huffman table ") + what);
}

uint32_t reversed(uint32_t code, unsigned length) {
    uint32_t out = 0;
    for (unsigned i = 0; i < length; ++i)
        out |= (code >> i & 1u) << (length - 1 - i);
    return out;
}

}  // namespace

HuffmanTable::HuffmanTable(std::span<const uint8_t> lengths) {
    for (const uint8_t length : lengths) {
        if (length > max_length) throw_bad_table("has a code of more than 16 bits");
        if (length != 0) ++count_[length];
    }

    // The first code of each length follows the last of the length before, with a zero appended.
    uint32_t code = 0, index = 0, space = 0;
    for (unsigned length = 1; length <= max_length; ++length) {
        code = (code + count_[length - 1]) << 1;
        first_code_[length] = code;
        first_index_[length] = index;
        index += count_[length];
        space += count_[length] << (max_length - length);
    }
    if (index == 0) return;
    if (space != 1u << max_length && index != 1) throw_bad_table("does not fill its code space");

    // Symbols in the order of their codes, and the short codes by their bits as they come out of the stream.
    symbols_.resize(index);
    fast_.resize(size_t{1} << fast_bits);
    std::array<uint32_t, max_length + 1> used{};
    for (size_t symbol = 0; symbol < lengths.size(); ++symbol) {
        const unsigned length = lengths[symbol];
        if (length == 0) continue;
        const uint32_t rank = used[length]++;
        symbols_[first_index_[length] + rank] = static_cast<uint16_t>(symbol);
        if (length > fast_bits) continue;
        for (uint32_t at = reversed(first_code_[length] + rank, length); at < fast_.size(); at += 1u << length)
            fast_[at] = {static_cast<uint16_t>(symbol), static_cast<uint16_t>(length)};
    }
}

uint32_t HuffmanTable::decode(BitReader& bits) const {
    if (symbols_.empty()) throw ImageError("broken KTX2: a symbol is coded by an empty Huffman table");
    const uint32_t next = bits.peek(max_length);
    if (const Entry entry = fast_[next & ((1u << fast_bits) - 1)]; entry.length != 0) {
        bits.skip(entry.length);
        return entry.symbol;
    }
    // Longer codes bit by bit, the highest bit of the code first.
    uint32_t code = 0;
    for (unsigned length = 1; length <= max_length; ++length) {
        code = code << 1 | (next >> (length - 1) & 1u);
        if (length <= fast_bits || code < first_code_[length] || code - first_code_[length] >= count_[length]) continue;
        bits.skip(length);
        return symbols_[first_index_[length] + code - first_code_[length]];
    }
    throw ImageError("broken KTX2: a code is in no Huffman table");
}

HuffmanTable read_huffman_table(BitReader& bits) {
    // The lengths' own code comes first, in an order that leaves the rare ones to the end.
    constexpr uint8_t order[21] = {17, 18, 19, 20, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15, 16};
    const uint32_t symbols = bits.take(14);
    if (symbols == 0) return {};  // what encoders write for a table that nothing uses
    const uint32_t codes = bits.take(5);
    if (codes == 0 || codes > std::size(order)) throw_bad_table("is described by no code lengths, or by too many");
    uint8_t length_lengths[std::size(order)] = {};
    for (uint32_t i = 0; i < codes; ++i)
        length_lengths[order[i]] = static_cast<uint8_t>(bits.take(3));
    const HuffmanTable length_table(length_lengths);

    std::vector<uint8_t> lengths;
    lengths.reserve(symbols);
    const auto append = [&](uint8_t length, uint32_t count) {
        if (count > symbols - lengths.size()) throw_bad_table("has more code lengths than symbols");
        lengths.insert(lengths.end(), count, length);
    };
    const auto repeat_last = [&](uint32_t count) {
        if (lengths.empty() || lengths.back() == 0) throw_bad_table("repeats a code length that is not there");
        append(lengths.back(), count);
    };
    while (lengths.size() < symbols) {
        switch (const uint32_t symbol = length_table.decode(bits)) {
            case 17:
                append(0, 3 + bits.take(3));
                break;
            case 18:
                append(0, 11 + bits.take(7));
                break;
            case 19:
                repeat_last(3 + bits.take(2));
                break;
            case 20:
                repeat_last(7 + bits.take(7));
                break;
            default:
                append(static_cast<uint8_t>(symbol), 1);
        }
    }
    return HuffmanTable(lengths);
}

}  // namespace candela
