// SPDX-License-Identifier: MIT
// What changes the shape of a primitive: its morph targets, and the joints that its vertices follow.
#pragma once

#include "renderer/io/accessors.h"

namespace tinygltf {
struct Primitive;
}

namespace candela {

// Sets out.deformation where the primitive has morph targets or, for the mesh of a node with a skin, joints. Needs the
// other attributes of out as the file has them, before vertices are dropped. where: the JSON pointer of the primitive.
// Throws LoadError for arrays of the wrong type or length; values that are not finite, and weights that do not sum to
// 1, are mended with a warning.
void load_deformation(LoadContext& context, AccessorReader& accessors, const tinygltf::Primitive& source,
                      const std::string& where, bool skinned, Primitive& out);

}  // namespace candela
