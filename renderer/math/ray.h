// SPDX-License-Identifier: MIT
// A ray in world space and the offset that keeps it off the surface it leaves.
#pragma once

#include <bit>

#include "renderer/math/math.h"

namespace candela {

// Points on it are origin + t * direction with t in [0, t_max]; direction is a unit vector.
struct Ray {
    Vec3 origin{0};
    Vec3 direction{0, 0, 1};
    float t_max = infinity;
};

// Moves a surface point p to the side its geometric unit normal n points to, far enough that a ray from there does not
// hit the same surface again: by ulps away from the origin, by a fixed step near it.
// Wächter and Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems chapter 6.
inline Vec3 offset_ray_origin(const Vec3& p, const Vec3& n) {
    constexpr float near_origin = 1.0f / 32.0f;
    constexpr float float_scale = 1.0f / 65536.0f;
    constexpr float int_scale = 256.0f;
    Vec3 out;
    for (int i = 0; i < 3; ++i) {
        const auto ulps = static_cast<int32_t>(int_scale * n[i]);
        const auto bits = std::bit_cast<int32_t>(p[i]) + (p[i] < 0.0f ? -ulps : ulps);
        out[i] = std::abs(p[i]) < near_origin ? p[i] + float_scale * n[i] : std::bit_cast<float>(bits);
    }
    return out;
}

}  // namespace candela
