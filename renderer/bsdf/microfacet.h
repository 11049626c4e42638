// SPDX-License-Identifier: MIT
// The GGX (Trowbridge-Reitz) microfacet distribution with height-correlated Smith masking, isotropic.
// All directions in the local frame, pointing away from the surface, z > 0; alpha is the GGX width.
#pragma once

#include "renderer/math/math.h"

namespace candela {

// Density of facet normals h (unit, z > 0) per solid angle and projected area; Walter et al. 2007, equation 33. Written
// with the sine of h, which keeps its precision where h is close to the normal.
inline float ggx_density(const Vec3& h, float alpha) {
    const float alpha2 = alpha * alpha;
    const float t = h.x * h.x + h.y * h.y + alpha2 * h.z * h.z;
    return alpha2 * inv_pi / (t * t);
}

// sqrt(α² + (1 − α²) cos²θ), the root in Smith's function, as cosθ·(1 + 2Λ).
inline float ggx_root(float cos_theta, float alpha) {
    const float alpha2 = alpha * alpha;
    return std::sqrt(alpha2 + (1.0f - alpha2) * cos_theta * cos_theta);
}

// G2 / (4 |wo.z| |wi.z|); Heitz 2014, equation 99, and Lagarde and de Rousiers 2014, listing 2.
inline float ggx_visibility(float cos_o, float cos_i, float alpha) {
    return 0.5f / (cos_i * ggx_root(cos_o, alpha) + cos_o * ggx_root(cos_i, alpha));
}

// A facet normal among those visible from wo, by the cap of a sphere (Dupuy and Benyoub 2023, listing 3).
inline Vec3 sample_visible_normal(const Vec3& wo, float alpha, const Vec2& u) {
    const Vec3 stretched = glm::normalize(Vec3(alpha * wo.x, alpha * wo.y, wo.z));
    const float phi = 2.0f * pi * u.x;
    const float z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
    const float radius = safe_sqrt(1.0f - z * z);
    const Vec3 h = Vec3(radius * std::cos(phi), radius * std::sin(phi), z) + stretched;
    return glm::normalize(Vec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-12f)));
}

// pdf per solid angle of wi = reflect(wo, h) when h comes from sample_visible_normal: G1 D / (4 wo.z).
inline float reflected_visible_normal_pdf(const Vec3& wo, const Vec3& h, float alpha) {
    return ggx_density(h, alpha) / (2.0f * (wo.z + ggx_root(wo.z, alpha)));
}

// Schlick's weight of f90 in F = f0·(1 − w) + f90·w; Schlick 1994, equation 15.
inline float schlick_weight(float cos_theta) {
    const float m = std::clamp(1.0f - cos_theta, 0.0f, 1.0f);
    const float m2 = m * m;
    return m2 * m2 * m;
}

}  // namespace candela
