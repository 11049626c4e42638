// SPDX-License-Identifier: MIT
// The contract of all surface scattering: a small value with textures already evaluated, and free functions over it.
//
// Directions are unit vectors in the local shading frame (z = shading normal) and point away from the surface.
// wo goes back along the path, wi onward. pdf is per solid angle of wi. eval includes the cosine |wi.z|.
// A direction on the other side of the surface than the lobe scatters to has value 0 and pdf 0.
#pragma once

#include "renderer/math/math.h"

namespace candela {

// The parameters of glTF's metallic-roughness material, with KHR_materials_specular and KHR_materials_ior folded into
// the dielectric's f0 and f90.
struct Bsdf {
    Vec3 base_color{0.8f};
    float metallic = 0.0f;
    Vec3 dielectric_f0{0.04f};
    float dielectric_f90 = 1.0f;
    // GGX width, the square of glTF's perceptual roughness; make_bsdf keeps it at or above min_ggx_alpha.
    float alpha = 1.0f;
};

struct BsdfSample {
    Vec3 wi{0};
    // f · |cos| / pdf
    Vec3 weight{0};
    float pdf = 0.0f;  // 0: no sample; the path ends
    // A delta direction: no other technique can find it, and pdf is then the probability of the lobe.
    bool is_delta = false;
    // Relative index of refraction crossed by the sample, 1 for reflection.
    float eta = 1.0f;
};

struct BsdfEval {
    Vec3 value{0};  // f · |cos|
    float pdf = 0.0f;
};

inline constexpr float min_ggx_alpha = 1e-3f;

// base_color, metallic and perceptual_roughness as glTF defines them, each in [0,1]; ior >= 1; specular_factor and
// specular_color as KHR_materials_specular defines them (1 and white where absent).
Bsdf make_bsdf(const Vec3& base_color, float metallic, float perceptual_roughness, float ior, float specular_factor,
               const Vec3& specular_color);

// Draws wi ∝ about f·cos: u_lobe picks the lobe, u the direction, all uniform in [0,1).
BsdfSample sample(const Bsdf& bsdf, const Vec3& wo, float u_lobe, const Vec2& u) noexcept;
// f·|cos| and the pdf with which sample() draws wi (all lobes together).
BsdfEval eval(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) noexcept;
// Directional albedo: the integral of f·|cos| over wi, in closed or tabulated form.
Vec3 albedo(const Bsdf& bsdf, const Vec3& wo) noexcept;

}  // namespace candela
