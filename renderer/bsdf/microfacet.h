// SPDX-License-Identifier: MIT
// The GGX (Trowbridge-Reitz) microfacet distribution with height-correlated Smith masking.
// All directions in the local frame, pointing away from the surface; alpha are the GGX widths along x and y, > 0.
#pragma once

#include "renderer/math/math.h"

namespace candela {

// Density of facet normals h (unit, z > 0) per solid angle and projected area; Heitz 2014, equation 86. Written with
// the sine of h, which keeps its precision where h is close to the normal.
inline float ggx_density(const Vec3& h, const Vec2& alpha) {
    const float product = alpha.x * alpha.y;
    const float t = h.x * h.x * (alpha.y / alpha.x) + h.y * h.y * (alpha.x / alpha.y) + product * h.z * h.z;
    return product * inv_pi / (t * t);
}

// |w.z|·(1 + 2Λ(w)), the root in Smith's function; Heitz 2014, equation 72.
inline float ggx_root(const Vec3& w, const Vec2& alpha) {
    return std::sqrt(sqr(alpha.x * w.x) + sqr(alpha.y * w.y) + w.z * w.z);
}

// G2 / (4 |wo.z| |wi.z|), for directions on either side; Heitz 2014, equation 99, and Lagarde and de Rousiers 2014,
// listing 2.
inline float ggx_visibility(const Vec3& wo, const Vec3& wi, const Vec2& alpha) {
    return 0.5f / (std::abs(wi.z) * ggx_root(wo, alpha) + std::abs(wo.z) * ggx_root(wi, alpha));
}

// A facet normal among those visible from wo, by the cap of a sphere (Dupuy and Benyoub 2023, listing 3).
inline Vec3 sample_visible_normal(const Vec3& wo, const Vec2& alpha, const Vec2& u) {
    const Vec3 stretched = glm::normalize(Vec3(alpha.x * wo.x, alpha.y * wo.y, wo.z));
    const float phi = 2.0f * pi * u.x;
    const float z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
    const float radius = safe_sqrt(1.0f - z * z);
    const Vec3 h = Vec3(radius * std::cos(phi), radius * std::sin(phi), z) + stretched;
    return glm::normalize(Vec3(alpha.x * h.x, alpha.y * h.y, std::max(h.z, 1e-12f)));
}

// pdf of h from sample_visible_normal per solid angle of h, over wo·h: G1 D / wo.z.
inline float visible_normal_density(const Vec3& wo, const Vec3& h, const Vec2& alpha) {
    return 2.0f * ggx_density(h, alpha) / (wo.z + ggx_root(wo, alpha));
}

// pdf per solid angle of wi = reflect(wo, h) when h comes from sample_visible_normal: G1 D / (4 wo.z).
inline float reflected_visible_normal_pdf(const Vec3& wo, const Vec3& h, const Vec2& alpha) {
    return 0.25f * visible_normal_density(wo, h, alpha);
}

}  // namespace candela
