// SPDX-License-Identifier: MIT
// Going back to views: bookmarks, and those that were left. Their samples wait in the session.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/viewer/viewer.h"

namespace candela {

namespace {

// A view that was left sooner was only passed by.
constexpr double looked_at_seconds = 0.25;

}  // namespace

bool Viewer::is_bookmarked(const OrbitView& view) const {
    return std::any_of(model_.bookmarks.begin(), model_.bookmarks.end(), [&](const std::optional<Bookmark>& bookmark) {
        return bookmark && bookmark->view.camera == view.camera;
    });
}

void Viewer::store_bookmark(size_t digit) {
    if (!model_.has_scene()) return;
    model_.bookmarks[digit] = Bookmark{model_.view, model_.display.tone};
    session_->bookmark_view();
    notify(fmt::format("view stored: Shift+{} comes back to it", digit));
}

void Viewer::recall_bookmark(size_t digit) {
    if (!model_.has_scene()) return;
    const std::optional<Bookmark>& bookmark = model_.bookmarks[digit];
    if (!bookmark) {
        notify(fmt::format("no view is stored as {0}: Ctrl+{0} stores one", digit));
        return;
    }
    add_step(editable_with(model_.view));
    model_.display.tone = bookmark->tone;
    set_view(bookmark->view);
    redraws_ = 2;
}

void Viewer::step_view(int by) {
    if (!model_.has_scene()) return;
    // So that the way back leads here again.
    if (!view_history_.can_step(1)) view_history_.add(model_.view);
    if (const std::optional<OrbitView> view = view_history_.step(by)) {
        steps_history_ = true;
        add_step(editable_with(model_.view));
        set_view(*view);
    } else {
        notify(by < 0 ? "there is no view before this one" : "there is no view after this one");
    }
}

// Before another view is submitted.
void Viewer::remember_view() {
    const OrbitView left = std::exchange(submitted_view_, model_.view);
    const bool stepped = std::exchange(steps_history_, false);
    if (left == model_.view) return;
    const bool looked_at = now_s() - std::exchange(viewed_since_s_, now_s()) >= looked_at_seconds;
    if (looked_at && !stepped) view_history_.add(left);
}

void Viewer::offer_bookmarks(const Bookmarks& bookmarks) {
    for (size_t digit = 0; digit < bookmarks.size(); ++digit) {
        if (!model_.bookmarks[digit]) model_.bookmarks[digit] = bookmarks[digit];
    }
    redraws_ = std::max(redraws_, 1);
}

void Viewer::forget_views(bool bookmarks_too) {
    view_history_.clear();
    if (bookmarks_too) model_.bookmarks = {};
    submitted_view_ = model_.view;
    viewed_since_s_ = now_s();
}

// The groups of the world that is shown, and how bright each of them is.
void Viewer::weigh_lights() {
    if (model_.lights.on && grouped_world_ != model_.job.world) {
        grouped_world_ = model_.job.world;
        model_.lights.take(make_light_groups(*grouped_world_));
    }
    weighing_ = session_->weigh_lights(model_.lights.values());
    if (other_session_ != nullptr) other_session_->weigh_lights(model_.lights.values());
    redraws_ = std::max(redraws_, 2);
}

bool Viewer::weighing_is_missing() const {
    return frame_ != nullptr && frame_->weighing != weighing_ && model_.status.error.empty();
}

void Viewer::presented() {
    latency_.shown(model_.frame_epoch, now_s());
    if (!viewer_options_.steady_figures) model_.latency = latency_.summary();
}

}  // namespace candela
