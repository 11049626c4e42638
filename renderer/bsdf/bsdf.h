// SPDX-License-Identifier: MIT
// The contract of all surface scattering: a small value with textures already evaluated, and free functions over it.
//
// Directions are unit vectors in the local shading frame (z = shading normal, x = direction of the anisotropy) and
// point away from the surface. wo goes back along the path, wi onward; wo.z > 0, whichever side of the surface that is.
// pdf is per solid angle of wi. eval includes the cosine |wi.z|. Values transport radiance: what is refracted into a
// medium of relative index eta is scaled by 1/eta² (Veach 1997, equation 5.14).
#pragma once

#include "renderer/math/math.h"

namespace candela {

// glTF's layered material at one point (specification, appendix B, and the KHR_materials extensions):
//     coat over sheen over mix(dielectric, metal, metallic),
//     dielectric = specular over mix(mix(diffuse, diffuse_transmission), glass, transmission).
// A layer takes the share of light that it reflects itself; the rest goes to what lies below (albedo scaling).
struct Bsdf {
    Vec3 base_color{0.8f};
    float metallic = 0.0f;
    Vec3 dielectric_f0{0.04f};  // reflectance at normal incidence, KHR_materials_specular and iridescence folded in
    float dielectric_f90 = 1.0f;
    Vec3 metal_f0{0.8f};  // base_color unless a thin film changes it
    // GGX widths along x and y. 0: a perfectly smooth surface, whose directions are deltas.
    Vec2 alpha{1.0f};

    float transmission = 0.0f;  // KHR_materials_transmission, tinted by base_color
    bool thin_walled = true;    // without volume: light goes on straight
    float eta = 1.5f;           // index below the surface (away from wo) over the index on wo's side

    float diffuse_transmission = 0.0f;  // KHR_materials_diffuse_transmission
    Vec3 diffuse_transmission_color{1.0f};

    Vec3 sheen_color{0.0f};  // KHR_materials_sheen
    float sheen_alpha = 1.0f;

    float coat = 0.0f;  // KHR_materials_clearcoat
    float coat_alpha = 0.0f;
    Vec3 coat_normal{0, 0, 1};  // local; sees wo

    bool transmits() const { return transmission > 0.0f || diffuse_transmission > 0.0f; }
};

struct BsdfSample {
    Vec3 wi{0};
    // f · |cos| / pdf
    Vec3 weight{0};
    float pdf = 0.0f;  // 0: no sample; the path ends
    // A delta direction: no other technique can find it, and pdf is then the probability of the lobe.
    bool is_delta = false;
    // The light goes on straight, through a smooth thin wall: wi = -wo, and straight_transmittance() is the value.
    bool is_straight = false;
    // Relative index of refraction crossed by the sample, 1 for reflection.
    float eta = 1.0f;
};

struct BsdfEval {
    Vec3 value{0};  // f · |cos|, without deltas
    float pdf = 0.0f;
};

// Narrower GGX lobes are taken for perfectly smooth: single precision can't hold them, and no picture shows them.
inline constexpr float min_ggx_alpha = 1e-3f;

// base_color, metallic and perceptual_roughness as glTF defines them, each in [0,1]; ior >= 1, or 0 for total
// reflection; specular_factor and specular_color as KHR_materials_specular defines them (1 and white where absent).
Bsdf make_bsdf(const Vec3& base_color, float metallic, float perceptual_roughness, float ior, float specular_factor,
               const Vec3& specular_color);

// The GGX width of a perceptual roughness: its square, or 0 where that is below min_ggx_alpha.
float ggx_alpha(float perceptual_roughness);
// KHR_materials_anisotropy, "Implementation": wider along x. strength in [0,1].
Vec2 anisotropic_alpha(float perceptual_roughness, float strength);

// Draws wi ∝ about f·cos: u_lobe picks the lobe, u the direction, all uniform in [0,1).
BsdfSample sample(const Bsdf& bsdf, const Vec3& wo, float u_lobe, const Vec2& u) noexcept;
// f·|cos| and the pdf with which sample() draws wi (all lobes together but deltas).
BsdfEval eval(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) noexcept;
// Directional albedo: the share of light from wo that is scattered anywhere, in closed or tabulated form.
Vec3 albedo(const Bsdf& bsdf, const Vec3& wo) noexcept;
// The share that goes on straight through a smooth thin wall; 0 for all other surfaces.
Vec3 straight_transmittance(const Bsdf& bsdf, const Vec3& wo) noexcept;

}  // namespace candela
