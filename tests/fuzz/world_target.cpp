// SPDX-License-Identifier: MIT
// A whole file, from its bytes to rays: whatever loads must build and render. The ray tracer's library ends the process
// where it is given what it does not like.
#include "renderer/integrator/integrator.h"
#include "renderer/io/load_gltf.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace candela;
    LoadOptions options;
    options.max_memory_bytes = uint64_t{16} << 20;
    options.max_image_side = 64;
    Diagnostics diagnostics;
    std::shared_ptr<const Scene> scene;
    try {
        scene = std::make_shared<const Scene>(
            load_gltf(fuzz::bytes_of(data, size), "/proc/self/fdinfo/scene.gltf", diagnostics, options));
    } catch (const LoadError&) {
        return 0;
    }
    // Large ones only take longer.
    if (instanced_triangle_count(*scene) > 5000 || scene->instances.size() > 500) return 0;
    BuildOptions build;
    build.environment = Environment{ImageRgb32f(1, 1, Vec3(1)), 0.0f, 1.0f};
    const std::shared_ptr<const World> world = build_world(scene, build);

    std::vector<Camera> cameras{frame_bounds(world->bounds, 1.0f)};
    if (!scene->cameras.empty()) cameras.push_back(scene->cameras.front().camera);
    RayCounts counts;
    for (const Camera& camera : cameras) {
        const View view{camera, Vec2u(4)};
        for (uint16_t i = 0; i < 16; ++i) {
            const PixelSample sample{static_cast<uint16_t>(i % 4), static_cast<uint16_t>(i / 4), i};
            const float alpha = trace_sample(*world, view, IntegratorSettings{}, sample, counts).alpha;
            fuzz::require(alpha >= 0.0f && alpha <= 1.0f, "a pixel is covered by something between nothing and all");
        }
    }
    return 0;
}
