// SPDX-License-Identifier: MIT
#include "renderer/bsdf/interface_integral.h"

#include <algorithm>
#include <cmath>

#include "renderer/bsdf/fresnel.h"
#include "renderer/bsdf/microfacet.h"

namespace candela {

namespace {

// The axis of indices runs from 1/3 to 3 in equal steps of (eta − 1)/(eta + 1), with 1 in the middle.
float index_at(float t) {
    return (1.0f + (t - 0.5f)) / (1.0f - (t - 0.5f));
}

// Over visible normals, whose weight is G2/G1, with a Hammersley point set; both branches of each facet are followed.
float integrate(float cos_theta, float alpha_scalar, float eta) {
    constexpr uint32_t count = 256;
    const Vec2 alpha(alpha_scalar);
    const Vec3 wo(safe_sqrt(1.0f - cos_theta * cos_theta), 0.0f, cos_theta);
    const float over_g1 = 2.0f * (wo.z + ggx_root(wo, alpha));
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t bits = 0;
        for (uint32_t b = 0; b < 8; ++b)
            bits |= ((i >> b) & 1u) << (7 - b);
        const Vec2 u((static_cast<float>(i) + 0.5f) / count, (static_cast<float>(bits) + 0.5f) / count);
        const Vec3 h = sample_visible_normal(wo, alpha, u);
        const float cos_h = glm::dot(wo, h);
        const float reflectance = fresnel_dielectric(cos_h, eta);
        const Vec3 reflected = 2.0f * cos_h * h - wo;
        if (reflected.z > 0.0f) {
            sum += static_cast<double>(reflectance * over_g1 * reflected.z * ggx_visibility(wo, reflected, alpha));
        }
        const Vec3 refracted = (cos_h / eta - refracted_cosine(cos_h, eta)) * h - wo / eta;
        if (reflectance < 1.0f && refracted.z < 0.0f) {
            sum += static_cast<double>((1.0f - reflectance) * over_g1 * -refracted.z *
                                       ggx_visibility(wo, refracted, alpha));
        }
    }
    return static_cast<float>(sum / count);
}

}  // namespace

InterfaceTable InterfaceTable::integrated() {
    InterfaceTable out{};
    for (int z = 0; z < indices; ++z) {
        for (int y = 0; y < alphas; ++y) {
            for (int x = 0; x < cosines; ++x) {
                const float cosine = std::max(sqr(static_cast<float>(x) / (cosines - 1)), 1e-4f);
                const float alpha = std::max(sqr(static_cast<float>(y) / (alphas - 1)), 1e-3f);
                out.albedo[at(static_cast<size_t>(x), static_cast<size_t>(y), static_cast<size_t>(z))] =
                    integrate(cosine, alpha, index_at(static_cast<float>(z) / (indices - 1)));
            }
        }
    }
    return out;
}

}  // namespace candela
