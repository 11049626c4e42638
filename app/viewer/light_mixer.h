// SPDX-License-Identifier: MIT
// How bright each group of lights is shown: weights of samples that were traced already.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "renderer/integrator/light_groups.h"

namespace candela {

struct LightWeight {
    float intensity = 1;
    Vec3 color{1};

    Vec3 weight() const { return intensity * color; }
    bool operator==(const LightWeight&) const = default;
};

struct LightMixer {
    bool on = false;  // the samples are kept apart by their lights
    std::shared_ptr<const LightGroups> groups;
    std::vector<LightWeight> weights;  // one for each group

    // The groups of another world; weights stay where it has the same lights.
    void take(std::shared_ptr<const LightGroups> next);
    // For RenderSession::weigh_lights.
    std::vector<Vec3> values() const;
    // "environment × 0.5, lamp × 2 (1 0.9 0.8)"; empty while all are as they are.
    std::string words() const;
};

}  // namespace candela
