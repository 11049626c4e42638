// SPDX-License-Identifier: MIT
#include "app/render_job.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>

#include "app/exit_status.h"
#include "app/pose_choice.h"
#include "renderer/image/codec.h"
#include "renderer/io/load_gltf.h"

namespace candela {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

CommandError usage(const std::string& line) {
    return {ExitStatus::wrong_usage, line};
}

// As the options turn and scale it.
std::optional<Environment> place_environment(const Environment* environment, const RenderOptions& options) {
    if (environment == nullptr) return std::nullopt;
    Environment out = *environment;
    out.rotation_radians += glm::radians(options.hdri_rotation_degrees);
    out.intensity *= options.hdri_intensity;
    return out;
}

bool has_light(const Scene& scene) {
    if (!scene.light_instances.empty()) return true;
    for (const Instance& instance : scene.instances) {
        for (const Primitive& primitive : scene.mesh(instance.mesh).primitives) {
            const MaterialId material = material_of(scene, primitive);
            if (material.valid() && scene.materials[material.value].emits()) return true;
        }
    }
    return false;
}

std::shared_ptr<const Environment> choose_environment(const RenderOptions& options, const Scene& scene,
                                                      std::vector<std::string>& warnings) {
    if (!options.hdri.empty() || options.sky) return read_environment(options);
    if (scene.environment) return std::make_shared<const Environment>(*scene.environment);
    if (has_light(scene)) return nullptr;
    warnings.push_back(
        "the scene has no light of its own, so a neutral sky of radiance 1 lights it; --sky or --hdri choose another");
    auto sky = std::make_shared<Environment>();
    sky->radiance = ImageRgb32f(1, 1, Vec3(1));
    return sky;
}

Camera choose_camera(const RenderOptions& options, const Scene& scene, const Bounds3& bounds) {
    const float aspect = options.resolution
                             ? static_cast<float>(options.resolution->x) / static_cast<float>(options.resolution->y)
                             : 16.0f / 9.0f;
    Camera camera;
    if (options.eye) {
        camera.world_from_camera = look_at(*options.eye, *options.target, options.up.value_or(Vec3(0, 1, 0)));
        camera.focus_distance_m = std::max(glm::length(*options.eye - *options.target), 1e-6f);
    } else if (!options.camera.empty()) {
        const CameraInstance* found = nullptr;
        for (const CameraInstance& each : scene.cameras) {
            if (each.name == options.camera) found = &each;
        }
        size_t index = 0;
        const char* end = options.camera.data() + options.camera.size();
        const auto parsed = std::from_chars(options.camera.data(), end, index);
        if (found == nullptr && parsed.ec == std::errc() && parsed.ptr == end && index < scene.cameras.size()) {
            found = &scene.cameras[index];
        }
        if (found == nullptr) {
            throw usage(fmt::format(
                "--camera {}: the scene has {} cameras and none of that name or index; candela info lists them",
                options.camera, scene.cameras.size()));
        }
        camera = found->camera;
    } else if (!scene.cameras.empty()) {
        camera = scene.cameras.front().camera;
    } else {
        camera = frame_bounds(bounds, aspect);
    }
    if (options.fov_degrees) camera.yfov_radians = glm::radians(*options.fov_degrees);
    if (options.projection) {
        // An orthographic picture spans what the perspective one does at the plane in focus.
        if (*options.projection == Projection::orthographic && camera.projection == Projection::perspective) {
            camera.ortho_half_height_m = camera.focus_distance_m * std::tan(0.5f * camera.yfov_radians);
        }
        camera.projection = *options.projection;
        if (camera.projection == Projection::panorama) camera.aspect = 2.0f;
    }
    camera.aperture_blades = options.blades;
    if (options.aperture_m) camera.aperture_diameter_m = *options.aperture_m;
    if (options.focus_m) camera.focus_distance_m = *options.focus_m;
    return camera;
}

Vec2u choose_extent(const RenderOptions& options, const Camera& camera) {
    if (options.resolution) return *options.resolution;
    constexpr uint32_t height = 720;
    const float aspect = camera.aspect > 0.0f ? camera.aspect : 16.0f / 9.0f;
    return {static_cast<uint32_t>(std::clamp(std::lround(aspect * height), 1l, 8192l)), height};
}

// Of the animation that the options choose.
double first_time_s(const RenderOptions& options) {
    return options.frames ? options.frames->first / options.fps : options.at_seconds.value_or(0.0);
}

// Calls make(), which builds a world, and books it in the job.
void make_job_world(RenderJob& job, const std::atomic<bool>* cancel,
                    const std::function<std::shared_ptr<const World>()>& make) {
    const Clock::time_point build_start = Clock::now();
    try {
        job.world = make();
    } catch (const AccelError& error) {
        const bool stopped = cancel != nullptr && cancel->load();
        throw CommandError(stopped ? ExitStatus::interrupted : ExitStatus::internal_error,
                           fmt::format("{}: {}", job.scene_path, error.what()));
    }
    job.build_seconds = seconds_since(build_start);
}

}  // namespace

