// SPDX-License-Identifier: MIT
// candela_growth [lights] [triangles] [textures] [threads]: what a path costs where there is more of something, beside
// what the accelerator alone costs there. Prints Markdown. 10 million triangles take some 3 GB.
#include <fmt/format.h>

#include <chrono>
#include <random>
#include <thread>

#include "tests/benchmarks/percentile.h"
#include "tests/benchmarks/shared_scenes.h"
#include "tests/benchmarks/throughput.h"
#include "tests/support/scenes.h"

namespace candela::bench {
namespace {

constexpr uint32_t side = 128;     // pixels of the square picture
constexpr uint32_t spp = 16;       // of one picture
constexpr uint32_t repeats = 5;    // pictures, of which the median counts
constexpr uint32_t max_depth = 9;  // "8 bounces" of other renderers
constexpr float reach_m = 10;      // half the side of the square that everything stands on

struct Case {
    std::string name;
    std::shared_ptr<const World> world;
};

IntegratorSettings settings_of(uint32_t seed) {
    IntegratorSettings out;
    out.max_depth = max_depth;
    out.russian_roulette = false;
    out.reuse_paths = false;
    out.seed = seed;
    return out;
}

// From a corner of the square over all of it.
View view_of_square() {
    View out;
    out.camera.world_from_camera = look_at(Vec3(reach_m, 6, reach_m), Vec3(0), Vec3(0, 1, 0));
    out.extent = Vec2u(side);
    return out;
}

// CPU seconds of one picture.
double trace(const World& world, uint32_t seed) {
    RayCounts rays;
    return trace_picture(world, view_of_square(), settings_of(seed), spp, rays, [](const auto&, const auto&) {});
}

Primitive square(float y) {
    return test::make_quad(Vec3(-reach_m, y, reach_m), Vec3(2 * reach_m, 0, 0), Vec3(0, 0, -2 * reach_m));
}

// A floor under so many lamps of all sizes, which hang at random and shine down; together they are always as bright.
Case lights(uint32_t count) {
    Scene scene;
    test::add_object(scene, square(0), test::add_lambert(scene, Vec3(0.6f)));
    std::mt19937 random(5);
    std::uniform_real_distribution<float> at(-reach_m, reach_m), height_m(1, 4), size(0.2f, 1.0f);
    const float side_m = reach_m / std::sqrt(static_cast<float>(count));
    Primitive lamps;
    lamps.flat_normals = true;
    for (uint32_t i = 0; i < count; ++i) {
        const float s = side_m * size(random);
        const Primitive quad =
            test::make_quad(Vec3(at(random), height_m(random), at(random)), Vec3(s, 0, 0), Vec3(0, 0, s));
        const auto first = static_cast<uint32_t>(lamps.positions.size());
        lamps.positions.insert(lamps.positions.end(), quad.positions.begin(), quad.positions.end());
        for (const Vec3u& triangle : quad.triangles)
            lamps.triangles.push_back(triangle + first);
    }
    test::add_object(scene, std::move(lamps), test::add_emitter(scene, Vec3(10)));
    return {fmt::format("{} lamps", count), test::build(std::move(scene))};
}

// The same floor under points of light, which rays cannot meet: what choosing among them costs by itself.
Case points(uint32_t count) {
    Scene scene;
    test::add_object(scene, square(0), test::add_lambert(scene, Vec3(0.6f)));
    std::mt19937 random(5);
    std::uniform_real_distribution<float> at(-reach_m, reach_m), height_m(1, 4);
    PunctualLight light;
    light.intensity = 1000.0f / static_cast<float>(count);
    scene.lights.push_back(light);
    for (uint32_t i = 0; i < count; ++i) {
        scene.light_instances.push_back(
            {{0}, {0}, glm::translate(Mat4(1), Vec3(at(random), height_m(random), at(random)))});
    }
    return {fmt::format("{} points of light", count), test::build(std::move(scene))};
}

// Hills of n × n quads under a sky.
Case triangles(uint32_t n) {
    Scene scene;
    Primitive hills;
    for (uint32_t j = 0; j <= n; ++j) {
        for (uint32_t i = 0; i <= n; ++i) {
            const float x = reach_m * (2 * static_cast<float>(i) / static_cast<float>(n) - 1);
            const float z = reach_m * (2 * static_cast<float>(j) / static_cast<float>(n) - 1);
            hills.positions.emplace_back(x, std::sin(2.1f * x) * std::sin(1.7f * z), z);
            hills.normals.push_back(glm::normalize(Vec3(-2.1f * std::cos(2.1f * x) * std::sin(1.7f * z), 1,
                                                        -1.7f * std::sin(2.1f * x) * std::cos(1.7f * z))));
        }
    }
    for (uint32_t j = 0; j < n; ++j) {
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = j * (n + 1) + i, b = a + n + 1;
            hills.triangles.emplace_back(a, b, a + 1);
            hills.triangles.emplace_back(a + 1, b, b + 1);
        }
    }
    test::add_object(scene, std::move(hills), test::add_lambert(scene, Vec3(0.6f)));
    scene.environment = test::constant_environment(Vec3(1));
    return {fmt::format("{} triangles", 2 * n * n), test::build(std::move(scene))};
}

// 200 tiles with a picture each, of which so many differ.
Case textures(uint32_t count) {
    constexpr uint32_t columns = 20, rows = 10;
    constexpr int texels = 512;
    Scene scene;
    std::mt19937 random(5);
    for (uint32_t k = 0; k < count; ++k) {
        auto pixels = std::make_shared<ImageRgba8>(texels, texels);
        for (auto& pixel : pixels->pixels()) {
            const auto bits = static_cast<uint32_t>(random());
            pixel = {static_cast<uint8_t>(bits), static_cast<uint8_t>(bits >> 8), static_cast<uint8_t>(bits >> 16),
                     255};
        }
        SceneImage image;
        image.pixels = pixels;
        image.alpha = ImageAlpha::opaque;
        scene.images.push_back(std::move(image));
        Texture texture;
        texture.image = {k};
        scene.textures.push_back(texture);
        Material material;
        material.metallic_factor = 0;
        material.base_color.texture = {k};
        scene.materials.push_back(material);
    }
    for (uint32_t k = 0; k < columns * rows; ++k) {
        const float w = 2 * reach_m / columns, h = 2 * reach_m / rows;
        const Vec3 corner(-reach_m + w * static_cast<float>(k % columns), 0,
                          reach_m - h * static_cast<float>(k / columns));
        test::add_object(scene, test::make_quad(corner, Vec3(w, 0, 0), Vec3(0, 0, -h)), {k % count});
    }
    scene.environment = test::constant_environment(Vec3(1));
    return {fmt::format("{} textures", count), test::build(std::move(scene))};
}

// Interleaved, so that what else the machine does falls on all alike.
void print_growth(const std::vector<Case>& cases) {
    std::vector<std::vector<double>> times(cases.size());
    for (uint32_t repeat = 0; repeat <= repeats; ++repeat) {
        for (size_t k = 0; k < cases.size(); ++k) {
            const double seconds = trace(*cases[k].world, repeat);
            if (repeat > 0) times[k].push_back(seconds);
        }
    }
    double first_us = 0, first_limit_us = 0;
    for (size_t k = 0; k < cases.size(); ++k) {
        const double us = 1e6 * percentile(times[k], 0.5) / (side * side * spp);
        const double limit_us = 1e6 / limit_paths_per_s(*cases[k].world, view_of_square(), max_depth);
        if (k == 0) {
            first_us = us;
            first_limit_us = limit_us;
        }
        fmt::print("| {} | {:.3f} | {:.2f} | {:.3f} | {:.2f} |\n", cases[k].name, us, us / first_us, limit_us,
                   limit_us / first_limit_us);
    }
    std::fflush(stdout);
}

// The same picture on one thread and, each thread its own, on two: by the clock, and by the CPU time of a picture,
// which tells what they take from each other's caches also where other programs run.
void print_threads() {
    fmt::print(
        "\n| threads | pictures per second against one | CPU time of a picture against one |\n| --- | --- | --- |\n");
    const Case scene = lights(1000);
    const unsigned most = std::max(1u, std::thread::hardware_concurrency());
    double first_rate = 0, first_cpu_s = 0;
    for (unsigned count = 1; count <= most; count *= 2) {
        std::vector<double> rates, cpu;
        for (uint32_t repeat = 0; repeat < repeats; ++repeat) {
            std::vector<double> of_threads(count);
            const auto start = std::chrono::steady_clock::now();
            {
                std::vector<std::jthread> threads;
                for (unsigned t = 0; t < count; ++t)
                    threads.emplace_back([&, t] { of_threads[t] = trace(*scene.world, repeat); });
            }
            const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
            rates.push_back(count / wall.count());
            cpu.push_back(percentile(of_threads, 0.5));
        }
        if (count == 1) {
            first_rate = percentile(rates, 0.5);
            first_cpu_s = percentile(cpu, 0.5);
        }
        fmt::print("| {} | {:.2f} | {:.2f} |\n", count, percentile(rates, 0.5) / first_rate,
                   percentile(cpu, 0.5) / first_cpu_s);
    }
}

int run(int argc, char** argv) {
    const std::vector<std::string> only(argv + 1, argv + argc);
    const auto wanted = [&](const char* what) {
        return only.empty() || std::find(only.begin(), only.end(), what) != only.end();
    };
    for (const std::string& name : only) {
        if (name != "lights" && name != "triangles" && name != "textures" && name != "threads") {
            fmt::print(stderr, "usage: candela_growth [lights] [triangles] [textures] [threads]\n");
            return 2;
        }
    }
    fmt::print(
        "| scene | µs per path | against the first | µs of the accelerator alone | against the first |\n"
        "| --- | --- | --- | --- | --- |\n");
    if (wanted("lights")) {
        print_growth({lights(1000), lights(10000), lights(100000)});
        print_growth({points(1000), points(10000), points(100000)});
    }
    if (wanted("triangles")) print_growth({triangles(224), triangles(708), triangles(2237)});
    if (wanted("textures")) print_growth({textures(1), textures(20), textures(200)});
    if (wanted("threads")) print_threads();
    return 0;
}

}  // namespace
}  // namespace candela::bench

int main(int argc, char** argv) {
    try {
        return candela::bench::run(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "candela_growth: {}\n", error.what());
        return 1;
    }
}
