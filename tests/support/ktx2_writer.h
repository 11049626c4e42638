// SPDX-License-Identifier: MIT
// Writes KTX2 files, lawful and not, from their parts: KTX File Format Specification 2.0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace candela::test {

using Bytes = std::vector<std::byte>;

inline void append_number(Bytes& out, uint64_t value, size_t bytes) {
    for (size_t i = 0; i < bytes; ++i, value >>= 8)
        out.push_back(static_cast<std::byte>(value & 255));
}

inline constexpr int model_etc1s = 163, model_uastc = 166;

struct Ktx2Parts {
    uint32_t vk_format = 0, width = 4, height = 4, depth = 0, layers = 0, faces = 1, supercompression = 0;
    int model = model_uastc, transfer = 2, flags = 0;
    std::vector<int> channels = {3};  // of each sample; 3: RGBA of UASTC
    std::vector<std::pair<std::string, std::string>> texts = {{"KTXorientation", "rd"}};
    Bytes global_data;
    std::vector<Bytes> levels;           // the largest first, as stored
    std::vector<uint64_t> uncompressed;  // of each level; empty: as long as stored
};

inline Bytes write_ktx2(const Ktx2Parts& parts) {
    Bytes descriptor;
    const size_t block_bytes = 24 + 16 * parts.channels.size();
    append_number(descriptor, 4 + block_bytes, 4);
    append_number(descriptor, 0, 4);
    append_number(descriptor, 2, 2);
    append_number(descriptor, block_bytes, 2);
    append_number(descriptor, static_cast<uint64_t>(parts.model), 1);
    append_number(descriptor, 1, 1);
    append_number(descriptor, static_cast<uint64_t>(parts.transfer), 1);
    append_number(descriptor, static_cast<uint64_t>(parts.flags), 1);
    append_number(descriptor, 0x0303, 4);
    append_number(descriptor, 0, 8);
    for (const int channel : parts.channels) {
        append_number(descriptor, 0x7f0000u | static_cast<uint64_t>(channel) << 24, 4);
        append_number(descriptor, 0, 8);
        append_number(descriptor, 0xffffffff, 4);
    }
    Bytes texts;
    for (const auto& [key, value] : parts.texts) {
        append_number(texts, key.size() + value.size() + 2, 4);
        for (const std::string& text : {key, value}) {
            for (const char c : text)
                texts.push_back(static_cast<std::byte>(c));
            texts.push_back(std::byte{0});
        }
        texts.resize((texts.size() + 3) / 4 * 4);
    }

    const size_t index_end = 80 + 24 * parts.levels.size();
    Bytes out;
    for (const char c : {'\xab', 'K', 'T', 'X', ' ', '2', '0', '\xbb', '\r', '\n', '\x1a', '\n'})
        out.push_back(static_cast<std::byte>(c));
    for (const uint32_t field : {parts.vk_format, 1u, parts.width, parts.height, parts.depth, parts.layers, parts.faces,
                                 static_cast<uint32_t>(parts.levels.size()), parts.supercompression})
        append_number(out, field, 4);
    append_number(out, index_end, 4);
    append_number(out, descriptor.size(), 4);
    append_number(out, texts.empty() ? 0 : index_end + descriptor.size(), 4);
    append_number(out, texts.size(), 4);
    size_t at = index_end + descriptor.size() + texts.size();
    append_number(out, parts.global_data.empty() ? 0 : at, 8);
    append_number(out, parts.global_data.size(), 8);
    at += parts.global_data.size();
    for (size_t i = 0; i < parts.levels.size(); ++i) {
        append_number(out, at, 8);
        append_number(out, parts.levels[i].size(), 8);
        append_number(out, parts.uncompressed.empty() ? parts.levels[i].size() : parts.uncompressed[i], 8);
        at += parts.levels[i].size();
    }
    const auto append = [&](const Bytes& section) { out.insert(out.end(), section.begin(), section.end()); };
    append(descriptor);
    append(texts);
    append(parts.global_data);
    for (const Bytes& level : parts.levels)
        append(level);
    return out;
}

// A block of UASTC mode 8: one colour.
inline Bytes solid_uastc_block(uint32_t red, uint32_t green, uint32_t blue, uint32_t alpha) {
    Bytes out;
    append_number(out,
                  0x17u | uint64_t{red} << 5 | uint64_t{green} << 13 | uint64_t{blue} << 21 | uint64_t{alpha} << 29, 8);
    append_number(out, 0, 8);
    return out;
}

}  // namespace candela::test
