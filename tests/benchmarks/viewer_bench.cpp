// SPDX-License-Identifier: MIT
// The whole viewer at 1280×720, drawn by OSMesa on the cores that also trace: from the mouse to the finished picture.
#include <benchmark/benchmark.h>

#include <chrono>
#include <ctime>
#include <thread>

#include "app/gl/osmesa_context.h"
#include "app/viewer/viewer.h"
#include "tests/benchmarks/percentile.h"
#include "tests/benchmarks/shared_scenes.h"

namespace candela::bench {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return 1e3 * std::chrono::duration<double>(Clock::now() - start).count();
}

// One turn of the window's loop; true when a picture was drawn.
bool turn(Viewer& viewer) {
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(viewer.seconds_until_update(), 0.001)));
    if (!viewer.update()) return false;
    viewer.draw();
    viewer.presented();
    return true;
}

// The share of one core that a window takes whose picture is done.
double idle_percent(Viewer& viewer) {
    while (!viewer.finished())
        turn(viewer);
    for (int i = 0; i < 5; ++i)
        turn(viewer);
    const std::clock_t cpu = std::clock();
    const Clock::time_point start = Clock::now();
    while (ms_since(start) < 3000) {
        std::this_thread::sleep_for(std::chrono::duration<double>(viewer.seconds_until_update()));
        if (viewer.update()) viewer.draw();
    }
    return 100.0 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC / (1e-3 * ms_since(start));
}

void viewer_idle(benchmark::State& state, const std::string& name) {
    RenderOptions options;
    options.scene = scene_path(name).string();
    options.spp = 2;
    if (!std::filesystem::exists(options.scene)) {
        state.SkipWithError("scene absent");
        return;
    }
    const OsmesaContext context({1280, 720});
    Viewer viewer(options, context);
    for (auto _ : state)
        state.counters["cpu_percent"] = idle_percent(viewer);
}

void viewer_drag(benchmark::State& state, const std::string& name) {
    RenderOptions options;
    options.scene = scene_path(name).string();
    if (!std::filesystem::exists(options.scene)) {
        state.SkipWithError("scene absent");
        return;
    }
    const OsmesaContext context({1280, 720});
    Viewer viewer(options, context);
    const Clock::time_point opened = Clock::now();
    while (viewer.model().frame_epoch == 0)
        turn(viewer);
    state.counters["open_to_picture_ms"] = ms_since(opened);

    std::vector<double> gap_ms, edit_ms, traced_ms;
    for (auto _ : state) {
        // Single edits, at any phase of the picture.
        for (int i = 0; i < 25; ++i) {
            const Clock::time_point settle = Clock::now();
            while (ms_since(settle) < 20 + i * 7 % 90)
                turn(viewer);
            // Far enough from the last press not to be a double-click.
            const float x = i % 2 == 0 ? 300.0f : 400.0f;
            viewer.handle(MouseMoved{{x, 200}});
            viewer.handle(MousePressed{MouseButton::left, true, {}});
            const Clock::time_point start = Clock::now();
            viewer.handle(MouseMoved{{i % 2 == 0 ? x + 9 : x - 9, 200}});
            const uint64_t before = viewer.model().frame_epoch;
            while (viewer.model().frame_epoch == before)
                turn(viewer);
            edit_ms.push_back(ms_since(start));
            traced_ms.push_back(1e3 * viewer.model().status.last_first_frame_seconds);
            viewer.handle(MousePressed{MouseButton::left, false, {}});
        }

        // A drag of two seconds, the mouse moving with every turn.
        viewer.handle(MouseMoved{{300, 300}});
        viewer.handle(MousePressed{MouseButton::left, true, {}});
        const Clock::time_point start = Clock::now();
        Clock::time_point last = start;
        uint64_t shown = viewer.model().frame_epoch;
        while (ms_since(start) < 2000) {
            const auto t = static_cast<float>(ms_since(start));
            viewer.handle(MouseMoved{{300 + 0.1f * t, 300 + 40 * std::sin(0.004f * t)}});
            if (turn(viewer) && viewer.model().frame_epoch != shown) {
                shown = viewer.model().frame_epoch;
                gap_ms.push_back(ms_since(last));
                last = Clock::now();
            }
        }
        viewer.handle(MousePressed{MouseButton::left, false, {}});
    }
    state.counters["edit_to_picture_p50_ms"] = percentile(edit_ms, 0.5);
    state.counters["edit_to_picture_p95_ms"] = percentile(edit_ms, 0.95);
    state.counters["session_p50_ms"] = percentile(traced_ms, 0.5);
    state.counters["input_to_picture_p50_ms"] = 1e3 * viewer.model().latency.median_s;
    state.counters["pictures/s_p50"] = 1e3 / percentile(gap_ms, 0.5);
    state.counters["pictures/s_worst"] = 1e3 / percentile(gap_ms, 1.0);
}

BENCHMARK_CAPTURE(viewer_idle, hotel_room, "models/HotelRoom/scene.glb")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1)
    ->UseRealTime();
BENCHMARK_CAPTURE(viewer_drag, cornell_box, "assets/cornell_box.glb")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(2)
    ->UseRealTime();
BENCHMARK_CAPTURE(viewer_drag, hotel_room, "models/HotelRoom/scene.glb")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(2)
    ->UseRealTime();

}  // namespace
}  // namespace candela::bench
