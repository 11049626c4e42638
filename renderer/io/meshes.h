// SPDX-License-Identifier: MIT
// Triangles and vertex data of a file's meshes.
#pragma once

#include "renderer/io/accessors.h"

namespace tinygltf {
class Model;
}

namespace candela {

// Fills scene.meshes, one per mesh of the file. Points and lines, and primitives without positions, are left out with a
// warning. Needs scene.materials. Vertex indices out of range and attributes of different lengths throw LoadError.
void load_meshes(LoadContext& context, const tinygltf::Model& model, AccessorReader& accessors, Scene& scene);

}  // namespace candela
