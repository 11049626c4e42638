// SPDX-License-Identifier: MIT
// Views that a person wants to come back to, and those that were left.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "app/viewer/view_control.h"
#include "renderer/image/tone.h"

namespace candela {

// Pose, projection and lens, and how it is displayed.
struct Bookmark {
    OrbitView view;
    ToneSettings tone;

    bool operator==(const Bookmark&) const = default;
};

using Bookmarks = std::array<std::optional<Bookmark>, 10>;  // by the digit of their key

// Goes back and on through views as a browser goes through pages.
class ViewHistory {
  public:
    // A view that was looked at. What had been gone back from is forgotten, unless it is the one where the history
    // stands.
    void add(const OrbitView& view);
    // The view before or after; none at the end.
    std::optional<OrbitView> step(int by);
    void clear() { *this = {}; }
    bool can_step(int by) const;

  private:
    std::vector<OrbitView> views_;
    size_t at_ = 0;
};

}  // namespace candela
