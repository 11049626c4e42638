// SPDX-License-Identifier: MIT
// A scene at a moment of one of its animations.
#pragma once

#include <memory>

#include "renderer/scene/scene.h"

namespace candela {

// Marks what animations can move or deform (Node::moves and reshapes), for all poses alike.
void mark_moving_nodes(Scene& scene);

// Places the scene's nodes and deforms its meshes as its nodes now stand: instances, light_instances, cameras and posed
// meshes are made anew. Where a mesh is deformed as in `like`, it is that scene's. Returns the nodes that are
// not finite, in their transform or in what deforms their mesh: what they hold is left out.
std::vector<NodeId> pose_scene(Scene& scene, const Scene* like = nullptr);

// The scene as it stands at a time of an animation, which is clamped to the animation's duration; what the animation
// does not drive stays as in rest, the scene as loaded. Meshes that are not deformed otherwise than in rest, pictures
// and everything else that is large are shared with rest. Instances come in the same order in all poses, unless the
// animation shows or hides nodes. left_out: as pose_scene returns it. like: as pose_scene takes it; null: rest.
std::shared_ptr<const Scene> posed_scene(const std::shared_ptr<const Scene>& rest, uint32_t animation, float time_s,
                                         std::vector<NodeId>* left_out = nullptr, const Scene* like = nullptr);

}  // namespace candela
