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
}

Editable EditHistory::undo(Editable now) {
    return step(undo_, redo_, std::move(now));
}

Editable EditHistory::redo(Editable now) {
    return step(redo_, undo_, std::move(now));
}

void EditHistory::clear() {
    undo_.clear();
    redo_.clear();
}

}  // namespace candela
