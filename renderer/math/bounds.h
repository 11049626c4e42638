// SPDX-License-Identifier: MIT
// Axis-aligned boxes.
#pragma once

#include "renderer/math/math.h"

namespace candela {

struct Bounds3 {
    Vec3 lower{infinity};
    Vec3 upper{-infinity};

    bool empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
    void extend(const Vec3& p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    void extend(const Bounds3& b) {
        lower = glm::min(lower, b.lower);
        upper = glm::max(upper, b.upper);
    }
    Vec3 center() const { return empty() ? Vec3(0) : 0.5f * lower + 0.5f * upper; }
    Vec3 extent() const { return empty() ? Vec3(0) : upper - lower; }
    // Radius of the sphere around the box.
    float radius() const { return 0.5f * glm::length(extent()); }
};

}  // namespace candela
