// SPDX-License-Identifier: MIT
// Rough interfaces after Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces".
#include "renderer/bsdf/dielectric.h"

#include "renderer/bsdf/albedo_table.h"
#include "renderer/bsdf/fresnel.h"
#include "renderer/bsdf/interface_table.h"
#include "renderer/bsdf/microfacet.h"

namespace candela {

namespace {

// Reflectance at a facet: Fresnel's curve between the material's own f0 and f90, which are those of the real interface
// unless KHR_materials_specular or a thin film changes them. Total reflection stays total.
Vec3 facet_reflectance(const Bsdf& bsdf, float cos_h) {
    const float exact = fresnel_dielectric(cos_h, bsdf.eta);
    if (exact >= 1.0f) return Vec3(1);
    const float f0 = normal_reflectance(bsdf.eta);
    const float weight = std::clamp((exact - f0) / (1.0f - f0), 0.0f, 1.0f);
    return glm::clamp(glm::mix(bsdf.dielectric_f0, Vec3(bsdf.dielectric_f90), weight), 0.0f, 1.0f);
}

// The chance of following the reflection at a facet, a function of the facet alone, so that eval knows it too.
float reflection_probability(const Vec3& reflected, const Vec3& transmitted) {
    const float r = max_component(reflected), t = max_component(transmitted);
    return r + t > 0.0f ? r / (r + t) : 1.0f;
}

struct Facet {
    Vec3 reflected{0}, transmitted{0};
    float p_reflect = 1;
};

Facet split_at_facet(const Bsdf& bsdf, float cos_h) {
    Facet out;
    out.reflected = facet_reflectance(bsdf, cos_h);
    out.transmitted = (1.0f - out.reflected) * bsdf.base_color;
    out.p_reflect = reflection_probability(out.reflected, out.transmitted);
    return out;
}

// Facets bend nothing between media of one index, whatever way they face.
bool is_smooth(const Bsdf& bsdf) {
    constexpr float least_contrast = 1e-3f;
    return bsdf.alpha.x == 0.0f || (!bsdf.thin_walled && std::abs(bsdf.eta - 1.0f) < least_contrast);
}

// The widths of the facets' distribution. A boundary that refracts takes one width for both axes: its energy is
// tabulated for round lobes only.
Vec2 facet_alpha(const Bsdf& bsdf) {
    return bsdf.thin_walled ? bsdf.alpha : Vec2(std::sqrt(bsdf.alpha.x * bsdf.alpha.y));
}

// What single scattering leaves of all light.
float single_scattering_albedo(const Bsdf& bsdf, const Vec3& wo, const Vec2& alpha) {
    return bsdf.thin_walled ? specular_albedo(wo, alpha).total() : interface_albedo(wo.z, alpha.x, bsdf.eta);
}

// -wo bent at a facet by Snell's law; eta is the index beyond over that of wo's side.
Vec3 refract(const Vec3& wo, const Vec3& h, float eta) {
    const float cos_o = glm::dot(wo, h);
    return (cos_o / eta - refracted_cosine(cos_o, eta)) * h - wo / eta;
}

}  // namespace

BsdfEval eval_dielectric(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) noexcept {
    BsdfEval out;
    if (is_smooth(bsdf) || wi.z == 0.0f) return out;
    const bool reflects = wi.z > 0.0f;
    const Vec2 alpha = facet_alpha(bsdf);
    if (reflects || bsdf.thin_walled) {
        // A thin wall sends on what it would reflect, mirrored to the other side.
        const Vec3 mirrored(wi.x, wi.y, std::abs(wi.z));
        const Vec3 h = glm::normalize(wo + mirrored);
        const Facet facet = split_at_facet(bsdf, glm::dot(wo, h));
        const float lobe = ggx_density(h, alpha) * ggx_visibility(wo, mirrored, alpha) * mirrored.z /
                           single_scattering_albedo(bsdf, wo, alpha);
        out.value = (reflects ? facet.reflected : facet.transmitted) * lobe;
        out.pdf = (reflects ? facet.p_reflect : 1.0f - facet.p_reflect) * reflected_visible_normal_pdf(wo, h, alpha);
        return out;
    }

    // The facet that refracts wi into wo, equation 16, and the Jacobian of its normal, equation 17.
    Vec3 h = wo + bsdf.eta * wi;
    const float length = glm::length(h);
    if (!(length > 1e-7f)) return out;
    h = h.z < 0.0f ? -h / length : h / length;
    const float cos_o = glm::dot(wo, h), cos_i = glm::dot(wi, h);
    if (!(cos_o > 0.0f) || !(cos_i < 0.0f)) return out;
    const Facet facet = split_at_facet(bsdf, cos_o);
    const float jacobian = -cos_i / sqr(cos_o + bsdf.eta * cos_i);
    out.value = facet.transmitted * (4.0f * ggx_density(h, alpha) * ggx_visibility(wo, wi, alpha) * -wi.z * cos_o *
                                     jacobian / single_scattering_albedo(bsdf, wo, alpha));
    out.pdf = (1.0f - facet.p_reflect) * visible_normal_density(wo, h, alpha) * cos_o * sqr(bsdf.eta) * jacobian;
    return out;
}

BsdfSample sample_dielectric(const Bsdf& bsdf, const Vec3& wo, float u_branch, const Vec2& u) noexcept {
    BsdfSample out;
    const bool smooth = is_smooth(bsdf);
    const Vec3 h = smooth ? Vec3(0, 0, 1) : sample_visible_normal(wo, facet_alpha(bsdf), u);
    const Facet facet = split_at_facet(bsdf, glm::dot(wo, h));
    const bool reflects = u_branch < facet.p_reflect;
    const Vec3 reflected = 2.0f * glm::dot(wo, h) * h - wo;
    if (reflects) {
        out.wi = reflected;
        if (!(out.wi.z > 0.0f)) return out;
    } else if (bsdf.thin_walled) {
        out.wi = Vec3(reflected.x, reflected.y, -reflected.z);
        if (!(out.wi.z < 0.0f)) return out;
    } else {
        out.wi = refract(wo, h, bsdf.eta);
        out.eta = bsdf.eta;
        if (!(out.wi.z < 0.0f)) return out;
    }

    if (smooth) {
        out.is_delta = true;
        out.is_straight = !reflects && bsdf.thin_walled;
        out.pdf = reflects ? facet.p_reflect : 1.0f - facet.p_reflect;
        out.weight = (reflects ? facet.reflected : facet.transmitted) / out.pdf;
        if (!reflects) out.weight /= sqr(out.eta);
        return out;
    }
    const BsdfEval all = eval_dielectric(bsdf, wo, out.wi);
    if (!(all.pdf > 0.0f) || !std::isfinite(all.pdf)) return out;
    out.pdf = all.pdf;
    out.weight = all.value / all.pdf;
    return out;
}

Vec3 dielectric_transmittance(const Bsdf& bsdf, float cos_theta) noexcept {
    return split_at_facet(bsdf, cos_theta).transmitted;
}

Vec3 dielectric_reflectance(const Bsdf& bsdf, float cos_theta) noexcept {
    return facet_reflectance(bsdf, cos_theta);
}

}  // namespace candela
