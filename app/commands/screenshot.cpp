// SPDX-License-Identifier: MIT
// candela screenshot: the viewer's own picture, drawn off-screen.
#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "app/clock_text.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/picture_file.h"
#include "app/progress_bar.h"
#include "app/statistics_file.h"
#include "app/stopwatch.h"
#include "app/viewer/replay.h"

namespace candela {

namespace {

void check_screenshot(const RenderOptions& options) {
    if (extension_of(options.output) != ".png") {
        throw CommandError(ExitStatus::wrong_usage, options.output + ": a screenshot must end in .png");
    }
    check_output(options.output);
}

// What there is to see while it renders.
class Watch {
  public:
    explicit Watch(const RenderOptions& options) : options_(options), bar_(options.quiet, options.verbose) {}

    // Returns whether to go on.
    bool look(const Viewer& viewer) {
        if (viewer.frame() != nullptr && first_frame_seconds_ == 0) first_frame_seconds_ = seconds_since(start_);
        const SessionStatus& status = viewer.model().status;
        if (viewer.model().has_scene()) {
            bar_.show("render", options_.spp ? static_cast<double>(status.spp) / *options_.spp : 0.0,
                      fmt::format("{} spp  {}", status.spp, clock_text(status.render_seconds)));
        }
        return !InterruptGuard::interrupted();
    }
    void finish(const Viewer& viewer) {
        bar_.clear();
        if (!viewer.model().has_scene()) {
            throw CommandError(
                InterruptGuard::interrupted() ? ExitStatus::interrupted : viewer.load_status(),
                viewer.load_error().empty() ? "interrupted before the scene was loaded" : viewer.load_error());
        }
        if (options_.quiet) return;
        for (const std::string& warning : viewer.model().job.warnings)
            fmt::print(stderr, "candela: warning: {}\n", warning);
    }
    void write(const Viewer& viewer, const ImageRgba8& picture) {
        const Clock::time_point before_write = Clock::now();
        write_png(options_.output, picture, false, picture_header(options_.command, viewer.model().job.request));
        if (viewer.frame() == nullptr) return;
        write_statistics({&options_, &viewer.model().job, viewer.model().status, viewer.frame(),
                          seconds_since(before_write), first_frame_seconds_});
    }

  private:
    const RenderOptions& options_;
    ProgressBar bar_;
    Clock::time_point start_ = Clock::now();
    double first_frame_seconds_ = 0;
};

// Both ways to a picture fail alike.
template <typename Work>
ExitStatus guarded(const RenderOptions& options, Work&& work) {
    const InterruptGuard guard;
    try {
        work();
    } catch (const GlError& error) {
        throw CommandError(ExitStatus::unwritable_output, fmt::format("{}: {}", options.output, error.what()));
    } catch (const ImageError& error) {
        throw CommandError(ExitStatus::unwritable_output,
                           options.output + ": " + error.what() + "; nothing was written");
    }
    return InterruptGuard::interrupted() ? ExitStatus::interrupted : ExitStatus::done;
}

}  // namespace

ExitStatus run_screenshot(const RenderOptions& requested, bool with_interface) {
    RenderOptions options = requested;
    if (options.scene.empty()) options.scene = default_scene().string();
    check_screenshot(options);
    if (!options.spp && !options.seconds && !options.until_error_percent) options.spp = 256;
    return guarded(options, [&] {
        Watch watch(options);
        const OsmesaContext context(options.resolution.value_or(Vec2u(1280, 720)));
        ViewerOptions viewer_options;
        viewer_options.interface = with_interface;
        viewer_options.previews = false;
        Viewer viewer(options, context, viewer_options);
        while (!viewer.finished()) {
            viewer.update();
            if (!watch.look(viewer)) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(3));
        }
        watch.finish(viewer);
        // Panels need two frames to find their places.
        for (int i = 0; i < 3; ++i) {
            viewer.update();
            viewer.draw();
            viewer.presented();
        }
        watch.write(viewer, read_back(context));
    });
}

ExitStatus run_replay(const Recording& recording, const RenderOptions& requested, bool with_interface) {
    RenderOptions options = requested;
    if (options.scene.empty()) options.scene = default_scene().string();
    check_screenshot(options);
    return guarded(options, [&] {
        Watch watch(options);
        Replay replay(recording, options);
        replay.play([&] { return watch.look(replay.viewer()); });
        watch.finish(replay.viewer());
        watch.write(replay.viewer(), replay.picture(with_interface));
    });
}

}  // namespace candela
