// SPDX-License-Identifier: MIT
// What the fuzz targets share. A target is one LLVMFuzzerTestOneInput that any bytes may be given to: it must return,
// soon, with the promises of the code under test kept. libFuzzer calls it (preset fuzz), or replay_main.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
// Changes data in place; returns the new size, at most max_size. Of the fuzzer, or of replay_main.cpp.
extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);
// Targets whose inputs have a structure may have a mutator of their own.
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed);

namespace candela::fuzz {

// A promise that holds for every input.
inline void require(bool holds, const char* promise) {
    if (holds) return;
    std::fprintf(stderr, "a promise is broken: %s\n", promise);
    std::abort();
}

inline std::span<const std::byte> bytes_of(const uint8_t* data, size_t size) {
    return std::as_bytes(std::span(data, size));
}
inline std::string_view text_of(const uint8_t* data, size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

}  // namespace candela::fuzz
