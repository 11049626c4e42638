// SPDX-License-Identifier: MIT
// What another pose costs beside a world made from nothing, and what it costs rays that things may move.
#include <benchmark/benchmark.h>

#include <chrono>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/io/load_gltf.h"
#include "renderer/scene/animation.h"
#include "renderer/scene/pose.h"
#include "tests/benchmarks/percentile.h"
#include "tests/benchmarks/shared_scenes.h"

namespace candela::bench {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return 1e3 * std::chrono::duration<double>(Clock::now() - start).count();
}

std::shared_ptr<const Scene> load(const std::string& name) {
    const std::filesystem::path path = scene_path(name);
    if (!std::filesystem::exists(path)) return nullptr;
    Diagnostics diagnostics;
    return std::make_shared<const Scene>(load_gltf(path, diagnostics));
}

// Poses one after the other; of each the world made from the last, and every fourth time from nothing.
void update_poses(benchmark::State& state, const std::shared_ptr<const Scene>& first,
                  const std::function<std::shared_ptr<const Scene>(int)>& pose) {
    std::vector<double> posing_ms, update_ms, build_ms;
    std::shared_ptr<const World> world = build_world(first), before;
    AccelWork work;
    int index = 0;
    for (auto _ : state) {
        for (int i = 0; i < 24; ++i, ++index) {
            Clock::time_point start = Clock::now();
            const std::shared_ptr<const Scene> scene = pose(index);
            posing_ms.push_back(ms_since(start));
            start = Clock::now();
            before = std::exchange(world, with_pose(world, scene));
            update_ms.push_back(ms_since(start));
            work = world->accel->work();
            if (i % 4 != 0) continue;
            start = Clock::now();
            benchmark::DoNotOptimize(build_world(scene));
            build_ms.push_back(ms_since(start));
        }
    }
    state.counters["posing_ms"] = percentile(posing_ms, 0.5);
    state.counters["update_ms"] = percentile(update_ms, 0.5);
    state.counters["build_ms"] = percentile(build_ms, 0.5);
    state.counters["build/update"] = percentile(build_ms, 0.5) / percentile(update_ms, 0.5);
    state.counters["built"] = work.trees_built;
    state.counters["refitted"] = work.trees_refitted;
    state.counters["shared"] = work.trees_shared;
    state.counters["triangles"] = static_cast<double>(world->triangle_count);
}

// The first instance is moved by hand; the file has no animation.
void one_node_moves(benchmark::State& state, const std::string& name) {
    const std::shared_ptr<const Scene> rest = load(name);
    if (!rest) {
        state.SkipWithError("scene absent");
        return;
    }
    const auto moved = [&](int index) {
        auto scene = std::make_shared<Scene>(*rest);
        scene->instances[0].moves = true;
        scene->instances[0].world_from_object =
            glm::rotate(scene->instances[0].world_from_object, 0.01f * static_cast<float>(index), Vec3(0, 1, 0));
        return std::shared_ptr<const Scene>(scene);
    };
    update_poses(state, moved(0), moved);
}

void animation_plays(benchmark::State& state, const std::string& name) {
    const std::shared_ptr<const Scene> rest = load(name);
    if (!rest || rest->animations.empty()) {
        state.SkipWithError("scene absent");
        return;
    }
    update_poses(state, rest, [&](int index) {
        return posed_scene(rest, 0, std::fmod(static_cast<float>(index) / 24.0f, rest->animations[0]->duration_s));
    });
}

enum class Layout : uint8_t { still, one_moves, all_move, all_deform };

// The same picture of the same scene, laid out as if less or more of it could move.
void moving_layout(benchmark::State& state, const std::string& name, Layout layout) {
    const std::shared_ptr<const Scene> rest = load(name);
    if (!rest) {
        state.SkipWithError("scene absent");
        return;
    }
    auto scene = std::make_shared<Scene>(*rest);
    for (size_t i = 0; i < scene->instances.size(); ++i) {
        Instance& instance = scene->instances[i];
        instance.moves = layout >= Layout::all_move || (layout == Layout::one_moves && i == 0);
        instance.deforms = layout == Layout::all_deform;
    }
    BuildOptions options;
    options.environment.emplace();
    options.environment->radiance = ImageRgb32f(1, 1, Vec3(0.35f, 0.45f, 0.6f));
    const auto world = build_world(scene, options);
    View view;
    view.camera = scene->cameras.empty() ? frame_bounds(bounds_of(*scene), 1.0f) : scene->cameras.front().camera;
    view.extent = Vec2u(192);
    std::vector<PixelSample> samples(256);
    std::vector<RadianceSample> out(samples.size());
    RayCounts counts;
    uint32_t pass = 0;
    for (auto _ : state) {
        for (uint32_t ty = 0; ty < view.extent.y; ty += 16) {
            for (uint32_t tx = 0; tx < view.extent.x; tx += 16) {
                for (uint32_t i = 0; i < 256; ++i)
                    samples[i] = {static_cast<uint16_t>(tx + i % 16), static_cast<uint16_t>(ty + i / 16), pass};
                trace_batch(*world, view, {}, samples, out, counts);
                benchmark::DoNotOptimize(out.data());
            }
        }
        ++pass;
    }
    state.counters["rays/s"] = benchmark::Counter(static_cast<double>(counts.total()), benchmark::Counter::kIsRate);
}

#define CANDELA_POSES(function, label, file) \
    BENCHMARK_CAPTURE(function, label, file)->Unit(benchmark::kMillisecond)->Iterations(2)->UseRealTime()

CANDELA_POSES(one_node_moves, flight_helmet, "models/FlightHelmet/FlightHelmet.gltf");
CANDELA_POSES(animation_plays, cesium_man, "models/CesiumMan/glTF-Binary/CesiumMan.glb");
CANDELA_POSES(animation_plays, fox, "models/Fox/glTF/Fox.gltf");
CANDELA_POSES(animation_plays, box_animated, "models/BoxAnimated/glTF-Binary/BoxAnimated.glb");

#define CANDELA_LAYOUTS(label, file)                                                                             \
    BENCHMARK_CAPTURE(moving_layout, label##_still, file, Layout::still)->Unit(benchmark::kMillisecond);         \
    BENCHMARK_CAPTURE(moving_layout, label##_one_moves, file, Layout::one_moves)->Unit(benchmark::kMillisecond); \
    BENCHMARK_CAPTURE(moving_layout, label##_all_move, file, Layout::all_move)->Unit(benchmark::kMillisecond);   \
    BENCHMARK_CAPTURE(moving_layout, label##_all_deform, file, Layout::all_deform)->Unit(benchmark::kMillisecond)

CANDELA_LAYOUTS(flight_helmet, "models/FlightHelmet/FlightHelmet.gltf");
CANDELA_LAYOUTS(hotel_room, "models/HotelRoom/scene.glb");

}  // namespace
}  // namespace candela::bench
