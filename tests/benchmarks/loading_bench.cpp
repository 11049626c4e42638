// SPDX-License-Identifier: MIT
// Where the time of opening a scene goes: the loader's steps by their progress words, then the build of the world.
#include <benchmark/benchmark.h>

#include <chrono>
#include <map>

#include "renderer/io/load_gltf.h"
#include "tests/benchmarks/shared_scenes.h"

namespace candela::bench {
namespace {

using Clock = std::chrono::steady_clock;

void loading(benchmark::State& state, const std::string& name) {
    const std::filesystem::path path = scene_path(name);
    if (!std::filesystem::exists(path)) {
        state.SkipWithError("scene absent");
        return;
    }
    std::map<std::string, double> step_seconds;
    for (auto _ : state) {
        std::string step = "reading";
        Clock::time_point begin = Clock::now();
        const auto enter = [&](const std::string& next) {
            const Clock::time_point now = Clock::now();
            step_seconds[step] += std::chrono::duration<double>(now - begin).count();
            step = next;
            begin = now;
        };
        LoadOptions options;
        options.progress = [&](float, const char* word) {
            if (step != word) enter(word);
        };
        Diagnostics diagnostics;
        auto scene = std::make_shared<const Scene>(load_gltf(path, diagnostics, options));
        enter("build");
        benchmark::DoNotOptimize(build_world(scene));
        enter("");
    }
    for (const auto& [step, seconds] : step_seconds) {
        if (!step.empty()) {
            state.counters[step + "_ms"] = benchmark::Counter(1e3 * seconds, benchmark::Counter::kAvgIterations);
        }
    }
}

#define CANDELA_LOADING(label, file) \
    BENCHMARK_CAPTURE(loading, label, file)->Unit(benchmark::kMillisecond)->Iterations(3)->UseRealTime()

CANDELA_LOADING(flight_helmet, "models/FlightHelmet/FlightHelmet.gltf");
CANDELA_LOADING(hotel_room, "models/HotelRoom/scene.glb");
CANDELA_LOADING(dream_apartment, "models/DreamApartment/dream-apartment.glb");

}  // namespace
}  // namespace candela::bench
