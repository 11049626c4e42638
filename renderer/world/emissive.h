// SPDX-License-Identifier: MIT
// The emissive triangles of a world, gathered for the light sampler.
#pragma once

#include "renderer/world/world.h"

namespace candela {

// Appends one EmissiveTriangle for every triangle of the surface, in order, and sets surface.first_emissive.
// edge1 × edge2 points to the front; where the transform flips, edge1 leads to the third vertex and edge2 to the
// second.
void append_emissive_triangles(const World& world, uint32_t surface_index, Surface& surface,
                               std::vector<EmissiveTriangle>& out);

}  // namespace candela
