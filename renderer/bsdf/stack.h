// SPDX-License-Identifier: MIT
// The layers of a material as seen from one direction: made once where light is both sampled and evaluated there.
#pragma once

#include "renderer/bsdf/metallic_roughness.h"
#include "renderer/math/frame.h"

namespace candela {

enum BsdfLobe : uint8_t {
    coat_lobe,
    sheen_lobe,
    specular_lobe,
    diffuse_lobe,
    transmitted_lobe,
    glass_lobe,
    bsdf_lobe_count
};

struct BsdfStack {
    OpaqueLobes opaque;
    OrthonormalFrame coat_frame;
    Vec3 coat_wo{0};
    float coat_energy = 1;                    // single-scattering albedo of a mirror of the coat's roughness
    float coat = 0;                           // albedo of the coat
    float below_coat = 1;                     // share of light that passes the coat
    float below_sheen = 1;                    // share of light that reaches the base
    float glass = 0;                          // share of the base that is glass
    float probability[bsdf_lobe_count] = {};  // of drawing from each lobe
};

// wo.z > 0.
BsdfStack make_stack(const Bsdf& bsdf, const Vec3& wo) noexcept;

// Whether sample() may draw other directions than deltas.
bool scatters_broadly(const Bsdf& bsdf, const BsdfStack& stack) noexcept;

// The lobe that sample() draws from; what is left of u_lobe is uniform in [0, 1) again.
struct LobeChoice {
    BsdfLobe lobe = bsdf_lobe_count;  // none: nothing is scattered
    float probability = 0, u_rest = 0;
};
inline LobeChoice choose_lobe(const BsdfStack& stack, float u_lobe) noexcept {
    LobeChoice out;
    out.u_rest = u_lobe;
    for (int k = 0; k < bsdf_lobe_count; ++k) {
        if (!(stack.probability[k] > 0.0f)) continue;
        out.lobe = static_cast<BsdfLobe>(k);
        out.probability = stack.probability[k];
        if (out.u_rest < out.probability) break;
        out.u_rest -= out.probability;
    }
    if (out.lobe != bsdf_lobe_count) out.u_rest = std::min(out.u_rest / out.probability, one_minus_epsilon);
    return out;
}

// As the functions of bsdf.h that make the stack themselves.
BsdfSample sample(const Bsdf& bsdf, const BsdfStack& stack, const Vec3& wo, float u_lobe, const Vec2& u) noexcept;
BsdfEval eval(const Bsdf& bsdf, const BsdfStack& stack, const Vec3& wo, const Vec3& wi) noexcept;

}  // namespace candela
