// SPDX-License-Identifier: MIT
// What a person may edit, and the way back.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/viewer/light_mixer.h"
#include "app/viewer/view_control.h"
#include "renderer/image/tone.h"
#include "renderer/integrator/settings.h"
#include "renderer/scene/scene.h"

namespace candela {

// Which environment shines, and how.
struct EnvironmentChoice {
    std::string hdri;
    std::optional<Vec3> sky;
    float rotation_degrees = 0, intensity = 1;
    std::shared_ptr<const Environment> read;  // as it was read; null: none

    bool operator==(const EnvironmentChoice&) const = default;
};

struct Editable {
    std::vector<Material> materials;
    std::vector<PunctualLight> lights;
    OrbitView view;     // camera and lens
    bool scene = true;  // materials or lights differ from what they were edited to, or may
    ToneSettings tone;
    IntegratorSettings settings;
    std::vector<LightWeight> light_weights;
    EnvironmentChoice environment;
    // Of the file.
    std::optional<uint32_t> variant;
    uint32_t active_scene = 0;
    // That showed all this: an undone change of the environment shows it again, and with it the samples that it has.
    // Null: it is made anew.
    std::shared_ptr<const World> world;
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
    // What was added last was not done in the end.
    void forget_last();
    void clear();

  private:
    static constexpr size_t most = 100;
    // Environments are large: of each direction only so many worlds are kept.
    static constexpr size_t most_worlds = 4;
    static void drop_worlds(std::vector<Editable>& steps);
    std::vector<Editable> undo_, redo_;
};

}  // namespace candela
