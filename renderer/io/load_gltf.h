// SPDX-License-Identifier: MIT
// glTF 2.0 (.gltf, .glb) to Scene. Trusts nothing: every index, stride, size and path of the file is checked.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>

#include "renderer/image/codec.h"
#include "renderer/io/diagnostics.h"
#include "renderer/scene/scene.h"

namespace candela {

// What a file may ask for; the messages name the command line's options that raise them. The defaults are far above
// what scenes of good will need.
struct LoadLimits {
    uint64_t max_memory_bytes = uint64_t{16} << 30;  // --limit-memory: booked while loading, pixels included
    uint64_t max_json_bytes = uint64_t{256} << 20;   // --limit-json: the text of the document
    int max_json_nesting = 128;                      // --limit-nesting: arrays and objects inside of one another
    uint64_t max_count = 1'000'000;      // --limit-count: nodes, accessors, primitives of all meshes, … of each kind
    uint64_t max_instances = 4'000'000;  // --limit-instances: copies that EXT_mesh_gpu_instancing places
    int max_image_side = 16384;          // --limit-image: pixels of a picture's side
};
// How far max_json_nesting may be raised: parsers are recursive, and so is whatever copies the document.
inline constexpr int most_json_nesting = 1000;

inline DecodeLimits image_limits(const LoadLimits& limits) {
    const auto side = static_cast<size_t>(limits.max_image_side);
    return {limits.max_image_side, side * side, limits.max_memory_bytes};
}

struct LoadOptions : LoadLimits {
    std::optional<uint32_t> scene;  // index; default: the file's scene, else the first
    std::string variant;            // name; empty: each primitive's own material
    bool decode_images = true;
    bool measure_images = false;  // without decoding them
    // A required extension that is not supported does not end the load, but is listed as refused.
    bool list_refused = false;
    // Called with 0..1 and a word for the step ("reading", "meshes", "tangents", "images"), from the loading thread
    // only.
    std::function<void(float, const char*)> progress;
    const std::atomic<bool>* cancel = nullptr;  // set: the load ends soon with LoadError "cancelled"
    // Called from the loading thread, if the scene has pictures, once all is there but their pixels and an environment
    // made of pictures: others decode meanwhile. What it throws ends the load.
    std::function<void(const Scene&)> geometry_ready;
};

// Throws LoadError, ChoiceError where options name a scene or a variant that the file has not.
Scene load_gltf(const std::filesystem::path& path, Diagnostics& diagnostics, const LoadOptions& options = {});
// The same for a file that is in memory. path: its name in messages, and where the files it names lie.
Scene load_gltf(std::span<const std::byte> bytes, const std::filesystem::path& path, Diagnostics& diagnostics,
                const LoadOptions& options = {});

}  // namespace candela
