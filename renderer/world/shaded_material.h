// SPDX-License-Identifier: MIT
// A material at a point: all its textures evaluated, once.
#pragma once

#include "renderer/bsdf/bsdf.h"
#include "renderer/world/surface_point.h"

namespace candela {

// The indices of refraction that meet at the boundary of a volume, where the path knows them; without, air and the
// material's own.
struct InterfaceIndices {
    float near = 0;  // on wo's side; 0: not known
    float far = 0;
};

struct ShadedMaterial {
    Bsdf bsdf;
    Vec3 emission{0};    // radiance towards wo; 0 on a side that does not emit
    bool unlit = false;  // shows `emission` and scatters nothing (KHR_materials_unlit)
};

// wo: unit, back along the ray, as given to make_surface_point.
ShadedMaterial shade_material(const World& world, const SurfacePoint& point, const Vec3& wo,
                              const InterfaceIndices& indices = {}) noexcept;

// Radiance that an emissive surface sends out from p0 + u·edge1 + v·edge2 of its EmissiveTriangle, on a side that
// emits, times its opacity there.
Vec3 emitted_radiance(const World& world, uint32_t surface, uint32_t triangle, float u, float v) noexcept;

// Opacity 0..1 at (1-u-v)·p0 + u·p1 + v·p2: 1, the mask's decision, or the blend's alpha.
float surface_opacity(const World& world, uint32_t surface, uint32_t triangle, float u, float v) noexcept;

// The share of light that passes the point in a straight line along `direction`: what the opacity leaves, and what
// smooth thin glass lets through.
Vec3 surface_transmittance(const World& world, uint32_t surface, uint32_t triangle, float u, float v,
                           const Vec3& direction) noexcept;

}  // namespace candela
