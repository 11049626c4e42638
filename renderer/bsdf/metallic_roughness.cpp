// SPDX-License-Identifier: MIT
// Multiple scattering between facets is put back by scaling (Turquin 2019); the diffuse gets what the specular above it
// leaves, reciprocally: (1 − E(wo)) (1 − E(wi)) / (π (1 − mean E)) (Kelemen and Szirmay-Kalos 2001).
#include "renderer/bsdf/metallic_roughness.h"

#include "renderer/bsdf/albedo_table.h"
#include "renderer/bsdf/fresnel.h"
#include "renderer/bsdf/microfacet.h"

namespace candela {

namespace {

// Albedo of a compensated lobe: E·(1 + f0·(1/E₁ − 1)).
Vec3 compensated_albedo(const SpecularAlbedo& e, const Vec3& f0, const Vec3& f90) {
    return (f0 * e.scale + f90 * e.bias) * (1.0f + f0 * (1.0f / e.total() - 1.0f));
}

// One width stands for both in what the diffuse gets: its two factors only have to fit each other.
float mean_alpha(const Bsdf& bsdf) {
    return bsdf.alpha.x == bsdf.alpha.y ? bsdf.alpha.x : std::sqrt(bsdf.alpha.x * bsdf.alpha.y);
}

// Nothing but diffuse, as KHR_materials_specular with factor 0 has it.
bool is_lambert(const Bsdf& bsdf) {
    return bsdf.dielectric_f90 == 0.0f && bsdf.metallic == 0.0f && bsdf.transmission == 0.0f &&
           is_black(bsdf.dielectric_f0);
}

Vec3 dielectric_albedo(const Bsdf& bsdf, float cos_theta) {
    return compensated_albedo(specular_albedo(cos_theta, mean_alpha(bsdf)), bsdf.dielectric_f0,
                              Vec3(bsdf.dielectric_f90));
}

// The cosine-weighted mean of dielectric_albedo, from the means of the terms of its expansion in f0 and f90.
Vec3 mean_dielectric_albedo(const Bsdf& bsdf) {
    const MeanSpecularAlbedo mean = mean_specular_albedo(mean_alpha(bsdf));
    const Vec3& f0 = bsdf.dielectric_f0;
    const float f90 = bsdf.dielectric_f90;
    return (1.0f - f0) * (f0 * mean.single.scale + f90 * mean.single.bias) +
           f0 * (f0 * mean.compensated.scale + f90 * mean.compensated.bias);
}

}  // namespace

OpaqueLobes make_opaque_lobes(const Bsdf& bsdf, const Vec3& wo) noexcept {
    OpaqueLobes out;
    if (is_lambert(bsdf)) {
        out.diffuse = (1.0f - bsdf.diffuse_transmission) * bsdf.base_color;
        out.transmitted = bsdf.diffuse_transmission * bsdf.diffuse_transmission_color;
        return out;
    }
    const SpecularAlbedo e = specular_albedo(wo, bsdf.alpha);
    out.energy = e.total();
    out.metal = bsdf.metallic;
    out.dielectric = (1.0f - bsdf.metallic) * (1.0f - bsdf.transmission);
    const Vec3 dielectric = compensated_albedo(e, bsdf.dielectric_f0, Vec3(bsdf.dielectric_f90));
    out.specular = out.dielectric * dielectric + out.metal * compensated_albedo(e, bsdf.metal_f0, Vec3(1));
    const Vec3 below = out.dielectric * (1.0f - dielectric);
    out.diffuse = (1.0f - bsdf.diffuse_transmission) * below * bsdf.base_color;
    out.transmitted = bsdf.diffuse_transmission * below * bsdf.diffuse_transmission_color;
    return out;
}

Vec3 eval_specular(const Bsdf& bsdf, const OpaqueLobes& lobes, const Vec3& wo, const Vec3& wi) noexcept {
    const Vec3 h = glm::normalize(wo + wi);
    const float schlick = schlick_weight(glm::dot(wo, h));
    const Vec3 lost(1.0f / lobes.energy - 1.0f);
    const Vec3 dielectric =
        glm::mix(bsdf.dielectric_f0, Vec3(bsdf.dielectric_f90), schlick) * (1.0f + bsdf.dielectric_f0 * lost);
    const Vec3 metal = glm::mix(bsdf.metal_f0, Vec3(1), schlick) * (1.0f + bsdf.metal_f0 * lost);
    return (lobes.dielectric * dielectric + lobes.metal * metal) *
           (ggx_density(h, bsdf.alpha) * ggx_visibility(wo, wi, bsdf.alpha) * wi.z);
}

float specular_pdf(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) noexcept {
    return reflected_visible_normal_pdf(wo, glm::normalize(wo + wi), bsdf.alpha);
}

Vec3 sample_specular(const Bsdf& bsdf, const Vec3& wo, const Vec2& u) noexcept {
    if (bsdf.alpha.x == 0.0f) return {-wo.x, -wo.y, wo.z};
    const Vec3 h = sample_visible_normal(wo, bsdf.alpha, u);
    return 2.0f * glm::dot(wo, h) * h - wo;
}

Vec3 eval_diffuse(const Bsdf& bsdf, const OpaqueLobes& lobes, const Vec3& wi) noexcept {
    if (wi.z <= 0.0f) return lobes.transmitted * (inv_pi * -wi.z);
    if (is_lambert(bsdf)) return lobes.diffuse * (inv_pi * wi.z);
    const Vec3 share =
        (1.0f - dielectric_albedo(bsdf, wi.z)) / glm::max(1.0f - mean_dielectric_albedo(bsdf), Vec3(1e-4f));
    return lobes.diffuse * share * (inv_pi * wi.z);
}

}  // namespace candela
