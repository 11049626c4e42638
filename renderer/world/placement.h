// SPDX-License-Identifier: MIT
// How an instance's transform is used, and whether it can be.
#pragma once

#include "renderer/world/world.h"

namespace candela {

enum class TransformKind : uint8_t {
    invertible,  // can be an instance of a shared BVH
    flat,        // collapses one axis, or as good as: still a visible sheet, but must be moved to world space
    unusable     // not finite, too far away, or collapses the mesh to a line or a point
};

TransformKind classify_transform(const Mat4& world_from_object);

SurfaceTransform make_surface_transform(const Mat4& world_from_object);

// The positions transformed, with the 16 readable bytes after the last one that the accelerator asks for.
std::vector<Vec3> padded_positions(const std::vector<Vec3>& positions, const Mat4* world_from_object);

}  // namespace candela
