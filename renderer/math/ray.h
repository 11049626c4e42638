// SPDX-License-Identifier: MIT
// A ray in world space and the offset that keeps it off the surface it leaves.
#pragma once

#include "renderer/math/math.h"

namespace candela {

// Points on it are origin + t * direction with t in [0, t_max]; direction is a unit vector.
struct Ray {
    Vec3 origin{0};
    Vec3 direction{0, 0, 1};
    float t_max = infinity;
};

// How wide the bundle of rays is that a ray stands for: width_m at its origin, growing by spread_radians per metre.
// Footprints need no more (Akenine-Möller et al. 2021, "Improved Shader and Texture Level of Detail Using Ray Cones");
// the curvature of mirrors is left out.
struct RayCone {
    float width_m = 0;
    float spread_radians = 0;

    float width_at(float distance_m) const { return width_m + spread_radians * distance_m; }
};

// Moves a surface point p by at least `distance_m` to the side its geometric unit normal n points to. The distance must
// bound the errors of p and of the intersector along n; rounding the sum goes away from the surface (Pharr et al. 2023,
// "Physically Based Rendering", section 6.8.6).
inline Vec3 offset_ray_origin(const Vec3& p, const Vec3& n, float distance_m) {
    const Vec3 moved = p + distance_m * n;
    // A spacing of the numbers there is at most this; it costs less than asking for the neighbouring number.
    constexpr float spacing = 0x1p-23f;
    return moved + spacing * glm::abs(moved) * glm::sign(n);
}

// From one point to just before another. Both are moved off their surfaces, but a surface whose coordinates are zero
// has no error of its own: what is left is the rounding of the length.
inline Ray segment_between(const Vec3& from, const Vec3& to) {
    const Vec3 segment = to - from;
    const float length = glm::length(segment);
    Ray ray;
    ray.origin = from;
    if (length > 0.0f) ray.direction = segment / length;
    ray.t_max = length * (1.0f - 0x1p-20f);
    return ray;
}

// A bound of those errors on a triangle: rounding in the interpolation and in the intersector is relative to the size
// of the coordinates and edges that they add up (section 6.8.5 there), each along its axis. Cancellation makes the
// constant larger than the handful of operations suggests.
inline float surface_error_m(const Vec3& magnitudes, const Vec3& n) {
    constexpr float relative_error = 0x1p-20f;
    return relative_error * glm::dot(magnitudes, glm::abs(n));
}

}  // namespace candela
