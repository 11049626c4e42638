// SPDX-License-Identifier: MIT
// candela view: the window and its loop.
#include <fmt/format.h>

#include <chrono>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/statistics_file.h"
#include "app/viewer/viewer.h"
#include "app/viewer/window.h"

namespace candela {

ExitStatus run_view(const RenderOptions& requested) {
    RenderOptions options = requested;
    if (options.scene.empty()) options.scene = default_scene().string();
    std::error_code error;
    if (!std::filesystem::exists(options.scene, error)) {
        throw CommandError(ExitStatus::unreadable_scene, options.scene + ": there is no such file");
    }
    const InterruptGuard guard;
    const auto start = std::chrono::steady_clock::now();
    double first_frame_seconds = 0;
    try {
        Window window(options.resolution.value_or(Vec2u(1280, 720)), "candela");
        Viewer viewer(options, window);
        std::string title = "candela";
        std::string reported;
        while (!viewer.wants_to_close() && !InterruptGuard::interrupted()) {
            for (const InputEvent& event : window.wait_for_events(viewer.seconds_until_update()))
                viewer.handle(event);
            const bool draws = viewer.update();
            if (viewer.frame() != nullptr && first_frame_seconds == 0) {
                first_frame_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            }
            if (draws) {
                viewer.draw();
                window.swap_buffers();
                viewer.presented();
            }
            if (viewer.title() != title) window.set_title(title = viewer.title());
            if (viewer.load_error() != reported) {
                reported = viewer.load_error();
                if (!reported.empty()) fmt::print(stderr, "candela: {}\n", reported);
            }
        }
        // The record is of the last view.
        if (viewer.frame() != nullptr) {
            write_statistics({&viewer.model().options, &viewer.model().job, viewer.model().status, viewer.frame(), 0.0,
                              first_frame_seconds});
        }
        if (InterruptGuard::interrupted()) return ExitStatus::interrupted;
        return viewer.model().has_scene() ? ExitStatus::done : viewer.load_status();
    } catch (const GlError& gl_error) {
        throw CommandError(ExitStatus::unwritable_output, fmt::format("window: {}", gl_error.what()));
    }
}

}  // namespace candela
