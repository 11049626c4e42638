// SPDX-License-Identifier: MIT
// Changes a PNG and then writes the checksums of its chunks anew: without, hardly any change would get past them. Often
// it is the rows of pixels that are changed, under the compression.
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "tests/fuzz/fuzz.h"

namespace {

// Big-endian, as PNG has it.
uint32_t read_u32(const uint8_t* at) {
    return uint32_t{at[0]} << 24 | uint32_t{at[1]} << 16 | uint32_t{at[2]} << 8 | at[3];
}
void write_u32(uint8_t* at, uint32_t value) {
    for (int i = 0; i < 4; ++i)
        at[i] = static_cast<uint8_t>(value >> (24 - 8 * i));
}

// A chunk: length, type, that many bytes, checksum of type and bytes. What follows the last whole one is left out.
struct Chunk {
    size_t at = 0, length = 0;
};

std::vector<Chunk> chunks_of(const uint8_t* data, size_t size) {
    std::vector<Chunk> out;
    for (size_t at = 8; at + 12 <= size;) {
        const size_t length = read_u32(data + at);
        if (length > size - at - 12) break;
        out.push_back({at, length});
        at += 12 + length;
    }
    return out;
}

void write_checksum(uint8_t* data, const Chunk& chunk) {
    write_u32(data + chunk.at + 8 + chunk.length,
              static_cast<uint32_t>(crc32(0, data + chunk.at + 4, static_cast<uInt>(chunk.length + 4))));
}

// Changes the rows and compresses them anew, into a single chunk at the end. 0: that does not work with this input.
size_t change_rows(uint8_t* data, size_t size, size_t max_size) {
    std::vector<uint8_t> compressed, rows(size_t{1} << 16);
    size_t head = 8;
    for (const Chunk& chunk : chunks_of(data, size)) {
        const uint8_t* body = data + chunk.at + 8;
        if (std::memcmp(data + chunk.at + 4, "IDAT", 4) == 0) {
            compressed.insert(compressed.end(), body, body + chunk.length);
        } else if (compressed.empty()) {
            head = chunk.at + 12 + chunk.length;
        }
    }
    uLongf count = rows.size();
    if (compressed.empty() || uncompress(rows.data(), &count, compressed.data(), compressed.size()) != Z_OK) return 0;
    const size_t changed = LLVMFuzzerMutate(rows.data(), count, std::min(rows.size(), count + 64));
    uLongf length = compressBound(changed);
    compressed.resize(length);
    if (compress2(compressed.data(), &length, rows.data(), changed, 1) != Z_OK) return 0;
    const size_t end = head + 12 + length;
    if (end + 12 > max_size) return 0;
    const auto append = [&](const Chunk& chunk, const char* name, const uint8_t* body) {
        write_u32(data + chunk.at, static_cast<uint32_t>(chunk.length));
        std::memcpy(data + chunk.at + 4, name, 4);
        std::copy(body, body + chunk.length, data + chunk.at + 8);
        write_checksum(data, chunk);
    };
    append({head, length}, "IDAT", compressed.data());
    append({end, 0}, "IEND", compressed.data());
    return end + 12;
}

}  // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
    if (seed % 2 == 1) {
        if (const size_t changed = change_rows(data, size, max_size); changed != 0) return changed;
    }
    const size_t changed = LLVMFuzzerMutate(data, size, max_size);
    if (seed % 16 == 0) return changed;
    for (const Chunk& chunk : chunks_of(data, changed))
        write_checksum(data, chunk);
    return changed;
}
