// SPDX-License-Identifier: MIT
// Meshes: each glTF primitive to triangles with vertex data that the renderer may rely on.
#pragma once

#include "renderer/io/accessors.h"

namespace tinygltf {
class Model;
}

namespace candela {

// Fills scene.meshes, as many as the file has; what cannot be shown (points, lines, primitives without positions) is
// left out with a warning. Needs scene.materials. Throws LoadError for indices out of range, attributes of the wrong
// type or length.
void load_meshes(LoadContext& context, const tinygltf::Model& model, AccessorReader& accessors, Scene& scene);

// Tangents for the primitives whose material has a normal texture and that bring none.
void generate_missing_tangents(LoadContext& context, Scene& scene);

}  // namespace candela
