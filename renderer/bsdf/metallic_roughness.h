// SPDX-License-Identifier: MIT
// The opaque part of glTF 2.0's material (specification, appendix B): a metal and a dielectric-coated diffuse, blended
// by `metallic`; the diffuse may leave on the other side (KHR_materials_diffuse_transmission).
#pragma once

#include "renderer/bsdf/bsdf.h"

namespace candela {

// What all evaluations for one wo share. Albedos are those of the whole material but coat and sheen; what glass takes
// is left out.
struct OpaqueLobes {
    Vec3 specular{0};     // of the dielectric's and the metal's reflection together
    Vec3 diffuse{0};      // of the diffuse that returns
    Vec3 transmitted{0};  // of the diffuse that leaves on the other side
    float dielectric = 1, metal = 0;
    float energy = 1;  // single-scattering albedo of a perfect mirror of this roughness
};

OpaqueLobes make_opaque_lobes(const Bsdf& bsdf, const Vec3& wo) noexcept;

// f·cos for wi above the surface, rough specular only.
Vec3 eval_specular(const Bsdf& bsdf, const OpaqueLobes& lobes, const Vec3& wo, const Vec3& wi) noexcept;
// pdf of a reflection at a visible normal.
float specular_pdf(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) noexcept;
Vec3 sample_specular(const Bsdf& bsdf, const Vec3& wo, const Vec2& u) noexcept;
// f·cos of both diffuse lobes; wi on either side. Drawn ∝ cosine.
Vec3 eval_diffuse(const Bsdf& bsdf, const OpaqueLobes& lobes, const Vec3& wi) noexcept;

}  // namespace candela
