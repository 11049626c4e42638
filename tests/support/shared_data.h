// SPDX-License-Identifier: MIT
// Where the shared glTF data lies, if it is there.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace candela::test {

// $CANDELA_GLTF_DATA, else ../shared/gltf beside the project.
inline std::filesystem::path shared_data() {
    const char* folder = std::getenv("CANDELA_GLTF_DATA");
    return folder != nullptr ? std::filesystem::path(folder) : std::filesystem::path("../shared/gltf");
}

}  // namespace candela::test
