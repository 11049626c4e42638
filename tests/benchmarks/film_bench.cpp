// SPDX-License-Identifier: MIT
// What it costs to keep the samples of a 1280×720 picture, to state its error and to map it, on one thread.
#include <benchmark/benchmark.h>

#include "renderer/film/film.h"

namespace candela::bench {
namespace {

constexpr Vec2u extent(1280, 720);

void add_pass(Film& film, uint32_t index) {
    for (uint32_t y = 0; y < extent.y; ++y) {
        for (uint32_t x = 0; x < extent.x; ++x)
            film.add({x, y}, index, Vec3(static_cast<float>((x * 7 + y * 3 + index * 5) % 11)), 1, {3, 2});
    }
}

Film noisy_film() {
    Film film(extent);
    for (uint32_t i = 0; i < 4; ++i)
        add_pass(film, i);
    return film;
}

void film_add(benchmark::State& state) {
    Film film(extent);
    uint32_t index = 0;
    for (auto _ : state)
        add_pass(film, index++);
}
BENCHMARK(film_add)->Unit(benchmark::kMillisecond);

void film_measure(benchmark::State& state) {
    const Film film = noisy_film();
    for (auto _ : state)
        benchmark::DoNotOptimize(measure(film));
}
BENCHMARK(film_measure)->Unit(benchmark::kMillisecond);

void film_maps(benchmark::State& state) {
    const Film film = noisy_film();
    Frame frame;
    frame.maps = ImageRgba32f(extent.x, extent.y);
    for (auto _ : state)
        map_rows(film, 5, 0, extent.y, frame);
}
BENCHMARK(film_maps)->Unit(benchmark::kMillisecond);

void film_resolve(benchmark::State& state) {
    const Film film = noisy_film();
    Frame frame;
    frame.image = ImageRgba32f(extent.x, extent.y);
    for (auto _ : state)
        resolve_rows(film, 0, extent.y, frame);
}
BENCHMARK(film_resolve)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace candela::bench
