// SPDX-License-Identifier: MIT
// candela_denoising [--references DIR] [SPP [WIDTH [SCENE]]]: how far the denoised preview is from a converged picture,
// beside what it is made from, with each path alone and with shared ones, as a Markdown table. Scenes that are absent
// are left out. References of 2048 samples per pixel are made, or taken from DIR if they are there.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "app/exit_status.h"
#include "app/render_job.h"
#include "renderer/denoise/denoise.h"
#include "renderer/image/codec.h"
#include "renderer/image/compare.h"
#include "renderer/integrator/guide_rays.h"

namespace candela::bench {
namespace {

struct Case {
    const char* name;
    const char* scene;  // "assets/…" in the project, anything else in the shared data
    std::optional<Vec3> eye = std::nullopt, target = std::nullopt;
};

const std::vector<Case> cases{
    {"HotelRoom, bed", "models/HotelRoom/scene.glb", Vec3(10000, 1600, -6000), Vec3(12500, 1000, -9500)},
    {"HotelRoom, window", "models/HotelRoom/scene.glb", Vec3(12600, 1500, -9500), Vec3(9500, 1000, -5500)},
    {"DreamApartment, kitchen", "models/DreamApartment/dream-apartment.glb", Vec3(8, 1.6, -6), Vec3(10, 1.1, -4.5)},
    {"DreamApartment, bedroom", "models/DreamApartment/dream-apartment.glb", Vec3(10, 1.6, -10), Vec3(9, 1, -11)},
    {"cornell_box", "assets/cornell_box.glb"},
    {"many_lights", "assets/many_lights.glb"}};

std::filesystem::path path_of(const std::string& name) {
    const std::filesystem::path root = CANDELA_SOURCE_DIR;
    if (name.starts_with("assets/")) return root / name;
    const char* data = std::getenv("CANDELA_GLTF_DATA");
    return (data != nullptr ? std::filesystem::path(data) : root / "../shared/gltf") / name;
}

struct Rendered {
    Film film;
    ImageRgba32f image;
};

Rendered render(const RenderJob& job, uint32_t spp, uint32_t seed, bool reuse_paths) {
    SessionOptions session_options;
    session_options.publish_frames = false;
    RenderSession session(session_options);
    RenderRequest request = job.request;
    request.max_spp = spp;
    request.settings.seed = seed;
    request.settings.reuse_paths = reuse_paths;
    session.submit(request);
    session.wait_until_done();
    return {session.snapshot_film(), session.latest()->image};
}

void print_row(const Case& each, uint32_t spp, uint32_t width, const std::string& references) {
    RenderOptions options;
    options.scene = path_of(each.scene).string();
    options.eye = each.eye;
    options.target = each.target;
    if (each.eye) options.fov_degrees = 70.0f;
    options.resolution = Vec2u(width, width * 3 / 4);
    std::error_code error;
    if (!std::filesystem::exists(options.scene, error)) return;
    const RenderJob job = prepare_render(
        options, [](const char*, double) {}, nullptr);

    const std::string stored = references.empty() ? "" : fmt::format("{}/{}-{}.exr", references, each.name, width);
    ImageRgba32f reference;
    if (!stored.empty() && std::filesystem::exists(stored, error)) {
        reference = read_linear(stored);
    } else {
        reference = render(job, 2048, 1000, true).image;
        if (!stored.empty()) write_exr(stored, reference, false, {});
    }

    for (const bool shared : {false, true}) {
        const char* const how = shared ? "shared" : "alone";
        const Rendered noisy = render(job, spp, 0, shared);
        const auto start = std::chrono::steady_clock::now();
        Guides guides(job.request.view.extent);
        add_guides(*job.world, job.request.view, job.request.settings, std::min(spp, 16u), guides);
        const auto guided = std::chrono::steady_clock::now();
        const ImageRgba32f denoised = denoise(noisy.film, guides);
        const auto end = std::chrono::steady_clock::now();
        if (!references.empty()) {
            write_exr(fmt::format("{}/{}-{}-{}-noisy.exr", references, each.name, width, how), noisy.image, false, {});
            write_exr(fmt::format("{}/{}-{}-{}-denoised.exr", references, each.name, width, how), denoised, false, {});
        }
        const ImageDifference before = compare_images(noisy.image, reference),
                              after = compare_images(denoised, reference);
        fmt::print("| {}, {} | {:.4g} | {:.4g} | {:.1f} | {:.3f} | {:.3f} | {:+.1f} % | {:.0f} + {:.0f} ms |\n",
                   each.name, how, before.rel_mse, after.rel_mse, before.rel_mse / after.rel_mse, before.flip,
                   after.flip, 100 * after.signed_mean / std::max(before.rmse, 1e-9),
                   std::chrono::duration<double, std::milli>(guided - start).count(),
                   std::chrono::duration<double, std::milli>(end - guided).count());
        std::fflush(stdout);
    }
}

}  // namespace
}  // namespace candela::bench

int main(int argc, char** argv) {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    std::string references;
    if (arguments.size() >= 2 && arguments[0] == "--references") {
        references = arguments[1];
        arguments.erase(arguments.begin(), arguments.begin() + 2);
    }
    const auto number = [&](size_t i, int least, int otherwise) {
        return static_cast<uint32_t>(i < arguments.size() ? std::max(least, std::atoi(arguments[i].c_str()))
                                                          : otherwise);
    };
    const uint32_t spp = number(0, 2, 16), width = number(1, 16, 320);
    const std::string only = arguments.size() > 2 ? arguments[2] : "";
    fmt::print(
        "| scene | relMSE | denoised | ratio | FLIP | denoised | mean | guides + filter |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
    try {
        for (const candela::bench::Case& each : candela::bench::cases) {
            if (std::string(each.name).starts_with(only)) candela::bench::print_row(each, spp, width, references);
        }
    } catch (const candela::CommandError& error) {
        fmt::print(stderr, "candela_denoising: {}\n", error.what());
        return static_cast<int>(error.status());
    }
    return 0;
}
