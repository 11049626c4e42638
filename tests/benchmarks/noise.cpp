// SPDX-License-Identifier: MIT
// candela_noise [--json FILE] [--compare FILE] [SCENE…]: noise × time of each scene, each technique switched off in
// turn, and throughput beside what the accelerator alone could trace. Prints Markdown, writes JSON, and compares with
// an earlier run's JSON.
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/benchmarks/made_scenes.h"
#include "tests/benchmarks/percentile.h"
#include "tests/benchmarks/shared_scenes.h"
#include "tests/benchmarks/throughput.h"

namespace candela::bench {
namespace {

constexpr uint32_t side = 128;     // pixels of the square picture
constexpr uint32_t spp = 64;       // of one picture
constexpr uint32_t seeds = 5;      // pictures whose spread is the noise
constexpr uint32_t max_depth = 9;  // "8 bounces" of other renderers

const std::vector<std::pair<const char*, const char*>> scenes{
    {"cornell_box", "assets/cornell_box.glb"},
    {"many_lights", "assets/many_lights.glb"},
    {"veach_plates", "assets/veach_plates.glb"},
    {"terrain", ""},
    {"FlightHelmet", "models/FlightHelmet/FlightHelmet.gltf"}};

struct Variant {
    const char* name;
    IntegratorSettings settings;
};

std::vector<Variant> variants() {
    IntegratorSettings usual;
    usual.max_depth = max_depth;
    usual.filter = PixelFilter::box;
    std::vector<Variant> out(7, {"as it is", usual});
    out[1].name = "independent samples";
    out[1].settings.sampler = SamplerKind::independent;
    out[2].name = "light samples alone";
    out[2].settings.estimator = Estimator::light;
    out[3].name = "directions alone";
    out[3].settings.estimator = Estimator::bsdf;
    out[4].name = "no roulette, each path alone";
    out[4].settings.russian_roulette = false;
    out[4].settings.reuse_paths = false;
    out[5].name = "textures not filtered";
    out[5].settings.filter_textures = false;
    out[6].name = "each path alone";
    out[6].settings.reuse_paths = false;
    return out;
}

struct Picture {
    std::vector<float> luminance = std::vector<float>(size_t{side} * side);
    double cpu_s = 0;
    RayCounts rays;
};

Picture render(const LoadedScene& scene, const IntegratorSettings& settings, uint32_t samples) {
    Picture out;
    const View view = view_of(scene, Vec2u(side));
    out.cpu_s = trace_picture(*scene.world, view, settings, samples, out.rays,
                              [&](const std::vector<PixelSample>& wanted, const std::vector<RadianceSample>& got) {
                                  for (size_t i = 0; i < wanted.size(); ++i) {
                                      out.luminance[size_t{wanted[i].y} * side + wanted[i].x] +=
                                          luminance(got[i].radiance) / static_cast<float>(samples);
                                  }
                              });
    return out;
}

// Mean over the pixels of variance / (mean² + (0.1 · mean of the picture)²), without the worst thousandth.
double relative_mse(const std::vector<Picture>& pictures) {
    const size_t pixels = size_t{side} * side;
    const auto n = static_cast<double>(pictures.size());
    std::vector<double> mean(pixels, 0), variance(pixels, 0);
    double whole = 0;
    for (size_t i = 0; i < pixels; ++i) {
        for (const Picture& each : pictures)
            mean[i] += static_cast<double>(each.luminance[i]) / n;
        for (const Picture& each : pictures) {
            const double difference = static_cast<double>(each.luminance[i]) - mean[i];
            variance[i] += difference * difference / (n - 1);
        }
        whole += mean[i] / static_cast<double>(pixels);
    }
    std::vector<double> relative(pixels);
    for (size_t i = 0; i < pixels; ++i)
        relative[i] = variance[i] / std::max(mean[i] * mean[i] + 0.01 * whole * whole, 1e-30);
    std::sort(relative.begin(), relative.end());
    double sum = 0;
    const size_t kept = pixels - pixels / 1000;
    for (size_t i = 0; i < kept; ++i)
        sum += relative[i];
    return sum / static_cast<double>(kept);
}

const LoadedScene* load(const std::string& name, const std::string& file) {
    return name == "terrain" ? loaded_scene(terrain_file().string()) : loaded_scene(file);
}

nlohmann::json measure_scene(const std::string& name, const LoadedScene& scene) {
    const std::vector<Variant> all = variants();
    std::vector<std::vector<Picture>> pictures(all.size());
    // Interleaved, so that what else the machine does falls on all alike.
    for (uint32_t seed = 0; seed < seeds; ++seed) {
        for (size_t k = 0; k < all.size(); ++k) {
            IntegratorSettings settings = all[k].settings;
            settings.seed = seed + 1;
            pictures[k].push_back(render(scene, settings, spp));
        }
    }
    const auto cpu_of = [&](size_t k) {
        std::vector<double> times;
        for (const Picture& each : pictures[k])
            times.push_back(each.cpu_s);
        return percentile(times, 0.5);
    };
    const auto product_of = [&](size_t k) { return relative_mse(pictures[k]) * cpu_of(k); };

    nlohmann::json out;
    const double paths = static_cast<double>(side) * side * spp;
    const double limit = limit_paths_per_s(*scene.world, view_of(scene, Vec2u(side)), max_depth), usual = product_of(0);
    out["limit_paths_per_s"] = limit;
    out["paths_per_s_without_roulette"] = paths / cpu_of(4);
    fmt::print(
        "\n{}: {:.3f} million paths per CPU second, {:.3f} without roulette, {:.0f} % of the {:.3f} that the "
        "accelerator alone traces\n\n| {} | CPU s | relMSE | relMSE × CPU s | against as it is |\n| --- | --- | "
        "--- | --- | --- |\n",
        name, 1e-6 * paths / cpu_of(0), 1e-6 * paths / cpu_of(4), 100 * paths / cpu_of(4) / limit, 1e-6 * limit, name);
    for (size_t k = 0; k < all.size(); ++k) {
        const double product = product_of(k);
        out["noise_times_s"][all[k].name] = product;
        fmt::print("| {} | {:.3f} | {:.6f} | {:.6f} | {:.2f} |\n", all[k].name, cpu_of(k), relative_mse(pictures[k]),
                   product, product / usual);
    }
    std::fflush(stdout);
    return out;
}

void print_comparison(const nlohmann::json& now, const nlohmann::json& before) {
    fmt::print("\n| scene | noise × time, now / before | paths per second, now / before |\n| --- | --- | --- |\n");
    for (const auto& [scene, figures] : now.items()) {
        if (!before.contains(scene)) continue;
        const auto ratio = [](const nlohmann::json& a, const nlohmann::json& b) {
            return a.get<double>() / b.get<double>();
        };
        fmt::print("| {} | {:.3f} | {:.3f} |\n", scene,
                   ratio(figures["noise_times_s"]["as it is"], before[scene]["noise_times_s"]["as it is"]),
                   ratio(figures["paths_per_s_without_roulette"], before[scene]["paths_per_s_without_roulette"]));
    }
}

int run(int argc, char** argv) {
    std::string json_file, compare_file;
    std::vector<std::string> only;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if ((argument == "--json" || argument == "--compare") && i + 1 < argc) {
            (argument == "--json" ? json_file : compare_file) = argv[++i];
        } else if (argument.starts_with("-")) {
            fmt::print(stderr, "usage: candela_noise [--json FILE] [--compare FILE] [SCENE…]\n");
            return 2;
        } else {
            only.push_back(argument);
        }
    }
    nlohmann::json before;
    if (!compare_file.empty()) before = nlohmann::json::parse(std::ifstream(compare_file));

    nlohmann::json now = nlohmann::json::object();
    for (const auto& [name, file] : scenes) {
        if (!only.empty() && std::find(only.begin(), only.end(), name) == only.end()) continue;
        if (const LoadedScene* scene = load(name, file)) now[name] = measure_scene(name, *scene);
    }
    if (!json_file.empty()) std::ofstream(json_file) << now.dump(2) << '\n';
    if (!before.is_null()) print_comparison(now, before);
    return 0;
}

}  // namespace
}  // namespace candela::bench

int main(int argc, char** argv) {
    try {
        return candela::bench::run(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "candela_noise: {}\n", error.what());
        return 1;
    }
}
