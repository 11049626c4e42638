// SPDX-License-Identifier: MIT
// From a hit to a point with a frame: interpolation and normal mapping.
#pragma once

#include "renderer/math/frame.h"
#include "renderer/world/world.h"

namespace candela {

struct SurfacePoint {
    Vec3 position{0};          // on the triangle, world space
    Vec3 geometric_normal{0};  // unit, on the side of wo
    float error_m = 0;         // a ray that starts this far off, along the normal, does not meet the same triangle
    // Its normal is on the side of wo, normal map applied; its tangent is the direction of the anisotropy.
    OrthonormalFrame shading;
    Vec3 coat_normal{0};            // unit, on the side of wo: that of KHR_materials_clearcoat, if the material has it
    float anisotropy_strength = 0;  // texture applied
    Vec2 uv[2]{};
    Vec4 color{1};                  // vertex colour
    TextureFootprint footprint[2];  // of each uv set, before a use's transform
    uint32_t material = 0;
    uint32_t surface = 0, triangle = 0;
    bool bent = false;       // the shading normal was, for this wo
    bool front_face = true;  // wo is on the front side of the triangle
};

// The bundle of rays that meets a surface: for texture footprints.
struct RayFootprint {
    float width_m = 0;  // 0: a single ray, textures are read at level 0
    float share = 1;    // of its area for this sample
    float u_level = 0;  // uniform in [0, 1)
};

// wo: unit, back along the ray. A shading normal whose mirror direction leaves through the surface is bent until that
// direction just grazes the surface, so that no visible point is black for lack of a hemisphere (Keller et al. 2017,
// "The Iray Light Transport Simulation and Rendering System", section A.3).
SurfacePoint make_surface_point(const World& world, const Hit& hit, const Vec3& wo,
                                const RayFootprint& footprint = {}) noexcept;

// Whether it would bend this shading normal for wo; all unit vectors, wo on the side of the geometric normal.
bool bends_towards(const Vec3& shading_normal, const Vec3& geometric_normal, const Vec3& wo) noexcept;

// What make_surface_point will read of a large mesh, asked for early: first where the triangle's vertices are, later
// the vertices. Only for speed.
void prefetch_triangle(const World& world, const Hit& hit) noexcept;
void prefetch_vertices(const World& world, const Hit& hit) noexcept;

// The texture coordinate of a use of a texture, at a point whose coordinate sets are known, or at
// (1-u-v)·p0 + u·p1 + v·p2 of a triangle.
Vec2 texture_uv(const TextureRef& ref, const Vec2 uv[2]) noexcept;
Vec2 texture_uv(const TextureRef& ref, const Primitive& primitive, uint32_t triangle, float u, float v) noexcept;

}  // namespace candela
