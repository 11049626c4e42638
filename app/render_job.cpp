// SPDX-License-Identifier: MIT
#include "app/render_job.h"

#include <fmt/format.h>

#include <charconv>

#include "app/exit_status.h"
#include "app/pose_choice.h"
#include "app/stopwatch.h"
#include "renderer/image/codec.h"
#include "renderer/io/load_gltf.h"
#include "renderer/scene/without_pictures.h"

namespace candela {

namespace {

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

// Where neither the options nor the file bring an environment.
std::shared_ptr<const Environment> neutral_sky() {
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
    job.build_seconds += seconds_since(build_start);
}

// One opening. The world is built as soon as the geometry is there; when the pictures are too, it takes them in.
class Opening {
  public:
    Opening(const RenderOptions& options, const std::function<void(const char*, double)>& progress,
            const std::atomic<bool>* cancel, const std::function<void(RenderJob)>& preview)
        : options_(options), progress_(progress), cancel_(cancel), preview_(preview) {}

    RenderJob run();

  private:
    Scene load(Diagnostics& diagnostics);
    void build_without_pictures(const Scene& loaded);
    void build_world_of(std::shared_ptr<const Scene> rest);
    // As far as it is known before the scene's pictures are there.
    std::shared_ptr<const Environment> environment_for(const Scene& scene);
    void fill_request(RenderJob& job, const Scene& scene) const;

