// SPDX-License-Identifier: MIT
// Writes what a person does to a viewer as a recording, while it happens.
#pragma once

#include <fstream>

#include "app/viewer/recording.h"
#include "app/viewer/viewer.h"

namespace candela {

class SessionRecorder {
  public:
    // Writes to a file beside path, which a crash leaves behind. Throws CommandError where none can be made.
    SessionRecorder(std::string path, const std::vector<std::string>& arguments, Vec2u window);
    // Names the file as it was asked for. Throws CommandError where it is not all written.
    void finish();

    // Around what one round of the window's loop does to the viewer: its events, its update and, if so, its drawing.
    void begin_frame(const Viewer& viewer, double time_s, const std::vector<InputEvent>& events);
    void end_frame(const Viewer& viewer, bool drawn);

  private:
    void follow(const InputEvent& event);

    std::string path_, temporary_;
    std::ofstream file_;
    RecordedFrame frame_;
    uint32_t loads_written_ = 0;
    std::string notice_;  // that the last frame written ended with
    int held_ = 0;        // keys and buttons
    int settles_ = 0;     // frames until panels have settled
    bool clock_ran_ = false;
};

}  // namespace candela
