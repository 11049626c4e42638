// SPDX-License-Identifier: MIT
// candela_calibration [SEEDS [WIDTH [SCENE]]]: how the stated error compares with the true one, as a Markdown table.
// Six scenes of 16 to 1024 samples per pixel; scenes that are absent are left out.
#include <fmt/format.h>

#include <cstdlib>
#include <thread>

#include "app/exit_status.h"
#include "app/render_job.h"
#include "tests/support/calibration.h"

namespace candela::bench {
namespace {

struct Case {
    const char* name;
    const char* scene;  // "assets/…" in the project, anything else in the shared data
    const char* hdri = "";
    std::optional<Vec3> eye = std::nullopt, target = std::nullopt;
    float fov_degrees = 0;
};

const std::vector<Case> cases{
    {"cornell_box", "assets/cornell_box.glb"},
    {"veach_plates", "assets/veach_plates.glb"},
    {"many_lights", "assets/many_lights.glb"},
    {"FlightHelmet", "models/FlightHelmet/FlightHelmet.gltf", "environments/chinese_garden_1k.hdr"},
    {"GlassVaseFlowers", "models/GlassVaseFlowers/glTF/GlassVaseFlowers.gltf", "environments/chinese_garden_1k.hdr"},
    {"HotelRoom", "models/HotelRoom/scene.glb", "", Vec3(10000, 1600, -6000), Vec3(12500, 1000, -9500), 70}};

std::string path_of(const std::string& name) {
    const std::filesystem::path root = CANDELA_SOURCE_DIR;
    if (name.empty() || name.starts_with("assets/")) return name.empty() ? name : (root / name).string();
    const char* data = std::getenv("CANDELA_GLTF_DATA");
    return ((data != nullptr ? std::filesystem::path(data) : root / "../shared/gltf") / name).string();
}

void print_rows(const Case& each, uint32_t seeds, uint32_t width) {
    RenderOptions options;
    options.scene = path_of(each.scene);
    options.hdri = path_of(each.hdri);
    options.eye = each.eye;
    options.target = each.target;
    if (each.fov_degrees > 0) options.fov_degrees = each.fov_degrees;
    options.resolution = Vec2u(width, width * 3 / 4);
    std::error_code error;
    if (!std::filesystem::exists(options.scene, error)) return;
    const RenderJob job = prepare_render(
        options, [](const char*, double) {}, nullptr);
    IntegratorSettings settings = job.request.settings;
    settings.seed = 1000;
    for (const test::Calibration& row : test::calibrate(*job.world, job.request.view, settings, {16, 64, 256, 1024},
                                                        seeds, std::max(1u, std::thread::hardware_concurrency()))) {
        fmt::print("| {} | {} | {:.3f} % | {:.3f} % | {:+.1f} % | {:+.1f} % | {:.1f} % |\n", each.name, row.spp,
                   100 * row.true_error, 100 * row.stated_error, 100 * (row.stated_error / row.true_error - 1),
                   100 * (row.worst_ratio - 1), 100 * row.covered);
        std::fflush(stdout);
    }
}

}  // namespace
}  // namespace candela::bench

int main(int argc, char** argv) {
    const auto seeds = static_cast<uint32_t>(argc > 1 ? std::max(2, std::atoi(argv[1])) : 8);
    const auto width = static_cast<uint32_t>(argc > 2 ? std::max(8, std::atoi(argv[2])) : 96);
    const std::string only = argc > 3 ? argv[3] : "";
    fmt::print(
        "| scene | spp | true mean error | stated | difference | of the worst picture | within the stated 95 % |\n"
        "| --- | --- | --- | --- | --- | --- | --- |\n");
    try {
        for (const candela::bench::Case& each : candela::bench::cases) {
            if (only.empty() || only == each.name) candela::bench::print_rows(each, seeds, width);
        }
    } catch (const candela::CommandError& error) {
        fmt::print(stderr, "candela_calibration: {}\n", error.what());
        return static_cast<int>(error.status());
    }
    return 0;
}
