// SPDX-License-Identifier: MIT
// The stack of layers: which lobe to draw from, and what all lobes give together.
#include "renderer/bsdf/bsdf.h"

#include "renderer/bsdf/albedo_table.h"
#include "renderer/bsdf/dielectric.h"
#include "renderer/bsdf/fresnel.h"
#include "renderer/bsdf/microfacet.h"
#include "renderer/bsdf/sheen.h"
#include "renderer/bsdf/stack.h"
#include "renderer/sampling/warp.h"

namespace candela {

namespace {

// KHR_materials_clearcoat fixes the coat's index at 1.5.
constexpr float coat_f0 = 0.04f;

// A chosen lobe keeps at least this share of the samples: the exact share matters little, a starved lobe is noise.
constexpr float least_probability = 0.05f;

bool reflects(const Vec3& wi) {
    return wi.z > 0.0f;
}

float albedo_of_coat(const BsdfStack& stack, const Bsdf& bsdf) {
    const SpecularAlbedo e = specular_albedo(stack.coat_wo.z, bsdf.coat_alpha);
    return (coat_f0 * e.scale + e.bias) * (1.0f + coat_f0 * (1.0f / e.total() - 1.0f));
}

}  // namespace

BsdfStack make_stack(const Bsdf& bsdf, const Vec3& wo) noexcept {
    BsdfStack out;
    if (bsdf.coat > 0.0f) {
        out.coat_frame = OrthonormalFrame::from_normal(bsdf.coat_normal);
        out.coat_wo = out.coat_frame.local_from_world(wo);
        if (out.coat_wo.z > 0.0f) {
            out.coat_energy = specular_albedo(out.coat_wo.z, bsdf.coat_alpha).total();
            out.coat = bsdf.coat * albedo_of_coat(out, bsdf);
            out.below_coat = 1.0f - out.coat;
        }
    }
    const float sheen_peak = max_component(bsdf.sheen_color);
    const float sheen = sheen_peak > 0.0f ? sheen_peak * sheen_albedo(wo.z, bsdf.sheen_alpha) : 0.0f;
    out.below_sheen = out.below_coat * (1.0f - sheen);
    out.opaque = make_opaque_lobes(bsdf, wo);
    out.glass = (1.0f - bsdf.metallic) * bsdf.transmission;

    // Choose lobes by about the light that they return.
    float* p = out.probability;
    p[coat_lobe] = out.coat;
    p[sheen_lobe] = out.below_coat * sheen;
    p[specular_lobe] = out.below_sheen * max_component(out.opaque.specular);
    p[diffuse_lobe] = out.below_sheen * max_component(out.opaque.diffuse);
    p[transmitted_lobe] = out.below_sheen * max_component(out.opaque.transmitted);
    if (out.glass > 0.0f) {
        p[glass_lobe] = out.below_sheen * out.glass *
                        std::max(max_component(dielectric_reflectance(bsdf, wo.z)), max_component(bsdf.base_color));
    }
    float total = 0;
    for (int k = 0; k < bsdf_lobe_count; ++k)
        total += p[k];
    if (!(total > 0.0f)) return out;
    float raised = 0;
    for (int k = 0; k < bsdf_lobe_count; ++k) {
        if (p[k] > 0.0f) p[k] = std::max(p[k] / total, least_probability);
        raised += p[k];
    }
    for (int k = 0; k < bsdf_lobe_count; ++k)
        p[k] /= raised;
    return out;
}

bool scatters_broadly(const Bsdf& bsdf, const BsdfStack& stack) noexcept {
    const float* p = stack.probability;
    const bool rough = p[specular_lobe] > 0.0f || p[glass_lobe] > 0.0f;
    return p[diffuse_lobe] > 0.0f || p[transmitted_lobe] > 0.0f || p[sheen_lobe] > 0.0f ||
           (rough && bsdf.alpha.x > 0.0f) || (p[coat_lobe] > 0.0f && bsdf.coat_alpha > 0.0f);
}

BsdfEval eval(const Bsdf& bsdf, const BsdfStack& stack, const Vec3& wo, const Vec3& wi) noexcept {
    BsdfEval out;
    if (!reflects(wi) && !bsdf.transmits()) return out;
    const float* p = stack.probability;
    if (reflects(wi)) {
        if (p[diffuse_lobe] > 0.0f) {
            out.value = stack.below_sheen * eval_diffuse(bsdf, stack.opaque, wi);
            out.pdf = p[diffuse_lobe] * cosine_hemisphere_pdf(wi.z);
        }
        if (p[specular_lobe] > 0.0f && bsdf.alpha.x > 0.0f) {
            out.value += stack.below_sheen * eval_specular(bsdf, stack.opaque, wo, wi);
            out.pdf += p[specular_lobe] * specular_pdf(bsdf, wo, wi);
        }
        if (p[sheen_lobe] > 0.0f) {
            out.value += stack.below_coat * eval_sheen(wo, wi, bsdf.sheen_alpha) * bsdf.sheen_color;
            out.pdf += p[sheen_lobe] * sheen_pdf();
        }
        if (p[coat_lobe] > 0.0f && bsdf.coat_alpha > 0.0f) {
            const Vec3 coat_wi = stack.coat_frame.local_from_world(wi);
            if (coat_wi.z > 0.0f) {
                const Vec3 h = glm::normalize(stack.coat_wo + coat_wi);
                const Vec2 alpha(bsdf.coat_alpha);
                const float fresnel = lerp(coat_f0, 1.0f, schlick_weight(glm::dot(stack.coat_wo, h))) *
                                      (1.0f + coat_f0 * (1.0f / stack.coat_energy - 1.0f));
                out.value += bsdf.coat * fresnel * ggx_density(h, alpha) *
                             ggx_visibility(stack.coat_wo, coat_wi, alpha) * coat_wi.z;
                out.pdf += p[coat_lobe] * reflected_visible_normal_pdf(stack.coat_wo, h, alpha);
            }
        }
    } else if (p[transmitted_lobe] > 0.0f) {
        out.value = stack.below_sheen * eval_diffuse(bsdf, stack.opaque, wi);
        out.pdf = p[transmitted_lobe] * cosine_hemisphere_pdf(-wi.z);
    }
    if (p[glass_lobe] > 0.0f) {
        const BsdfEval glass = eval_dielectric(bsdf, wo, wi);
        out.value += stack.below_sheen * stack.glass * glass.value;
        out.pdf += p[glass_lobe] * glass.pdf;
    }
    return out;
}

float ggx_alpha(float perceptual_roughness) {
    const float alpha = std::min(sqr(perceptual_roughness), 1.0f);
    return alpha < min_ggx_alpha ? 0.0f : alpha;
}

Vec2 anisotropic_alpha(float perceptual_roughness, float strength) {
    const float across = ggx_alpha(perceptual_roughness);
    if (!(strength > 0.0f)) return Vec2(across);
    const float narrow = std::max(across, min_ggx_alpha);
    return {lerp(narrow, 1.0f, strength * strength), narrow};
}

Bsdf make_bsdf(const Vec3& base_color, float metallic, float perceptual_roughness, float ior, float specular_factor,
               const Vec3& specular_color) {
    // KHR_materials_ior and KHR_materials_specular, "Implementation".
    const float r = ior == 0.0f ? 1.0f : normal_reflectance(ior);
    Bsdf out;
    out.base_color = base_color;
    out.metal_f0 = base_color;
    out.metallic = std::clamp(metallic, 0.0f, 1.0f);
    out.dielectric_f0 = glm::min(r * specular_color, Vec3(1)) * specular_factor;
    out.dielectric_f90 = specular_factor;
    out.alpha = Vec2(ggx_alpha(perceptual_roughness));
    out.eta = ior == 0.0f ? 1e6f : ior;
    return out;
}

BsdfSample sample(const Bsdf& bsdf, const Vec3& wo, float u_lobe, const Vec2& u) noexcept {
    return wo.z > 0.0f ? sample(bsdf, make_stack(bsdf, wo), wo, u_lobe, u) : BsdfSample{};
}

BsdfSample sample(const Bsdf& bsdf, const BsdfStack& stack, const Vec3& wo, float u_lobe, const Vec2& u) noexcept {
    BsdfSample out;

    // Choose the lobe.
    const auto [lobe, probability, u_rest] = choose_lobe(stack, u_lobe);
    if (lobe == bsdf_lobe_count) return out;

    // Draw the direction; smooth lobes know their weight at once.
    Vec3 delta_value(0);
    switch (lobe) {
        case coat_lobe: {
            Vec3 wi(-stack.coat_wo.x, -stack.coat_wo.y, stack.coat_wo.z);
            if (bsdf.coat_alpha > 0.0f) {
                const Vec3 h = sample_visible_normal(stack.coat_wo, Vec2(bsdf.coat_alpha), u);
                wi = 2.0f * glm::dot(stack.coat_wo, h) * h - stack.coat_wo;
            } else {
                out.is_delta = true;
                delta_value = Vec3(stack.coat);
            }
            if (!(wi.z > 0.0f)) return {};
            out.wi = stack.coat_frame.world_from_local(wi);
            if (!reflects(out.wi)) return {};
            break;
        }
        case sheen_lobe:
            out.wi = sample_sheen(u);
            break;
        case specular_lobe:
            out.wi = sample_specular(bsdf, wo, u);
            out.is_delta = bsdf.alpha.x == 0.0f;
            delta_value = stack.below_sheen * stack.opaque.specular;
            if (!reflects(out.wi)) return {};
            break;
        case diffuse_lobe:
            out.wi = sample_cosine_hemisphere(u);
            break;
        case transmitted_lobe:
            out.wi = sample_cosine_hemisphere(u);
            out.wi.z = -out.wi.z;
            break;
        case glass_lobe:
        case bsdf_lobe_count: {
            const BsdfSample glass = sample_dielectric(bsdf, wo, u_rest, u);
            if (!(glass.pdf > 0.0f)) return {};
            out = glass;
            delta_value = stack.below_sheen * stack.glass * glass.weight;
            break;
        }
    }
    if (out.is_delta) {
        out.pdf = probability * (out.pdf > 0.0f ? out.pdf : 1.0f);
        out.weight = delta_value / probability;
        return out;
    }

    // Any lobe could have drawn this direction.
    const BsdfEval all = eval(bsdf, stack, wo, out.wi);
    if (!(all.pdf > 0.0f) || !std::isfinite(all.pdf)) return {};
    out.pdf = all.pdf;
    out.weight = all.value / all.pdf;
    return out;
}

BsdfEval eval(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) noexcept {
    return wo.z > 0.0f ? eval(bsdf, make_stack(bsdf, wo), wo, wi) : BsdfEval{};
}

Vec3 albedo(const Bsdf& bsdf, const Vec3& wo) noexcept {
    if (!(wo.z > 0.0f)) return Vec3(0);
    const BsdfStack stack = make_stack(bsdf, wo);
    Vec3 base = stack.opaque.specular + stack.opaque.diffuse + stack.opaque.transmitted;
    if (stack.glass > 0.0f) {
        base += stack.glass * (dielectric_reflectance(bsdf, wo.z) + dielectric_transmittance(bsdf, wo.z));
    }
    Vec3 out = Vec3(stack.coat) + stack.below_sheen * base;
    if (!is_black(bsdf.sheen_color)) out += stack.below_coat * sheen_albedo(wo.z, bsdf.sheen_alpha) * bsdf.sheen_color;
    return out;
}

Vec3 straight_transmittance(const Bsdf& bsdf, const Vec3& wo) noexcept {
    if (!(bsdf.transmission > 0.0f) || !bsdf.thin_walled || bsdf.alpha.x > 0.0f || !(wo.z > 0.0f)) return Vec3(0);
    const BsdfStack stack = make_stack(bsdf, wo);
    return stack.below_sheen * stack.glass * dielectric_transmittance(bsdf, wo.z);
}

}  // namespace candela
