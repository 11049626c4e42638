// SPDX-License-Identifier: MIT
// A triangle as a point sees it: its solid angle, and uniform samples of it.
#pragma once

#include "renderer/math/math.h"

namespace candela {

// The three corners as unit directions from a point, in double precision: long thin emitters need it.
struct SphericalTriangle {
    glm::dvec3 a, b, c;
    double solid_angle = 0;

    SphericalTriangle(const Vec3& from, const Vec3& p0, const Vec3& edge1, const Vec3& edge2);
};

// Uniform per solid angle (Arvo 1995, "Stratified Sampling of Spherical Triangles"); pdf = 1 / solid_angle. Needs a
// solid angle that is neither near 0 nor near a half sphere.
glm::dvec3 sample_spherical_triangle(const SphericalTriangle& triangle, const Vec2& u) noexcept;

}  // namespace candela
