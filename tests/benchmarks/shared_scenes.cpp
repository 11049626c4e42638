// SPDX-License-Identifier: MIT
#include "tests/benchmarks/shared_scenes.h"

#include <cstdlib>
#include <map>

#include "renderer/io/load_gltf.h"

namespace candela::bench {

std::filesystem::path scene_path(const std::string& name) {
    const std::filesystem::path root = CANDELA_SOURCE_DIR;
    if (name.starts_with("assets/")) return root / name;
    const char* data = std::getenv("CANDELA_GLTF_DATA");
    return (data != nullptr ? std::filesystem::path(data) : root / "../shared/gltf") / name;
}

const LoadedScene* loaded_scene(const std::string& name) {
    static std::map<std::string, LoadedScene> scenes;
    if (const auto found = scenes.find(name); found != scenes.end()) return &found->second;
    const std::filesystem::path path = scene_path(name);
    if (!std::filesystem::exists(path)) return nullptr;

    Diagnostics diagnostics;
    auto scene = std::make_shared<Scene>(load_gltf(path, diagnostics));
    BuildOptions options;
    if (!scene->environment) {
        Environment sky;
        sky.radiance = ImageRgb32f(1, 1, Vec3(0.35f, 0.45f, 0.6f));
        options.environment = sky;
    }
    LoadedScene out;
    const Bounds3 bounds = bounds_of(*scene);
    out.camera = scene->cameras.empty() ? frame_bounds(bounds, 16.0f / 9.0f) : scene->cameras.front().camera;
    out.world = build_world(scene, options);
    return &scenes.emplace(name, std::move(out)).first->second;
}

View view_of(const LoadedScene& scene, Vec2u extent) {
    return {scene.camera, extent};
}

}  // namespace candela::bench
