// SPDX-License-Identifier: MIT
// Maps from the unit square to shapes and directions, each with its pdf beside it. u is uniform in [0,1)².
#pragma once

#include "renderer/math/math.h"

namespace candela {

// Unit disc, pdf per area = 1/π. Concentric map (Shirley and Chiu 1997).
Vec2 sample_disc(const Vec2& u) noexcept;
inline float disc_pdf() {
    return inv_pi;
}

// Upper hemisphere ∝ cosθ; pdf per solid angle.
Vec3 sample_cosine_hemisphere(const Vec2& u) noexcept;
inline float cosine_hemisphere_pdf(float cos_theta) {
    return std::max(cos_theta, 0.0f) * inv_pi;
}

// Whole sphere, uniform.
Vec3 sample_sphere(const Vec2& u) noexcept;
inline float sphere_pdf() {
    return 0.25f * inv_pi;
}

// Triangle, uniform by area: barycentrics (u, v) of the second and third vertex. pdf per area = 1 / area.
Vec2 sample_triangle(const Vec2& u) noexcept;

// Offset from the pixel centre in pixels, ∝ the Blackman-Harris window of the given radius (pixels), per axis; so that
// every sample weighs 1 (filter importance sampling, Ernst et al. 2006).
Vec2 sample_blackman_harris(const Vec2& u, float radius) noexcept;
float blackman_harris_pdf(const Vec2& offset, float radius) noexcept;

}  // namespace candela
