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
    std::shared_ptr<const World> world;
    RenderRequest request;
    std::vector<std::string> warnings;
    double load_seconds = 0, build_seconds = 0;
};

// The scene that opens without one being named. Throws CommandError where the assets are not found.
std::filesystem::path default_scene();

// Loads the scene and builds its world. progress: step, 0..1. Throws CommandError (unreadable scene, wrong usage).
RenderJob prepare_render(const RenderOptions& options, const std::function<void(const char*, double)>& progress,
                         const std::atomic<bool>* cancel);

}  // namespace candela
