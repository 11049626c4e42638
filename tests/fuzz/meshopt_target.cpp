// SPDX-License-Identifier: MIT
// Meshopt streams. Input: mode, filter, stride, count (two bytes), then the stream.
#include "renderer/io/meshopt.h"

#include <stdexcept>

#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace candela;
    constexpr size_t header = 5;
    if (size < header) return 0;
    // The stream is copied, so that reading past its end is seen.
    const std::vector<std::byte> stream(reinterpret_cast<const std::byte*>(data) + header,
                                        reinterpret_cast<const std::byte*>(data) + size);
    MeshoptView view;
    view.encoded = stream;
    view.mode = static_cast<MeshoptMode>(data[0] % 3);
    view.filter = static_cast<MeshoptFilter>(data[1] % 5);
    view.stride = data[2];
    view.count = data[3] + 256u * data[4];
    try {
        fuzz::require(decode_meshopt(view).size() == view.count * view.stride, "the size is as declared");
    } catch (const std::runtime_error&) {
        return 0;
    }
    return 0;
}
