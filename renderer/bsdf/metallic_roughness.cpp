// SPDX-License-Identifier: MIT
// glTF 2.0's metallic-roughness material (specification, appendix B): a metal and a dielectric-coated diffuse, blended
// by `metallic`. Multiple scattering between facets is put back by scaling (Turquin 2019); the diffuse gets what the
// coat leaves, reciprocally: (1 − E(wo)) (1 − E(wi)) / (π (1 − mean E)) (Kelemen and Szirmay-Kalos 2001).
#include "renderer/bsdf/albedo_table.h"
#include "renderer/bsdf/bsdf.h"
#include "renderer/bsdf/microfacet.h"
#include "renderer/sampling/warp.h"

namespace candela {

namespace {

// Albedo of a compensated lobe: E·(1 + f0·(1/E₁ − 1)).
Vec3 compensated_albedo(const SpecularAlbedo& e, const Vec3& f0, const Vec3& f90) {
    return (f0 * e.scale + f90 * e.bias) * (1.0f + f0 * (1.0f / e.total() - 1.0f));
}

Vec3 coat_albedo(const Bsdf& bsdf, float cos_theta) {
    return compensated_albedo(specular_albedo(cos_theta, bsdf.alpha), bsdf.dielectric_f0, Vec3(bsdf.dielectric_f90));
}

// The cosine-weighted mean of coat_albedo, from the means of the terms of its expansion in f0 and f90.
Vec3 mean_coat_albedo(const Bsdf& bsdf) {
    const MeanSpecularAlbedo mean = mean_specular_albedo(bsdf.alpha);
    const Vec3& f0 = bsdf.dielectric_f0;
    const float f90 = bsdf.dielectric_f90;
    return (1.0f - f0) * (f0 * mean.single.scale + f90 * mean.single.bias) +
           f0 * (f0 * mean.compensated.scale + f90 * mean.compensated.bias);
}

// What all evaluations for one wo share.
struct Lobes {
    Vec3 coat{0};           // albedo of the dielectric's coat seen from wo
    Vec3 diffuse{0};        // albedo of the diffuse under it, metallic blend included
    Vec3 specular{0};       // albedo of both specular lobes together
    float energy = 1;       // single-scattering albedo of a perfect mirror of this roughness
    float probability = 0;  // of choosing the specular lobes
};

Lobes make_lobes(const Bsdf& bsdf, const Vec3& wo) {
    Lobes out;
    const SpecularAlbedo e = specular_albedo(wo.z, bsdf.alpha);
    out.energy = e.total();
    out.coat = compensated_albedo(e, bsdf.dielectric_f0, Vec3(bsdf.dielectric_f90));
    out.diffuse = (1.0f - bsdf.metallic) * bsdf.base_color * (1.0f - out.coat);
    out.specular = (1.0f - bsdf.metallic) * out.coat + bsdf.metallic * compensated_albedo(e, bsdf.base_color, Vec3(1));
    // Both keep a chance where they are not black: the exact share matters little, a missing lobe would be a bias.
    const float s = max_component(out.specular);
    const float d = max_component(out.diffuse);
    if (s > 0.0f) out.probability = d > 0.0f ? std::clamp(s / (s + d), 0.05f, 0.95f) : 1.0f;
    return out;
}

BsdfEval eval_lobes(const Bsdf& bsdf, const Lobes& lobes, const Vec3& wo, const Vec3& wi) {
    BsdfEval out;
    if (!(wi.z > 0.0f)) return out;
    if (lobes.probability < 1.0f) {
        const Vec3 share = (1.0f - coat_albedo(bsdf, wi.z)) / glm::max(1.0f - mean_coat_albedo(bsdf), Vec3(1e-4f));
        out.value = lobes.diffuse * share * (inv_pi * wi.z);
        out.pdf = (1.0f - lobes.probability) * cosine_hemisphere_pdf(wi.z);
    }
    if (lobes.probability > 0.0f) {
        const Vec3 h = glm::normalize(wo + wi);
        const float schlick = schlick_weight(glm::dot(wo, h));
        const Vec3 lost(1.0f / lobes.energy - 1.0f);
        const Vec3 dielectric =
            glm::mix(bsdf.dielectric_f0, Vec3(bsdf.dielectric_f90), schlick) * (1.0f + bsdf.dielectric_f0 * lost);
        const Vec3 metal = glm::mix(bsdf.base_color, Vec3(1), schlick) * (1.0f + bsdf.base_color * lost);
        out.value += glm::mix(dielectric, metal, bsdf.metallic) *
                     (ggx_density(h, bsdf.alpha) * ggx_visibility(wo.z, wi.z, bsdf.alpha) * wi.z);
        out.pdf += lobes.probability * reflected_visible_normal_pdf(wo, h, bsdf.alpha);
    }
    return out;
}

}  // namespace

Bsdf make_bsdf(const Vec3& base_color, float metallic, float perceptual_roughness, float ior, float specular_factor,
               const Vec3& specular_color) {
    // KHR_materials_ior and KHR_materials_specular, "Implementation". An ior of 0 means full reflection.
    const float r = ior == 0.0f ? 1.0f : (ior - 1.0f) / (ior + 1.0f);
    Bsdf out;
    out.base_color = base_color;
    out.metallic = std::clamp(metallic, 0.0f, 1.0f);
    out.dielectric_f0 = glm::min(r * r * specular_color, Vec3(1)) * specular_factor;
    out.dielectric_f90 = specular_factor;
    out.alpha = std::clamp(sqr(perceptual_roughness), min_ggx_alpha, 1.0f);
    return out;
}

BsdfSample sample(const Bsdf& bsdf, const Vec3& wo, float u_lobe, const Vec2& u) noexcept {
    BsdfSample out;
    if (!(wo.z > 0.0f)) return out;
    const Lobes lobes = make_lobes(bsdf, wo);
    if (u_lobe < lobes.probability) {
        const Vec3 h = sample_visible_normal(wo, bsdf.alpha, u);
        out.wi = 2.0f * glm::dot(wo, h) * h - wo;
    } else {
        out.wi = sample_cosine_hemisphere(u);
    }
    const BsdfEval all = eval_lobes(bsdf, lobes, wo, out.wi);
    if (!(all.pdf > 0.0f) || !std::isfinite(all.pdf)) return out;
    out.pdf = all.pdf;
    out.weight = all.value / all.pdf;
    return out;
}

BsdfEval eval(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) noexcept {
    if (!(wo.z > 0.0f)) return {};
    return eval_lobes(bsdf, make_lobes(bsdf, wo), wo, wi);
}

Vec3 albedo(const Bsdf& bsdf, const Vec3& wo) noexcept {
    if (!(wo.z > 0.0f)) return Vec3(0);
    const Lobes lobes = make_lobes(bsdf, wo);
    return lobes.diffuse + lobes.specular;
}

}  // namespace candela
