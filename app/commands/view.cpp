// SPDX-License-Identifier: MIT
// candela view: the window and its loop.
#include <fmt/format.h>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/statistics_file.h"
#include "app/stopwatch.h"
#include "app/viewer/desktop.h"
#include "app/viewer/session_recorder.h"
#include "app/viewer/window.h"

namespace candela {

ExitStatus run_view(const RenderOptions& requested, const RememberedSettings& remembered) {
    RenderOptions options = requested;
    if (options.scene.empty()) options.scene = default_scene().string();
    std::error_code error;
    if (!std::filesystem::exists(options.scene, error)) {
        throw CommandError(ExitStatus::unreadable_scene, options.scene + ": there is no such file");
    }
    const InterruptGuard guard;
    const Clock::time_point start = Clock::now();
    double first_frame_seconds = 0;
    try {
        // A size that nobody chose is the same on every screen, as the eye has it.
        const bool usual = !options.resolution && !remembered.window;
        Window window(options.resolution.value_or(remembered.window.value_or(Vec2u(1280, 720))), "candela", usual);
        // What happens in one round of the loop happens at one time, so that a replay can have it happen again.
        double now_s = 0;
        ViewerOptions viewer_options;
        viewer_options.now_s = [&now_s] { return now_s; };
        std::optional<SessionRecorder> recorder;
        if (!options.record.empty()) {
            recorder.emplace(options.record, options.arguments, window.framebuffer_extent());
            // Whether a preview came before some input would be chance.
            viewer_options.previews = false;
        }
        Viewer viewer(options, window, viewer_options);
        Desktop desktop(
            {settings_path(), remembered, options.watch, [&](const std::string& text) { window.set_clipboard(text); },
             [](const std::string& line) { fmt::print(stderr, "candela: warning: {}\n", line); },
             // A recording has no bookmarks but those that are stored in it.
             options.record.empty() ? bookmarks_path() : std::filesystem::path()},
            viewer, window.extent());
        std::string title = "candela";
        std::string reported;
        while (!viewer.wants_to_close() && !InterruptGuard::interrupted()) {
            std::vector<InputEvent> events =
                window.wait_for_events(std::min(viewer.seconds_until_update(), desktop.longest_sleep_s()));
            // In microseconds, so that it is short to write.
            now_s = std::round(1e6 * seconds_since(start)) / 1e6;
            desktop.add_events(viewer, now_s, events);
            if (recorder) recorder->begin_frame(viewer, now_s, events);
            for (const InputEvent& event : events)
                viewer.handle(event);
            const bool draws = viewer.update();
            if (viewer.frame() != nullptr && first_frame_seconds == 0) first_frame_seconds = seconds_since(start);
            if (draws) {
                viewer.draw();
                window.swap_buffers();
                // The latency ends here; nothing else looks at the clock before the next round.
                now_s = seconds_since(start);
                viewer.presented();
            }
            if (recorder) recorder->end_frame(viewer, draws);
            desktop.serve(viewer, window.extent());
            if (viewer.title() != title) window.set_title(title = viewer.title());
            if (viewer.load_error() != reported) {
                reported = viewer.load_error();
                if (!reported.empty()) fmt::print(stderr, "candela: {}\n", reported);
            }
        }
        if (recorder) recorder->finish();
        desktop.remember(viewer, window.extent());
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
