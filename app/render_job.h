// SPDX-License-Identifier: MIT
// From options to what a session renders: one place for the window and for headless commands.
#pragma once

#include <filesystem>
#include <functional>

#include "app/options.h"
#include "renderer/io/diagnostics.h"
#include "renderer/session/render_session.h"

namespace candela {

struct RenderJob {
    std::string scene_path;
    std::shared_ptr<const Scene> rest;  // as loaded, before any animation
    std::shared_ptr<const World> world;
    // As read, without --hdri-rotation and --hdri-intensity; null where only the scene's own lights shine.
    std::shared_ptr<const Environment> environment;
    RenderRequest request;
    std::vector<std::string> warnings;
    double load_seconds = 0, build_seconds = 0;  // one after the other; pictures decode during both
};

// Where the scenes that ship with candela lie. Throws CommandError.
std::filesystem::path assets_folder();
// The scene that opens without one being named. Throws CommandError where the assets are not found.
std::filesystem::path default_scene();

// Loads the scene and builds its world, while its pictures are decoded on other threads. progress: step, 0..1. preview:
// gets the job as it would be without the pictures, before they are all decoded, if there are any; what follows may
// still fail. Throws CommandError (unreadable scene, wrong usage).
RenderJob prepare_render(const RenderOptions& options, const std::function<void(const char*, double)>& progress,
                         const std::atomic<bool>* cancel, const std::function<void(RenderJob)>& preview = {});

// Shows another moment of the animation: a new world, and the file's camera where it now stands. Throws CommandError.
void show_pose(RenderJob& job, const RenderOptions& options, uint32_t animation, double time_s,
               const std::atomic<bool>* cancel);

// Shows the job's scene with the materials of another variant (none: each primitive's own): a new world, of the same
// geometry. Throws CommandError.
void show_variant(RenderJob& job, std::optional<uint32_t> variant, const std::atomic<bool>* cancel);

// Gives the job's scene other materials and lights, as many as it has: a new world, of the same geometry. Throws
// CommandError.
void edit_scene(RenderJob& job, const std::vector<Material>& materials, const std::vector<PunctualLight>& lights,
                const std::atomic<bool>* cancel);

// The environment that the options name. Throws CommandError.
std::shared_ptr<const Environment> read_environment(const RenderOptions& options);
// A world with that environment (null: none) as the options turn and scale it.
std::shared_ptr<const World> with_environment(const std::shared_ptr<const World>& world,
                                              const std::shared_ptr<const Environment>& environment,
                                              const RenderOptions& options);

}  // namespace candela
