// SPDX-License-Identifier: MIT
#include "app/viewer/session_recorder.h"

#include <unistd.h>

#include <utility>

#include "app/picture_file.h"

namespace candela {

namespace {

// Panels take two frames to find their places; one more shows what a click in the second did.
constexpr int settling_frames = 4;

}  // namespace

SessionRecorder::SessionRecorder(std::string path, const std::vector<std::string>& arguments, Vec2u window)
    : path_(std::move(path)), temporary_(path_ + ".part") {
    check_output(path_);
    file_.open(temporary_, std::ios::binary | std::ios::trunc);
    file_ << header_text(arguments, window) << std::flush;
    if (!file_) throw CommandError(ExitStatus::unwritable_output, path_ + ": the recording cannot be written");
}

void SessionRecorder::finish() {
    file_.close();
    std::error_code error;
    if (file_) std::filesystem::rename(temporary_, path_, error);
    if (!file_ || error)
        throw CommandError(ExitStatus::unwritable_output,
                           path_ + ": the recording cannot be written; what there is of it is in " + temporary_);
}

void SessionRecorder::follow(const InputEvent& event) {
    if (const auto* key = std::get_if<KeyPressed>(&event)) {
        // Repeated presses have one release; what is counted too much only costs lines.
        held_ = key->pressed ? 1 : 0;
    } else if (const auto* button = std::get_if<MousePressed>(&event)) {
        held_ = button->pressed ? 1 : 0;
    }
}

void SessionRecorder::begin_frame(const Viewer& viewer, double time_s, const std::vector<InputEvent>& events) {
    ++frame_.number;
    frame_.time_s = time_s;
    frame_.samples = viewer.shown_samples();
    frame_.events = events;
    clock_ran_ = viewer.clock_matters();
    for (const InputEvent& event : events)
        follow(event);
}

void SessionRecorder::end_frame(const Viewer& viewer, bool drawn) {
    frame_.loads = viewer.loads_taken();
    frame_.drawn = drawn;
    if (!frame_.events.empty() || frame_.loads != loads_written_) settles_ = settling_frames;
    const bool draws_what_may_change = drawn && (settles_ > 0 || held_ > 0);
    // Notices go away by themselves.
    const bool notice_changed = viewer.model().notice != notice_;
    const bool says_something = !frame_.events.empty() || frame_.loads != loads_written_ || clock_ran_ ||
                                viewer.clock_matters() || draws_what_may_change || notice_changed;
    if (drawn) settles_ = std::max(settles_ - 1, 0);
    if (!says_something) return;
    loads_written_ = frame_.loads;
    notice_ = viewer.model().notice;
    file_ << frame_text(frame_) << std::flush;
}

}  // namespace candela
