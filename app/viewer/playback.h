// SPDX-License-Identifier: MIT
// Where an animation stands and how it goes on: pure functions of time. All times are in seconds.
#pragma once

#include <optional>

#include "renderer/scene/animation.h"

namespace candela {

struct Playback {
    std::optional<uint32_t> animation;  // none: the scene at rest
    double time_s = 0;                  // where the timeline stands
    bool playing = false;

    bool operator==(const Playback&) const = default;
};

// The distance of the animation's keys where they are evenly spaced as frames are, 1/60 to 1/12; else 1/24.
double frame_step_s(const Animation& animation);

// After dt_s more; behind the end it begins again.
double advance(double time_s, double dt_s, double duration_s);
// The frame that is on at a time: poses change no more often than frames do.
double frame_at(double time_s, double step_s, double duration_s);
// The beginning of the frame that many further; beyond either end it begins at the other.
double step_frames(double time_s, int frames, double step_s, double duration_s);

}  // namespace candela
