// SPDX-License-Identifier: MIT
// glTF 2.0 (.gltf, .glb) to Scene. Trusts nothing: every index, stride, size and path of the file is checked.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>

#include "renderer/io/diagnostics.h"
#include "renderer/scene/scene.h"

namespace candela {

struct LoadOptions {
    std::optional<uint32_t> scene;  // index; default: the file's scene, else the first
    std::string variant;            // name; empty: each primitive's own material
    bool decode_images = true;
    bool measure_images = false;  // without decoding them
    // A required extension that is not supported does not end the load, but is listed as refused.
    bool list_refused = false;
    uint64_t max_memory_bytes = uint64_t{16} << 30;
    // Called with 0..1 and a word for the step ("reading", "images", "tangents"), from the loading thread only.
    std::function<void(float, const char*)> progress;
    const std::atomic<bool>* cancel = nullptr;  // set: the load ends soon with LoadError "cancelled"
};

// Throws LoadError, ChoiceError where options name a scene or a variant that the file has not.
Scene load_gltf(const std::filesystem::path& path, Diagnostics& diagnostics, const LoadOptions& options = {});

}  // namespace candela
