// SPDX-License-Identifier: MIT
// Flying through the scene: which keys are held, how fast that is, and where it leads.
#pragma once

#include "app/viewer/input.h"
#include "app/viewer/view_control.h"

namespace candela {

class Flight {
  public:
    bool on() const { return on_; }
    void toggle();
    // Whether the key is one of flying, which then is heard of.
    bool handle(const KeyPressed& event);
    // A key is held that moves or turns.
    bool moves() const { return on_ && held_ != 0; }
    // Steps of the wheel.
    void change_speed(float steps);
    // In metres a second through a scene of that diagonal, without Shift.
    float speed(float scene_size_m) const;
    // Where the view is after so many seconds with the keys as they are.
    OrbitView advance(const OrbitView& view, double dt_s, float scene_size_m) const;

  private:
    bool on_ = false, fast_ = false;
    unsigned held_ = 0;  // a bit for each key of flying
    float factor_ = 1;   // of the speed
};

}  // namespace candela
