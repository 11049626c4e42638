// SPDX-License-Identifier: MIT
// From a hit to something that scatters: interpolation, normal mapping, material evaluation.
#pragma once

#include "renderer/bsdf/bsdf.h"
#include "renderer/math/frame.h"
#include "renderer/world/world.h"

namespace candela {

struct SurfacePoint {
    Vec3 position{0};          // on the triangle, world space
    Vec3 geometric_normal{0};  // unit, on the side of wo
    OrthonormalFrame shading;  // its normal is on the side of wo, normal map applied
    Vec2 uv[2]{};
    Vec4 color{1};  // vertex colour
    uint32_t material = 0;
    uint32_t surface = 0, triangle = 0;
    bool front_face = true;  // wo is on the front side of the triangle
};

// wo: unit, back along the ray. A shading normal that faces away from wo is bent until wo is just above its horizon, so
// that no visible point is black for lack of a hemisphere.
SurfacePoint make_surface_point(const World& world, const Hit& hit, const Vec3& wo) noexcept;

// All textures of the material, evaluated once.
struct ShadedMaterial {
    Bsdf bsdf;
    Vec3 emission{0};    // radiance towards wo; 0 on a side that does not emit
    bool unlit = false;  // shows `emission` and scatters nothing (KHR_materials_unlit)
};
ShadedMaterial shade_material(const World& world, const SurfacePoint& point) noexcept;

// Radiance that an emissive surface sends out from p0 + u·edge1 + v·edge2 of its EmissiveTriangle, on a side that
// emits, times its opacity there.
Vec3 emitted_radiance(const World& world, uint32_t surface, uint32_t triangle, float u, float v) noexcept;

// Opacity 0..1 at (1-u-v)·p0 + u·p1 + v·p2: 1, the mask's decision, or the blend's alpha.
float surface_opacity(const World& world, uint32_t surface, uint32_t triangle, float u, float v) noexcept;

}  // namespace candela
