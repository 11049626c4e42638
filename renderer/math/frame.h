// SPDX-License-Identifier: MIT
// An orthonormal, right-handed frame whose z axis is a surface normal.
#pragma once

#include "renderer/math/math.h"

namespace candela {

struct OrthonormalFrame {
    Vec3 tangent{1, 0, 0};
    Vec3 bitangent{0, 1, 0};
    Vec3 normal{0, 0, 1};

    // A frame around a unit normal; Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3.
    static OrthonormalFrame from_normal(const Vec3& n) {
        const float sign = std::copysign(1.0f, n.z);
        const float a = -1.0f / (sign + n.z);
        const float b = n.x * n.y * a;
        return {Vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x), Vec3(b, sign + n.y * n.y * a, -n.y), n};
    }

    Vec3 local_from_world(const Vec3& v) const {
        return {glm::dot(v, tangent), glm::dot(v, bitangent), glm::dot(v, normal)};
    }

    Vec3 world_from_local(const Vec3& v) const { return v.x * tangent + v.y * bitangent + v.z * normal; }
};

}  // namespace candela
