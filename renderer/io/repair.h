// SPDX-License-Identifier: MIT
// Vertex data as the renderer may rely on: finite, unit where it says unit. Each function returns how much it mended.
#pragma once

#include "renderer/scene/scene.h"

namespace candela {

// Vertex i becomes what vertex kept[i] was, with all that it carries. Triangles are left alone.
void gather_vertices(Primitive& primitive, const std::vector<uint32_t>& kept);

// Bytes of all per-vertex arrays.
uint64_t vertex_bytes(const Primitive& primitive);

// Keeps only the vertices that triangles use, in their order; returns how many went.
size_t drop_unused_vertices(Primitive& primitive);

// Triangles with a corner that is not finite, or too far away for single precision to square, go; their vertices are
// put at the origin. Returns the number of triangles.
size_t drop_unplaceable_triangles(Primitive& primitive);

// Unit normals; where there is none, the mean of the adjoining triangles' normals, weighted by area.
size_t repair_normals(Primitive& primitive);

// Unit tangents with w = ±1; where there is none, any direction perpendicular to the normal.
size_t repair_tangents(Primitive& primitive);

// Texture coordinates that are not finite become 0, colours 1 and negative colours 0.
size_t repair_uv_and_colors(Primitive& primitive);

}  // namespace candela
