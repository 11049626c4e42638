// SPDX-License-Identifier: MIT
// Tangent frames for normal maps, where the file brings none: MikkTSpace's convention, which glTF prescribes.
#pragma once

#include <cstdint>

#include "renderer/scene/scene.h"

namespace candela {

// Fills primitive.tangents (unit xyz perpendicular to the normal, w = ±1: bitangent = w · cross(normal, tangent)) from
// positions, normals and uv[uv_set]. Corners of one vertex whose frames differ are split: vertices may be appended to
// every per-vertex array and triangles rewritten; the order and the number of triangles stay.
// With flat_normals set, the geometric normal of each triangle is used and stays implicit (normals stays empty).
// Morph targets get the differences to the tangents of the mesh that they make at weight 1 (glTF 2.0, section 3.7.2.2).
// Needs uv[uv_set] as long as positions and triangles in range; throws nothing but std::bad_alloc. Degenerate
// triangles and collapsed uv still get a unit frame perpendicular to the normal.
void generate_tangents(Primitive& primitive, uint32_t uv_set);

}  // namespace candela
