// SPDX-License-Identifier: MIT
// The scenes that the benchmarks measure, loaded once.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "renderer/integrator/integrator.h"

namespace candela::bench {

// Where a scene lies: "assets/…" in the project, anything else in the shared data ($CANDELA_GLTF_DATA).
std::filesystem::path scene_path(const std::string& name);

struct LoadedScene {
    std::shared_ptr<const World> world;
    Camera camera;  // the file's first, else one that frames the scene
};

// Null where the file is absent. Kept for the life of the program.
const LoadedScene* loaded_scene(const std::string& name);

View view_of(const LoadedScene& scene, Vec2u extent);

}  // namespace candela::bench
