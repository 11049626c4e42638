// SPDX-License-Identifier: MIT
// What stands in for a scene whose pictures are still being decoded.
#pragma once

#include "renderer/scene/scene.h"

namespace candela {

// The scene with the factors of its materials alone, and the same geometry, opacity of factors and bodies, so that what
// is built for it serves for the scene with pictures too. A texture reads as white; where white would be as good as
// wrong (normals, metal, lamps that are black but for a spot) the factor is what most pictures amount to.
Scene without_pictures(const Scene& scene);

}  // namespace candela
