// SPDX-License-Identifier: MIT
// Animations of a file, with the targets of KHR_animation_pointer.
#pragma once

#include "renderer/io/accessors.h"
#include "renderer/io/json_document.h"

namespace candela {

// Fills scene.animations and animated_uvs. Needs scene.nodes, meshes, materials, lights and file_cameras. A channel
// that drives nothing known, or whose keys make no sense, is left out with a warning. Throws LoadError for indices out
// of range and arrays of the wrong type.
void load_animations(LoadContext& context, const Json& document, AccessorReader& accessors, Scene& scene);

}  // namespace candela
