// SPDX-License-Identifier: MIT
// From the node tree to what stands in the world.
#pragma once

#include <vector>

#include "renderer/scene/scene.h"

namespace candela {

// For every node. Nodes of the active scene are placed from its roots on, other ones from the roots of their trees.
std::vector<glm::dmat4> world_from_nodes(const Scene& scene);

// Fills Node::in_active_scene, instances, light_instances and cameras, in the order of the tree, depth first. Meshes
// are those of the nodes, not deformed. Returns the nodes that hold something but whose transform is not finite: what
// they hold is left out.
std::vector<NodeId> place_nodes(Scene& scene, const std::vector<glm::dmat4>& world_from_node);

// translation · rotation · scale.
Mat4 compose_transform(const Vec3& translation, const Quat& rotation, const Vec3& scale);

}  // namespace candela
