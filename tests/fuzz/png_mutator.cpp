// SPDX-License-Identifier: MIT
// Changes a PNG and then writes the checksums of its chunks anew: without, hardly any change would get past them.
#include <zlib.h>

#include <cstring>

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

}  // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
    const size_t changed = LLVMFuzzerMutate(data, size, max_size);
    if (seed % 16 == 0) return changed;
    // A chunk: length, type, that many bytes, checksum of type and bytes.
    for (size_t at = 8; at + 12 <= changed;) {
        const size_t length = read_u32(data + at);
        if (length > changed - at - 12) break;
        write_u32(data + at + 8 + length,
                  static_cast<uint32_t>(crc32(0, data + at + 4, static_cast<uInt>(length + 4))));
        at += 12 + length;
    }
    return changed;
}
