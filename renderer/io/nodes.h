// SPDX-License-Identifier: MIT
// The node tree, and the active scene flattened: mesh instances, lights and cameras in world space.
#pragma once

#include "renderer/io/load_context.h"

namespace tinygltf {
class Model;
}

namespace candela {

// Fills scene.nodes, scene_names, active_scene, instances, light_instances, lights and cameras. Needs scene.meshes.
// Nodes with two parents and cycles throw LoadError.
void load_nodes(LoadContext& context, const tinygltf::Model& model, Scene& scene);

}  // namespace candela
