// SPDX-License-Identifier: MIT
#include "renderer/world/placement.h"

namespace candela {

namespace {

// The cofactor matrix maps cross products: cof(M)(a × b) = Ma × Mb. It is det(M) times the inverse transpose and exists
// for singular M too.
glm::dmat3 cofactor(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

double max_abs(const glm::dmat3& m) {
    double largest = 0;
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r)
            largest = std::max(largest, std::abs(m[c][r]));
    }
    return largest;
}

}  // namespace

TransformKind classify_transform(const Mat4& world_from_object) {
    // The accelerator knows no coordinates beyond about 1e18.
    constexpr float farthest_m = 1e18f;
    for (int c = 0; c < 4; ++c) {
        const Vec3 column = glm::abs(Vec3(world_from_object[c]));
        if (!(column.x < farthest_m && column.y < farthest_m && column.z < farthest_m)) return TransformKind::unusable;
    }
    const glm::dmat3 linear(world_from_object);
    const double scale = max_abs(linear);
    constexpr double smallest_relative_determinant = 1e-7;
    if (!(max_abs(cofactor(linear)) > 1e-12 * scale * scale)) return TransformKind::unusable;
    const double relative_determinant = std::abs(glm::determinant(linear)) / (scale * scale * scale);
    const bool is_invertible =
        relative_determinant >= smallest_relative_determinant && can_be_instanced(world_from_object);
    return is_invertible ? TransformKind::invertible : TransformKind::flat;
}

SurfaceTransform make_surface_transform(const Mat4& world_from_object) {
    const glm::dmat3 linear(world_from_object);
    const glm::dmat3 normals = cofactor(linear);
    SurfaceTransform out;
    out.world_from_object = glm::mat4x3(Vec3(world_from_object[0]), Vec3(world_from_object[1]),
                                        Vec3(world_from_object[2]), Vec3(world_from_object[3]));
    out.flips = glm::determinant(linear) < 0.0;
    const double scale = (out.flips ? -1.0 : 1.0) / std::max(max_abs(normals), 1e-300);
    out.world_from_normal = Mat3(normals * scale);
    return out;
}

std::vector<Vec3> padded_positions(const std::vector<Vec3>& positions, const Mat4* world_from_object) {
    std::vector<Vec3> out;
    out.reserve(positions.size() + position_padding);
    if (world_from_object == nullptr) {
        out.assign(positions.begin(), positions.end());
    } else {
        const Mat4& m = *world_from_object;
        for (const Vec3& p : positions)
            out.emplace_back(m * Vec4(p, 1.0f));
    }
    // Two more vertices than anyone indexes: 24 readable bytes.
    out.insert(out.end(), position_padding, Vec3(0));
    return out;
}

}  // namespace candela
