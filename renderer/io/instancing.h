// SPDX-License-Identifier: MIT
// EXT_mesh_gpu_instancing: the transforms by which one node places its mesh many times.
#pragma once

#include "renderer/io/accessors.h"

namespace tinygltf {
class Model;
}

namespace candela {

// Fills node_from_instance of the nodes that have the extension. Attributes other than TRANSLATION, ROTATION and SCALE
// are the application's own and are not read. Throws LoadError for attributes of the wrong type or of different counts.
void load_instancing(LoadContext& context, const tinygltf::Model& model, AccessorReader& accessors, Scene& scene);

}  // namespace candela
