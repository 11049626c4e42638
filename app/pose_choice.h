// SPDX-License-Identifier: MIT
// The moment of an animation that the options ask for.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/options.h"
#include "renderer/scene/scene.h"

namespace candela {

// "walk" or, where an animation has no name, "animation 2".
std::string animation_title(const Scene& scene, uint32_t animation);

// The animation by name or index, the first where only a time is asked for, none where nothing is. Throws CommandError
// (wrong usage) that lists what there is.
std::optional<uint32_t> choose_animation(const RenderOptions& options, const Scene& rest);

// The scene at that time; rest itself where no animation is given. What could not be posed is added to the warnings.
// Shares its deformed meshes with `like`, where they are deformed alike; null: with rest.
std::shared_ptr<const Scene> scene_at(const std::shared_ptr<const Scene>& rest, std::optional<uint32_t> animation,
                                      double time_s, std::vector<std::string>& warnings, const Scene* like = nullptr);

}  // namespace candela
