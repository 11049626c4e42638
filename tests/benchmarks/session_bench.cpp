// SPDX-License-Identifier: MIT
// What a person feels at 1280×720: how soon a camera edit shows, how fast pictures follow a drag, how soon workers let
// go.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "renderer/session/render_session.h"
#include "tests/benchmarks/made_scenes.h"
#include "tests/benchmarks/percentile.h"
#include "tests/benchmarks/shared_scenes.h"

namespace candela::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// The camera turned a little further around the scene with every edit.
View dragged(const LoadedScene& scene, int step) {
    View view = view_of(scene, Vec2u(1280, 720));
    const float angle = 0.3f * std::sin(0.05f * static_cast<float>(step));
    Mat4 turn(1.0f);
    turn[0] = Vec4(std::cos(angle), 0, -std::sin(angle), 0);
    turn[2] = Vec4(std::sin(angle), 0, std::cos(angle), 0);
    view.camera.world_from_camera = view.camera.world_from_camera * turn;
    return view;
}

// Waits for the first frame of an epoch as a viewer would see it, polling once per millisecond.
double seconds_to_frame(RenderSession& session, uint64_t epoch) {
    const Clock::time_point start = Clock::now();
    for (;;) {
        const Frame* frame = session.latest();
        if (frame != nullptr && frame->epoch >= epoch) return seconds_since(start);
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
}

void camera_edit(benchmark::State& state, const std::string& name) {
    const LoadedScene* scene = loaded_scene(name);
    if (scene == nullptr) {
        state.SkipWithError("scene absent");
        return;
    }
    RenderSession session;
    std::vector<double> first_frame_ms;
    std::vector<double> cancel_ms;
    int step = 0;
    for (auto _ : state) {
        // Edits come at any phase of the picture: after 0 to 90 ms of rendering.
        std::this_thread::sleep_for(std::chrono::milliseconds(step * 7 % 90));
        RenderRequest request{scene->world, dragged(*scene, step++), {}};
        const uint64_t epoch = session.submit(request);
        first_frame_ms.push_back(1e3 * seconds_to_frame(session, epoch));
        cancel_ms.push_back(1e3 * session.status().last_cancel_seconds);
    }
    state.counters["first_frame_p50_ms"] = percentile(first_frame_ms, 0.5);
    state.counters["first_frame_p95_ms"] = percentile(first_frame_ms, 0.95);
    state.counters["cancel_p95_ms"] = percentile(cancel_ms, 0.95);
    state.counters["cancel_max_ms"] = percentile(cancel_ms, 1.0);
}

// A drag of two seconds: an edit every 8 ms, whatever the session is doing; counts the pictures that arrive.
void drag(benchmark::State& state, const std::string& name) {
    const LoadedScene* scene = loaded_scene(name);
    if (scene == nullptr) {
        state.SkipWithError("scene absent");
        return;
    }
    RenderSession session;
    std::vector<double> gap_ms;
    for (auto _ : state) {
        const Clock::time_point start = Clock::now();
        Clock::time_point last_frame = start;
        uint64_t shown_epoch = 0;
        for (int step = 0; seconds_since(start) < 2.0; ++step) {
            session.submit({scene->world, dragged(*scene, step), {}});
            for (int i = 0; i < 8; ++i) {
                const Frame* frame = session.latest();
                if (frame != nullptr && frame->epoch != shown_epoch) {
                    shown_epoch = frame->epoch;
                    gap_ms.push_back(1e3 * seconds_since(last_frame));
                    last_frame = Clock::now();
                }
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
        }
    }
    state.counters["frames/s_p50"] = 1e3 / percentile(gap_ms, 0.5);
    state.counters["frames/s_worst"] = 1e3 / percentile(gap_ms, 1.0);
}

// Camera edits at 512², each to its first complete picture at reduced resolution, and to the first in which every pixel
// has a sample of its own; beside it what the same number of camera paths costs on the accelerator alone, where it is
// known (paths per CPU second of `embree_limit`, in CANDELA_LIMIT_cornell, CANDELA_LIMIT_hotel_room, …).
void latency(benchmark::State& state, const std::string& label, const std::string& name) {
    const LoadedScene* scene = loaded_scene(name == "terrain" ? terrain_file().string() : name);
    if (scene == nullptr) {
        state.SkipWithError("scene absent");
        return;
    }
    const Vec2u extent(512, 512);
    // Rooms are looked at from their middle: from without, most of the picture would be sky.
    LoadedScene inside = *scene;
    if (label == "hotel_room") {
        const Vec3 middle = scene->world->bounds.center();
        inside.camera.world_from_camera = look_at(middle, middle + Vec3(1, 0, 0), Vec3(0, 1, 0));
        inside.camera.yfov_radians = 1.2f;
    }
    RenderSession session;
    std::vector<double> coarse_ms, whole_ms, strides;
    int step = 0;
    for (auto _ : state) {
        View view = dragged(inside, step++);
        view.extent = extent;
        const Clock::time_point start = Clock::now();
        const uint64_t epoch = session.submit({scene->world, view, {}});
        bool coarse = false;
        for (;;) {
            const Frame* frame = session.latest();
            if (frame != nullptr && frame->epoch == epoch && !coarse) {
                coarse = true;
                coarse_ms.push_back(1e3 * seconds_since(start));
                strides.push_back(frame->stride);
            }
            if (coarse && session.status().spp > 0) break;
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
        whole_ms.push_back(1e3 * seconds_since(start));
    }
    state.counters["coarse_p50_ms"] = percentile(coarse_ms, 0.5);
    state.counters["coarse_p95_ms"] = percentile(coarse_ms, 0.95);
    state.counters["stride_p50"] = percentile(strides, 0.5);
    state.counters["whole_p50_ms"] = percentile(whole_ms, 0.5);
    if (const char* limit = std::getenv(("CANDELA_LIMIT_" + label).c_str())) {
        const double cores = std::max(1u, std::thread::hardware_concurrency());
        const double limit_ms = 1e3 * extent.x * extent.y / (std::atof(limit) * cores);
        state.counters["whole/limit"] = percentile(whole_ms, 0.5) / limit_ms;
    }
}

BENCHMARK_CAPTURE(latency, cornell, "cornell", "assets/cornell_box.glb")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(60)
    ->UseRealTime();
BENCHMARK_CAPTURE(latency, hotel_room, "hotel_room", "models/HotelRoom/scene.glb")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(60)
    ->UseRealTime();
BENCHMARK_CAPTURE(latency, terrain, "terrain", "terrain")->Unit(benchmark::kMillisecond)->Iterations(60)->UseRealTime();

#define CANDELA_SESSION(label, file)                                                                            \
    BENCHMARK_CAPTURE(camera_edit, label, file)->Unit(benchmark::kMillisecond)->Iterations(100)->UseRealTime(); \
    BENCHMARK_CAPTURE(drag, label, file)->Unit(benchmark::kMillisecond)->Iterations(2)->UseRealTime()

CANDELA_SESSION(cornell_box, "assets/cornell_box.glb");
CANDELA_SESSION(hotel_room, "models/HotelRoom/scene.glb");

}  // namespace
}  // namespace candela::bench
