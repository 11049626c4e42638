// SPDX-License-Identifier: MIT
// Scenes that the benchmarks make for themselves.
#pragma once

#include <filesystem>

namespace candela::bench {

// A height field of 2 million triangles with normals, 48 MB, in the folder for temporary files.
std::filesystem::path terrain_file();

}  // namespace candela::bench
