// SPDX-License-Identifier: MIT
#include "app/viewer/replay.h"

#include <fmt/format.h>

#include <thread>

namespace candela {

namespace {

constexpr uint32_t headless_spp = 256;

RenderOptions limited(RenderOptions options) {
    if (options.seconds)
        throw CommandError(ExitStatus::wrong_usage,
                           "--time: a replay counts samples, not seconds; use --spp or --until-error");
    if (!options.spp && !options.until_error_percent) options.spp = headless_spp;
    return options;
}

// How long loading took is nothing that a picture should depend on.
RenderJob prepare_timeless(const RenderOptions& options, const std::function<void(const char*, double)>& progress,
                           const std::atomic<bool>* cancel, const std::function<void(RenderJob)>& preview) {
    RenderJob job = prepare_render(options, progress, cancel, preview);
    job.load_seconds = job.build_seconds = 0;
    return job;
}

}  // namespace

ViewerOptions replayed_viewer(std::function<double()> now_s) {
    ViewerOptions out;
    out.now_s = std::move(now_s);
    out.previews = false;
    out.steady_figures = true;
    out.touches_files = false;
    out.prepare = prepare_timeless;
    return out;
}

Replay::Replay(const Recording& recording, const RenderOptions& options)
    : recording_(recording), context_(recording.window) {
    viewer_ = std::make_unique<Viewer>(limited(options), context_, replayed_viewer([this] { return now_s_; }));
    viewer_->allow_loads(0);
}

bool Replay::pause() {
    if (between_ && !between_()) stopped_ = true;
    if (!stopped_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return !stopped_;
}

// The picture that the person saw when they acted, or as much of it as there will be.
void Replay::wait_for_samples(const RecordedFrame& frame) {
    while (viewer_->shown_samples() < frame.samples && !viewer_->finished_rendering()) {
        if (!pause()) return;
        viewer_->update();
    }
}

void Replay::take_loads(const RecordedFrame& frame) {
    viewer_->allow_loads(frame.loads);
    viewer_->update();
    while (viewer_->loads_taken() < frame.loads) {
        if (!viewer_->loads())
            throw CommandError(ExitStatus::unreadable_scene,
                               fmt::format("{}:{}: {} loads have ended here, but only {} were begun", recording_.path,
                                           frame.line, frame.loads, viewer_->loads_taken()));
        if (!pause()) return;
        viewer_->update();
    }
}

void Replay::play(const std::function<bool()>& between) {
    between_ = between;
    for (const RecordedFrame& frame : recording_.frames) {
        if (stopped_) return;
        wait_for_samples(frame);
        now_s_ = frame.time_s;
        for (const InputEvent& event : frame.events) {
            if (const auto* size = std::get_if<WindowResized>(&event)) {
                if (size->pixels != context_.framebuffer_extent()) context_.resize(size->pixels);
            }
            viewer_->handle(event);
        }
        take_loads(frame);
        if (frame.drawn) viewer_->draw();
    }

    // Nothing holds it any more.
    viewer_->allow_loads(std::numeric_limits<uint32_t>::max());
    viewer_->update();
    PanelEdits go_on;
    go_on.toggle_pause = viewer_->model().status.paused;
    viewer_->apply(go_on);
    while (!viewer_->finished() && pause())
        viewer_->update();
}

ImageRgba8 Replay::picture(bool with_interface) {
    viewer_->show_interface(with_interface);
    // Panels need two frames to find their places.
    for (int i = 0; i < 3; ++i) {
        viewer_->update();
        viewer_->draw();
    }
    return read_back(context_);
}

}  // namespace candela