std::shared_ptr<const Environment> read_environment(const RenderOptions& options) {
    auto out = std::make_shared<Environment>();
    if (options.hdri.empty()) {
        out->radiance = ImageRgb32f(1, 1, options.sky.value_or(Vec3(1)));
        return out;
    }
    try {
        const ImageRgba32f image = read_linear(options.hdri, image_limits(options.limits));
        out->radiance = ImageRgb32f(image.width(), image.height());
        for (size_t i = 0; i < image.size(); ++i)
            out->radiance.pixels()[i] = Vec3(image.pixels()[i]);
    } catch (const ImageError& error) {
        throw CommandError(
            ExitStatus::unreadable_scene,
            fmt::format("{}: {}; give an equirectangular .hdr or .exr file", options.hdri, error.what()));
    }
    return out;
}

std::shared_ptr<const World> with_environment(const std::shared_ptr<const World>& world,
                                              const std::shared_ptr<const Environment>& environment,
                                              const RenderOptions& options) {
    return with_environment(world, place_environment(environment.get(), options));
}

std::filesystem::path assets_folder() {
    const std::filesystem::path name = "cornell_box.glb";
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    for (const std::filesystem::path& folder :
         {std::filesystem::path(CANDELA_ASSETS_SOURCE), program.parent_path() / "../share/candela/assets"}) {
        if (std::filesystem::exists(folder / name, error)) return folder;
    }
    throw CommandError(ExitStatus::unreadable_scene,
                       "the scenes that ship with candela are not where they were installed; install them again");
}

std::filesystem::path default_scene() {
    return assets_folder() / "cornell_box.glb";
}

void show_pose(RenderJob& job, const RenderOptions& options, uint32_t animation, double time_s,
               const std::atomic<bool>* cancel) {
    std::vector<std::string> warnings;
    const std::shared_ptr<const Scene> scene = scene_at(job.rest, animation, time_s, warnings);
    BuildOptions build;
    build.cancel = cancel;
    make_job_world(job, cancel, [&] { return with_pose(job.world, scene, build); });
    job.request.world = job.world;
    // A view that was framed or given stays.
    if (!options.eye && !scene->cameras.empty()) {
        job.request.view.camera = choose_camera(options, *scene, job.world->bounds);
    }
}

void show_variant(RenderJob& job, std::optional<uint32_t> variant, const std::atomic<bool>* cancel) {
    auto scene = std::make_shared<Scene>(*job.world->scene), rest = std::make_shared<Scene>(*job.rest);
    scene->active_variant = rest->active_variant = variant;
    job.rest = rest;
    BuildOptions build;
    build.cancel = cancel;
    make_job_world(job, cancel, [&] { return with_pose(job.world, scene, build); });
    job.request.world = job.world;
}

RenderJob prepare_render(const RenderOptions& options, const std::function<void(const char*, double)>& progress,
                         const std::atomic<bool>* cancel) {
    RenderJob job;
    job.scene_path = options.scene.empty() ? default_scene().string() : options.scene;

    // Load.
    const Clock::time_point load_start = Clock::now();
    Diagnostics diagnostics;
    LoadOptions load;
    static_cast<LoadLimits&>(load) = options.limits;
    load.scene = options.scene_index;
    load.variant = options.variant;
    load.cancel = cancel;
    load.progress = [&](float fraction, const char*) { progress("load", static_cast<double>(fraction)); };
    std::shared_ptr<const Scene> scene;
    try {
        scene = std::make_shared<const Scene>(load_gltf(job.scene_path, diagnostics, load));
    } catch (const ChoiceError& error) {
        throw CommandError(ExitStatus::wrong_usage, error.what());
    } catch (const LoadError& error) {
        const bool stopped = cancel != nullptr && cancel->load();
        throw CommandError(stopped ? ExitStatus::interrupted : ExitStatus::unreadable_scene, error.what());
    }
    for (const Diagnostic& warning : diagnostics.warnings()) {
        job.warnings.push_back(warning.where.empty() ? warning.message : warning.where + ": " + warning.message);
    }
    job.load_seconds = seconds_since(load_start);

    job.environment = choose_environment(options, *scene, job.warnings);
    job.rest = scene;
    scene = scene_at(scene, choose_animation(options, *scene), first_time_s(options), job.warnings);
    BuildOptions build;
    build.environment = place_environment(job.environment.get(), options);
    build.cancel = cancel;
    make_job_world(job, cancel, [&] { return build_world(scene, build); });
    job.warnings.insert(job.warnings.end(), job.world->warnings.begin(), job.world->warnings.end());
    progress("build", 1.0);

    // What to render, and how long.
    job.request.world = job.world;
    job.request.view.camera = choose_camera(options, *scene, job.world->bounds);
    job.request.view.extent = choose_extent(options, job.request.view.camera);
    job.request.settings = options.integrator;
    const bool limited = options.seconds || options.until_error_percent;
    job.request.max_spp = options.spp.value_or(limited ? std::numeric_limits<uint32_t>::max() : 256u);
    if (options.seconds) job.request.max_seconds = *options.seconds;
    if (options.until_error_percent) job.request.until_relative_error = *options.until_error_percent / 100.0;
    return job;
}

}  // namespace candela
