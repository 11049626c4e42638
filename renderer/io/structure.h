// SPDX-License-Identifier: MIT
// The structure of a document (scenes, nodes, meshes, materials, textures, cameras, lights) as tinygltf reads it.
#pragma once

#include "renderer/io/json_document.h"

namespace tinygltf {
class Model;
}

namespace candela {

// Hands tinygltf a copy of the validated document without bytes: buffers, views and images are left out and accessors
// replaced by dummies of the same number, for it would follow their offsets and files unchecked. Indices into meshes,
// accessors, textures and so on mean the same as in the document. Throws LoadError.
void read_structure(LoadContext& context, const Json& document, tinygltf::Model& model);

}  // namespace candela
