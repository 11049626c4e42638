// SPDX-License-Identifier: MIT
// The GLB container: chunks lie in the file, one after the other.
#include "renderer/io/glb_container.h"

#include <stdexcept>

#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace candela;
    const std::span<const std::byte> bytes = fuzz::bytes_of(data, size);
    looks_like_glb(bytes);
    try {
        const GlbChunks chunks = parse_glb(bytes);
        const char* begin = reinterpret_cast<const char*>(data);
        const char* json = chunks.json.data();
        fuzz::require(json >= begin && json + chunks.json.size() <= begin + size, "the JSON chunk lies in the file");
        if (chunks.bin && !chunks.bin->empty()) {
            const char* bin = reinterpret_cast<const char*>(chunks.bin->data());
            fuzz::require(bin >= json + chunks.json.size() && bin + chunks.bin->size() <= begin + size,
                          "the BIN chunk lies in the file, behind the JSON");
        }
    } catch (const std::runtime_error&) {
        return 0;
    }
    return 0;
}
