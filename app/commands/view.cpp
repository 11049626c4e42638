// SPDX-License-Identifier: MIT
// candela view: the window and its loop.
#include <fmt/format.h>

#include "app/commands.h"
#include "app/interrupt.h"
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
    try {
        Window window(options.resolution.value_or(Vec2u(1280, 720)), "candela");
        Viewer viewer(options, window);
        std::string title = "candela";
        std::string reported;
        while (!viewer.wants_to_close() && !InterruptGuard::interrupted()) {
            for (const InputEvent& event : window.wait_for_events(viewer.seconds_until_update()))
                viewer.handle(event);
            if (viewer.update()) {
                viewer.draw();
                window.swap_buffers();
            }
            if (viewer.title() != title) window.set_title(title = viewer.title());
            if (viewer.load_error() != reported) {
                reported = viewer.load_error();
                if (!reported.empty()) fmt::print(stderr, "candela: {}\n", reported);
            }
        }
        if (InterruptGuard::interrupted()) return ExitStatus::interrupted;
        return viewer.model().has_scene() ? ExitStatus::done : viewer.load_status();
    } catch (const GlError& gl_error) {
        throw CommandError(ExitStatus::unwritable_output, fmt::format("window: {}", gl_error.what()));
    }
}

}  // namespace candela
