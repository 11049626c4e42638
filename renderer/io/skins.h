// SPDX-License-Identifier: MIT
// Skins, and the morph weights that nodes and meshes begin with.
#pragma once

#include "renderer/io/accessors.h"
#include "renderer/io/json_document.h"

namespace tinygltf {
class Model;
}

namespace candela {

// Fills scene.skins. Needs scene.nodes. Throws LoadError where there are fewer inverse bind matrices than joints, or
// ones that are not finite.
void load_skins(LoadContext& context, const Json& document, AccessorReader& accessors, Scene& scene);

// Gives every node the weights of its mesh's morph targets, and takes skins from nodes without a mesh. Needs
// scene.meshes and skins. Throws LoadError where a mesh uses a joint that the node's skin has not.
void connect_deformations(LoadContext& context, const tinygltf::Model& model, Scene& scene);

// Books the memory of one deformed copy of each mesh that a pose deforms.
void charge_posed_meshes(LoadContext& context, const Scene& scene);

}  // namespace candela
