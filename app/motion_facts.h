// SPDX-License-Identifier: MIT
// The part of scene_facts.h that tells of what moves: animations, skins, morph targets.
#pragma once

#include <nlohmann/json.hpp>

#include "renderer/scene/scene.h"

namespace candela {

// Adds "animations" (name, duration_s, channels, and what they drive), "skins" (name, joints, the nodes that wear it)
// and "morph_targets" (mesh, how many, and the weights it begins with).
void describe_motion(const Scene& scene, nlohmann::ordered_json& out);

// The same as text, from what describe_motion wrote; at most limit lines of each kind.
void print_motion(const nlohmann::ordered_json& facts, size_t limit);

}  // namespace candela
