// SPDX-License-Identifier: MIT
// Meshes: each glTF primitive to triangles with vertex data that the renderer may rely on.
#pragma once

#include "renderer/io/accessors.h"

namespace tinygltf {
class Model;
}

namespace candela {

// The file's meshes, as many as it has; what cannot be shown (primitives without positions) is left out with a warning.
// Points and lines need give_strokes_bodies afterwards. Needs scene.materials and nodes. Throws LoadError for indices
// out of range, attributes of the wrong type or length.
std::vector<Mesh> load_meshes(LoadContext& context, const tinygltf::Model& model, AccessorReader& accessors,
                              const Scene& scene);

// Tangents for the primitives whose material has a normal texture and that bring none.
void generate_missing_tangents(LoadContext& context, const Scene& scene, std::vector<Mesh>& meshes);

}  // namespace candela
