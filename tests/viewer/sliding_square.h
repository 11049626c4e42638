// SPDX-License-Identifier: MIT
// A file with animations.
#pragma once

#include <filesystem>

namespace candela::test {

// A red square that slides two metres to the right within a second, and a camera that goes back four within a half.
inline void write_sliding_square(const std::string& path) {
    std::filesystem::copy_file("tests/viewer/sliding_square.gltf", path);
}

}  // namespace candela::test
