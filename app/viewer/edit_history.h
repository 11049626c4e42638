// SPDX-License-Identifier: MIT
// What a person may edit, and the way back.
#pragma once

#include <vector>

#include "app/viewer/view_control.h"
#include "renderer/scene/scene.h"

namespace candela {

struct Editable {
    std::vector<Material> materials;
    std::vector<PunctualLight> lights;
    OrbitView view;     // camera and lens
    bool scene = true;  // materials or lights differ from what they were edited to, or may
};

class EditHistory {
  public:
    // What there was before an edit; what was undone cannot be redone any more.
    void add(Editable before);
    bool can_undo() const { return !undo_.empty(); }
    bool can_redo() const { return !redo_.empty(); }
    // Takes what there is now, and returns what there was; only where there is something.
    Editable undo(Editable now);
    Editable redo(Editable now);
    void clear();

  private:
    static constexpr size_t most = 100;
    std::vector<Editable> undo_, redo_;
};

}  // namespace candela
