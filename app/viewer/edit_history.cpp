// SPDX-License-Identifier: MIT
#include "app/viewer/edit_history.h"

#include <utility>

namespace candela {

namespace {

Editable step(std::vector<Editable>& from, std::vector<Editable>& to, Editable now) {
    now.scene = from.back().scene;
    to.push_back(std::move(now));
    Editable out = std::move(from.back());
    from.pop_back();
    return out;
}

}  // namespace

void EditHistory::add(Editable before) {
    redo_.clear();
    if (undo_.size() == most) undo_.erase(undo_.begin());
    undo_.push_back(std::move(before));
    drop_worlds(undo_);
}

Editable EditHistory::undo(Editable now) {
    Editable out = step(undo_, redo_, std::move(now));
    drop_worlds(redo_);
    return out;
}

Editable EditHistory::redo(Editable now) {
    Editable out = step(redo_, undo_, std::move(now));
    drop_worlds(undo_);
    return out;
}

void EditHistory::drop_worlds(std::vector<Editable>& steps) {
    const World* last = nullptr;
    size_t worlds = 0;
    for (size_t i = steps.size(); i-- > 0;) {
        std::shared_ptr<const World>& world = steps[i].world;
        if (world != nullptr && world.get() != last) ++worlds;
        if (world != nullptr) last = world.get();
        if (worlds > most_worlds) world.reset();
    }
}

void EditHistory::forget_last() {
    if (can_undo()) undo_.pop_back();
}

void EditHistory::clear() {
    undo_.clear();
    redo_.clear();
}

}  // namespace candela
