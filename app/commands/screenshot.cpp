// SPDX-License-Identifier: MIT
// candela screenshot: the viewer's own picture, drawn off-screen.
#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "app/clock_text.h"
#include "app/commands.h"
#include "app/gl/osmesa_context.h"
#include "app/interrupt.h"
#include "app/picture_file.h"
#include "app/progress_bar.h"
#include "app/statistics_file.h"
#include "app/viewer/viewer.h"

namespace candela {

ExitStatus run_screenshot(const RenderOptions& requested, bool with_interface) {
    RenderOptions options = requested;
    if (options.scene.empty()) options.scene = default_scene().string();
    if (extension_of(options.output) != ".png") {
        throw CommandError(ExitStatus::wrong_usage, options.output + ": a screenshot must end in .png");
    }
    check_output(options.output);
    const auto start = std::chrono::steady_clock::now();
    const auto seconds_since_start = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    double first_frame_seconds = 0;
    if (!options.spp && !options.seconds && !options.until_error_percent) options.spp = 256;
    const InterruptGuard guard;
    ProgressBar bar(options.quiet, options.verbose);
    try {
        const Vec2u extent = options.resolution.value_or(Vec2u(1280, 720));
        const OsmesaContext context(extent);
        ViewerOptions viewer_options;
        viewer_options.interface = with_interface;
        viewer_options.previews = false;
        Viewer viewer(options, context, viewer_options);
        while (!viewer.finished() && !InterruptGuard::interrupted()) {
            viewer.update();
            if (viewer.frame() != nullptr && first_frame_seconds == 0) first_frame_seconds = seconds_since_start();
            const SessionStatus& status = viewer.model().status;
            if (viewer.model().has_scene()) {
                bar.show("render", options.spp ? static_cast<double>(status.spp) / *options.spp : 0.0,
                         fmt::format("{} spp  {}", status.spp, clock_text(status.render_seconds)));
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(3));
        }
        bar.clear();
        if (!viewer.model().has_scene()) {
            throw CommandError(
                InterruptGuard::interrupted() ? ExitStatus::interrupted : viewer.load_status(),
                viewer.load_error().empty() ? "interrupted before the scene was loaded" : viewer.load_error());
        }
        if (!options.quiet) {
            for (const std::string& warning : viewer.model().job.warnings)
                fmt::print(stderr, "candela: warning: {}\n", warning);
        }

        // Panels need two frames to find their places.
        for (int i = 0; i < 3; ++i) {
            viewer.update();
            viewer.draw();
            viewer.presented();
        }
        const double before_write = seconds_since_start();
        write_png(options.output, read_back(context), false,
                  picture_header(options.command, viewer.model().job.request));
        if (viewer.frame() != nullptr) {
            write_statistics({&options, &viewer.model().job, viewer.model().status, viewer.frame(),
                              seconds_since_start() - before_write, first_frame_seconds});
        }
    } catch (const GlError& error) {
        throw CommandError(ExitStatus::unwritable_output, fmt::format("{}: {}", options.output, error.what()));
    } catch (const ImageError& error) {
        throw CommandError(ExitStatus::unwritable_output,
                           options.output + ": " + error.what() + "; nothing was written");
    }
    return InterruptGuard::interrupted() ? ExitStatus::interrupted : ExitStatus::done;
}

}  // namespace candela
