// SPDX-License-Identifier: MIT
// The emissive triangles of a world, gathered for the light sampler.
#pragma once

#include "renderer/world/world.h"

namespace candela {

// Appends EmissiveCells for every triangle of the surface, in order, and their EmissiveTriangles; sets
// surface.first_emissive. Triangles whose texture shines unevenly are cut into cells of half a texel, at most 32² for
// a triangle and as many as keep the list below about a million. edge1 × edge2 points to the front; where the transform
// flips, edge1 leads to the third vertex and edge2 to the second.
void append_emissive_triangles(const World& world, uint32_t surface_index, Surface& surface, Lights& out);

// The same, to the bit, from those of another pose, if there the surface shines alike: only moves them, without looking
// at textures again. False: nothing was done.
bool move_emissive_triangles(const World& before, const World& world, uint32_t surface_index, Surface& surface,
                             Lights& out);

}  // namespace candela
