// SPDX-License-Identifier: MIT
// Runs a fuzz target without libFuzzer: every stored input as it is, then a number of changed ones, always the same.
// usage: replay_NAME [--changes N] FILE|FOLDER…
#include <algorithm>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz.h"

extern "C" __attribute__((weak)) size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size,
                                                                unsigned seed);

namespace {

using Bytes = std::vector<uint8_t>;

std::mt19937 random_bits(1);

size_t below(size_t n) {
    return n == 0 ? 0 : random_bits() % n;
}

std::vector<std::filesystem::path> files_below(const std::filesystem::path& place) {
    if (!std::filesystem::is_directory(place)) return {place};
    std::vector<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(place)) {
        if (entry.is_regular_file()) out.push_back(entry.path());
    }
    std::sort(out.begin(), out.end());
    return out;
}

Bytes read(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        std::fprintf(stderr, "%s: cannot be opened\n", file.c_str());
        std::exit(2);
    }
    return {std::istreambuf_iterator<char>(stream), {}};
}

// Nothing small may take long. Returns whether it did not; counts the processor's time, for others may use it too.
bool run(const Bytes& input, const std::string& name) {
    const std::clock_t start = std::clock();
    LLVMFuzzerTestOneInput(input.data(), input.size());
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (seconds < 20) return true;
    std::fprintf(stderr, "%s took %.1f s\n", name.c_str(), seconds);
    return false;
}

}  // namespace

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size) {
    if (size == 0) {
        if (max_size == 0) return 0;
        data[0] = static_cast<uint8_t>(below(256));
        return 1;
    }
    constexpr uint8_t nasty[] = {0, 1, 0x7f, 0x80, 0xff};
    const size_t at = below(size);
    switch (below(6)) {
        case 0:
            data[at] = static_cast<uint8_t>(below(256));
            return size;
        case 1:
            data[at] ^= static_cast<uint8_t>(1u << below(8));
            return size;
        case 2:
            std::memset(data + at, nasty[below(std::size(nasty))], std::min(size - at, 1 + below(4)));
            return size;
        case 3: {  // A piece is left out.
            const size_t length = std::min(size - at, 1 + below(16));
            std::memmove(data + at, data + at + length, size - at - length);
            return size - length;
        }
        case 4: {  // A piece comes twice.
            const size_t length = std::min({size - at, 1 + below(16), max_size - size});
            std::memmove(data + at + length, data + at, size - at);
            return size + length;
        }
        default: {  // A piece is copied to another place.
            const size_t from = below(size), length = std::min({size - at, size - from, 1 + below(16)});
            std::memmove(data + at, data + from, length);
            return size;
        }
    }
}

int main(int argc, char** argv) {
    size_t changes = 0;
    std::vector<std::filesystem::path> files;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--changes") == 0 && i + 1 < argc) {
            changes = std::strtoul(argv[++i], nullptr, 10);
        } else {
            const auto more = files_below(argv[i]);
            files.insert(files.end(), more.begin(), more.end());
        }
    }
    if (files.empty()) {
        std::fprintf(stderr, "there is no input\n");
        return 2;
    }
    bool in_time = true;
    std::vector<Bytes> inputs;
    for (const auto& file : files) {
        inputs.push_back(read(file));
        in_time = run(inputs.back(), file.string()) && in_time;
    }
    for (size_t i = 0; i < changes; ++i) {
        const size_t origin = i % inputs.size();
        Bytes input = inputs[origin];
        size_t size = input.size();
        const size_t max_size = size + 64;
        input.resize(max_size);
        for (size_t round = 1 + below(4); round > 0; --round) {
            size = LLVMFuzzerCustomMutator != nullptr
                       ? LLVMFuzzerCustomMutator(input.data(), size, max_size, static_cast<unsigned>(random_bits()))
                       : LLVMFuzzerMutate(input.data(), size, max_size);
        }
        input.resize(size);
        input.shrink_to_fit();
        in_time = run(input, files[origin].string() + ", change " + std::to_string(i)) && in_time;
    }
    std::printf("%zu inputs, %zu changed ones\n", inputs.size(), changes);
    return in_time ? 0 : 1;
}