    const RenderOptions& options_;
    const std::function<void(const char*, double)>& progress_;
    const std::atomic<bool>* cancel_;
    const std::function<void(RenderJob)>& preview_;
    RenderJob job_;
    // Before the pictures: the world, its scene with the real materials, and the environment.
    std::shared_ptr<const Scene> early_scene_;
    std::shared_ptr<const Environment> early_environment_, given_environment_;
    std::vector<std::string> environment_warnings_, pose_warnings_;
};

std::shared_ptr<const Environment> Opening::environment_for(const Scene& scene) {
    environment_warnings_.clear();
    if (!options_.hdri.empty() || options_.sky) {
        if (!given_environment_) given_environment_ = read_environment(options_);
        return given_environment_;
    }
    if (scene.environment) return std::make_shared<const Environment>(*scene.environment);
    if (has_light(scene)) return nullptr;
    environment_warnings_.emplace_back(
        "the scene has no light of its own, so a neutral sky of radiance 1 lights it; --sky or --hdri choose another");
    return early_environment_ ? early_environment_ : neutral_sky();
}

void Opening::fill_request(RenderJob& job, const Scene& scene) const {
    job.request.world = job.world;
    job.request.view.camera = choose_camera(options_, scene, job.world->bounds);
    job.request.view.extent = choose_extent(options_, job.request.view.camera);
    job.request.settings = options_.integrator;
    const bool limited = options_.seconds || options_.until_error_percent;
    job.request.max_spp = options_.spp.value_or(limited ? std::numeric_limits<uint32_t>::max() : 256u);
    if (options_.seconds) job.request.max_seconds = *options_.seconds;
    if (options_.until_error_percent) job.request.until_relative_error = *options_.until_error_percent / 100.0;
}

void Opening::build_without_pictures(const Scene& loaded) {
    progress_("build", 0.4);
    const auto rest = std::make_shared<const Scene>(loaded);
    early_scene_ = scene_at(rest, choose_animation(options_, *rest), first_time_s(options_), pose_warnings_);
    const auto stand_in = std::make_shared<const Scene>(without_pictures(*early_scene_));
    // A scene that only its pictures light is shown under a sky until then.
    early_environment_ = environment_for(*early_scene_);
    const bool dark = early_environment_ == nullptr && !has_light(*stand_in);
    if (dark) early_environment_ = neutral_sky();
    BuildOptions build;
    build.environment = place_environment(early_environment_.get(), options_);
    build.cancel = cancel_;
    make_job_world(job_, cancel_, [&] { return build_world(stand_in, build); });
    if (!preview_) return;
    RenderJob shown = job_;
    shown.rest = rest;
    shown.environment = early_environment_;
    fill_request(shown, *stand_in);
    preview_(std::move(shown));
}

// From nothing, or from what was built without the pictures.
void Opening::build_world_of(std::shared_ptr<const Scene> rest) {
    progress_("build", 1.0);
    const std::shared_ptr<const World> early = std::move(job_.world);
    pose_warnings_.clear();
    const std::shared_ptr<const Scene> scene =
        scene_at(rest, choose_animation(options_, *rest), first_time_s(options_), pose_warnings_, early_scene_.get());
    job_.environment = environment_for(*scene);
    job_.rest = std::move(rest);
    BuildOptions build;
    build.cancel = cancel_;
    if (!early || job_.environment != early_environment_)
        build.environment = place_environment(job_.environment.get(), options_);
    make_job_world(job_, cancel_, [&] {
        return early ? with_pictures(early, scene, job_.environment == early_environment_, build)
                     : build_world(scene, build);
    });
    fill_request(job_, *scene);
}

Scene Opening::load(Diagnostics& diagnostics) {
    LoadOptions load;
    static_cast<LoadLimits&>(load) = options_.limits;
    load.scene = options_.scene_index;
    load.variant = options_.variant;
    load.cancel = cancel_;
    load.progress = [&](float fraction, const char* step) { progress_(step, static_cast<double>(fraction)); };
    load.geometry_ready = [&](const Scene& scene) { build_without_pictures(scene); };
    try {
        return load_gltf(job_.scene_path, diagnostics, load);
    } catch (const ChoiceError& error) {
        throw CommandError(ExitStatus::wrong_usage, error.what());
    } catch (const LoadError& error) {
        const bool stopped = cancel_ != nullptr && cancel_->load();
        throw CommandError(stopped ? ExitStatus::interrupted : ExitStatus::unreadable_scene, error.what());
    }
}

RenderJob Opening::run() {
    job_.scene_path = options_.scene.empty() ? default_scene().string() : options_.scene;
    const Clock::time_point start = Clock::now();
    Diagnostics diagnostics;
    auto rest = std::make_shared<const Scene>(load(diagnostics));
    job_.load_seconds = seconds_since(start) - job_.build_seconds;
    build_world_of(std::move(rest));
    for (const Diagnostic& warning : diagnostics.warnings()) {
        job_.warnings.push_back(warning.where.empty() ? warning.message : warning.where + ": " + warning.message);
    }
    for (const std::vector<std::string>& more : {environment_warnings_, pose_warnings_, job_.world->warnings})
        job_.warnings.insert(job_.warnings.end(), more.begin(), more.end());
    return std::move(job_);
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
    job.build_seconds = 0;
    make_job_world(job, cancel, [&] { return with_pose(job.world, scene, build); });
    job.request.world = job.world;
    // A view that was framed or given stays.
    if (!options.eye && !scene->cameras.empty()) {
        job.request.view.camera = choose_camera(options, *scene, job.world->bounds);
    }
}

namespace {

// Changes the scene that is shown and the one at rest alike; geometry stays as it is.
template <typename Edit>
void show_edited(RenderJob& job, const Edit& edit, const std::atomic<bool>* cancel) {
    auto scene = std::make_shared<Scene>(*job.world->scene), rest = std::make_shared<Scene>(*job.rest);
    edit(*scene);
    edit(*rest);
    job.rest = rest;
    BuildOptions build;
    build.cancel = cancel;
    job.build_seconds = 0;
    make_job_world(job, cancel, [&] { return with_pose(job.world, scene, build); });
    job.request.world = job.world;
}

}  // namespace

void edit_scene(RenderJob& job, const std::vector<Material>& materials, const std::vector<PunctualLight>& lights,
                const std::atomic<bool>* cancel) {
    show_edited(
        job,
        [&](Scene& scene) {
            scene.materials = materials;
            scene.lights = lights;
        },
        cancel);
}

void show_variant(RenderJob& job, std::optional<uint32_t> variant, const std::atomic<bool>* cancel) {
    show_edited(
        job, [&](Scene& scene) { scene.active_variant = variant; }, cancel);
}

RenderJob prepare_render(const RenderOptions& options, const std::function<void(const char*, double)>& progress,
                         const std::atomic<bool>* cancel, const std::function<void(RenderJob)>& preview) {
    return Opening(options, progress, cancel, preview).run();
}

}  // namespace candela
