// SPDX-License-Identifier: MIT
#include "app/viewer/frame_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/exit_status.h"
#include "app/frame_sequence.h"
#include "app/picture_file.h"

namespace candela {

namespace {

constexpr uint32_t most_pictures = 100000;

}  // namespace

uint32_t picture_count(const SequenceSettings& settings, double duration_s) {
    if (settings.kind == SequenceKind::turntable) return settings.pictures;
    // Of an animation that comes back to its beginning, the last moment is the first one again.
    const double pictures = std::ceil(duration_s * settings.fps - 1e-6);
    return static_cast<uint32_t>(std::clamp(pictures, 1.0, static_cast<double>(most_pictures)));
}

std::string free_sequence_path(const std::string& scene_path, SequenceKind kind) {
    const std::string stem = std::filesystem::path(scene_path).stem().string();
    for (int number = 1;; ++number) {
        std::string path = fmt::format("candela-{}-{}-{:03}.png", stem,
                                       kind == SequenceKind::turntable ? "turn" : "animation", number);
        std::error_code error;
        if (!std::filesystem::exists(numbered(path, 0), error)) return path;
    }
}

void FrameWriter::start(Order order) {
    written_ = 0;
    count_ = order.count;
    task_.start([this, order = std::move(order)](const std::atomic<bool>* cancel) mutable {
        return write(std::move(order), cancel);
    });
}

std::optional<FrameWriter::Outcome> FrameWriter::write(Order order, const std::atomic<bool>* cancel) {
    // One session after the other pose: what it has learnt of the scene stays.
    const Camera camera = order.job.request.view.camera;
    RenderRequest& request = order.job.request;
    request.max_spp = order.settings.spp;
    request.until_relative_error = 0;
    request.max_seconds = std::numeric_limits<double>::infinity();
    request.bookmarked = false;
    // Groups are of one world, and each pose is another.
    if (order.settings.kind == SequenceKind::animation) request.light_groups = nullptr;
    SessionOptions session_options;
    session_options.threads = order.options.threads;
    session_options.publish_frames = false;
    try {
        RenderSession session(session_options);
        session.weigh_lights(order.light_weights);
        for (uint32_t k = 0; k < order.count && !cancel->load(); ++k) {
            if (order.settings.kind == SequenceKind::turntable) {
                request.view.camera = turned_camera(camera, order.pivot, k, order.count);
            } else {
                const Vec2u extent = request.view.extent;
                show_pose(order.job, order.options, order.animation, k / order.settings.fps, cancel);
                request.view.extent = extent;
            }
            request.world = order.job.world;
            session.submit(request);
            while (!session.wait_until_done(0.05)) {
                if (cancel->load()) session.stop();
            }
            if (cancel->load()) break;
            if (const std::string error = session.status().error; !error.empty()) return Outcome{error, true};
            save_picture(numbered(order.path, k), *session.latest(), order.options.tone, request.settings,
                         picture_header(order.options.command, request));
            ++written_;
        }
    } catch (const CommandError& error) {
        if (!cancel->load()) return Outcome{error.what(), true};
    }
    const uint32_t written = written_;
    if (written == 0) return Outcome{"no picture was written", false};
    return Outcome{fmt::format("wrote {} picture{}: {} to {}", written, written == 1 ? "" : "s",
                               numbered(order.path, 0), numbered(order.path, written - 1)),
                   false};
}

}  // namespace candela
