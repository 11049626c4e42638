// SPDX-License-Identifier: MIT
#include "app/viewer/bookmarks.h"

namespace candela {

namespace {

constexpr size_t most_views = 64;

}  // namespace

void ViewHistory::add(const OrbitView& view) {
    if (!views_.empty() && views_[at_] == view) return;
    if (!views_.empty()) views_.resize(at_ + 1);
    if (views_.size() == most_views) views_.erase(views_.begin());
    views_.push_back(view);
    at_ = views_.size() - 1;
}

bool ViewHistory::can_step(int by) const {
    return by < 0 ? at_ > 0 : at_ + 1 < views_.size();
}

std::optional<OrbitView> ViewHistory::step(int by) {
    if (!can_step(by)) return std::nullopt;
    at_ = by < 0 ? at_ - 1 : at_ + 1;
    return views_[at_];
}

}  // namespace candela
