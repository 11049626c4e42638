// SPDX-License-Identifier: MIT
#include "app/viewer/light_mixer.h"

#include <fmt/format.h>

namespace candela {

void LightMixer::take(std::shared_ptr<const LightGroups> next) {
    const bool same = groups != nullptr && next != nullptr && groups->names == next->names;
    groups = std::move(next);
    if (!same) weights.assign(groups != nullptr ? groups->size() : 0, LightWeight{});
}

std::vector<Vec3> LightMixer::values() const {
    std::vector<Vec3> out;
    if (!on) return out;
    for (const LightWeight& weight : weights)
        out.push_back(weight.weight());
    return out;
}

std::string LightMixer::words() const {
    std::string out;
    if (!on) return out;
    for (size_t i = 0; i < weights.size(); ++i) {
        const LightWeight& weight = weights[i];
        if (weight.weight() == Vec3(1)) continue;
        if (!out.empty()) out += ", ";
        out += fmt::format("{} × {:.4g}", groups->names[i], weight.intensity);
        const Vec3& color = weight.color;
        if (color != Vec3(1)) out += fmt::format(" ({:.4g} {:.4g} {:.4g})", color.x, color.y, color.z);
    }
    return out;
}

}  // namespace candela
