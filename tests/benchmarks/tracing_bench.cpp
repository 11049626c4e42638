// SPDX-License-Identifier: MIT
// Paths per second of the drivers on one core.
#include <benchmark/benchmark.h>

#include "tests/benchmarks/shared_scenes.h"

namespace candela::bench {
namespace {

// One sample for every pixel of a 256² picture, tile after tile as a worker gets them.
void trace_pass(const LoadedScene& scene, const IntegratorSettings& settings, bool batched, uint32_t index,
                RayCounts& counts) {
    constexpr uint32_t side = 256;
    constexpr uint32_t tile = 16;
    const View view = view_of(scene, Vec2u(side));
    std::vector<PixelSample> samples(size_t{tile} * tile);
    std::vector<RadianceSample> out(samples.size());
    for (uint32_t ty = 0; ty < side; ty += tile) {
        for (uint32_t tx = 0; tx < side; tx += tile) {
            for (uint32_t i = 0; i < tile * tile; ++i) {
                samples[i] = {static_cast<uint16_t>(tx + i % tile), static_cast<uint16_t>(ty + i / tile), index};
                if (!batched) out[i] = trace_sample(*scene.world, view, settings, samples[i], counts);
            }
            if (batched) trace_batch(*scene.world, view, settings, samples, out, counts);
            benchmark::DoNotOptimize(out.data());
        }
    }
}

void tracing(benchmark::State& state, const std::string& name, bool batched) {
    const LoadedScene* scene = loaded_scene(name);
    if (scene == nullptr) {
        state.SkipWithError("scene absent");
        return;
    }
    RayCounts counts;
    uint32_t index = 0;
    for (auto _ : state)
        trace_pass(*scene, {}, batched, index++, counts);
    state.counters["paths/s"] = benchmark::Counter(static_cast<double>(counts.camera), benchmark::Counter::kIsRate);
    state.counters["rays/s"] = benchmark::Counter(static_cast<double>(counts.total()), benchmark::Counter::kIsRate);
    state.counters["rays/path"] = static_cast<double>(counts.total()) / static_cast<double>(counts.camera);
}

#define CANDELA_TRACING(label, file)                                                                                 \
    BENCHMARK_CAPTURE(tracing, label##_batched, file, true)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime(); \
    BENCHMARK_CAPTURE(tracing, label##_scalar, file, false)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()

CANDELA_TRACING(cornell_box, "assets/cornell_box.glb");
CANDELA_TRACING(many_lights, "assets/many_lights.glb");
CANDELA_TRACING(hotel_room, "models/HotelRoom/scene.glb");
CANDELA_TRACING(flight_helmet, "models/FlightHelmet/FlightHelmet.gltf");

}  // namespace
}  // namespace candela::bench
