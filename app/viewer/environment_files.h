// SPDX-License-Identifier: MIT
// Environments that lie near: beside the scene, beside the one that is shown, and those that ship with candela.
#pragma once

#include <string>
#include <vector>

namespace candela {

// Paths of .hdr and .exr files, sorted within each folder, each once; at most 200. Either path may be empty.
std::vector<std::string> environment_files(const std::string& scene_path, const std::string& hdri);

}  // namespace candela
