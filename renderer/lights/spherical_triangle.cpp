// SPDX-License-Identifier: MIT
#include "renderer/lights/spherical_triangle.h"

#include <glm/gtc/constants.hpp>

namespace candela {

namespace {

double safe_root(double x) {
    return std::sqrt(std::max(x, 0.0));
}

// The part of v across the unit vector w, normalised; 0 where there is none.
glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& w) {
    const glm::dvec3 part = v - glm::dot(v, w) * w;
    const double length = glm::length(part);
    return length > 0 ? part / length : glm::dvec3(0);
}

glm::dvec3 direction_to(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
}

}  // namespace

SphericalTriangle::SphericalTriangle(const Vec3& from, const Vec3& p0, const Vec3& edge1, const Vec3& edge2)
    : a(direction_to(glm::dvec3(p0) - glm::dvec3(from))),
      b(direction_to(glm::dvec3(p0) + glm::dvec3(edge1) - glm::dvec3(from))),
      c(direction_to(glm::dvec3(p0) + glm::dvec3(edge2) - glm::dvec3(from))) {
    // Van Oosterom and Strackee 1983, equation 8.
    const double volume = std::abs(glm::dot(a, glm::cross(b, c)));
    solid_angle = 2.0 * std::atan2(volume, 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
    if (solid_angle < 0) solid_angle += 4.0 * glm::pi<double>();
}

glm::dvec3 sample_spherical_triangle(const SphericalTriangle& t, const Vec2& u) noexcept {
    // The angle at corner a, between the planes of its two sides.
    const glm::dvec3 side_b = across(t.b, t.a);
    const glm::dvec3 side_c = across(t.c, t.a);
    const double cos_alpha = std::clamp(glm::dot(side_b, side_c), -1.0, 1.0);
    const double sin_alpha = glm::length(glm::cross(side_b, side_c));
    const double alpha = std::atan2(sin_alpha, cos_alpha);

    // Cut off a sub-triangle a, b, c' of the fraction u.x of the area; c' lies on the side from a to c.
    const double part = static_cast<double>(u.x) * t.solid_angle;
    const double s = std::sin(part - alpha);
    const double r = std::cos(part - alpha);
    const double k1 = r - cos_alpha;
    const double k2 = s + sin_alpha * glm::dot(t.a, t.b);
    const double denominator = (k2 * s + k1 * r) * sin_alpha;
    const double q = denominator != 0 ? ((k2 * r - k1 * s) * cos_alpha - k2) / denominator : 1.0;
    const double cos_side = std::clamp(q, -1.0, 1.0);
    const glm::dvec3 moved = cos_side * t.a + safe_root(1 - cos_side * cos_side) * side_c;

    // Choose a point on the arc from b to c', uniform in height above b.
    const double z = 1.0 - static_cast<double>(u.y) * (1.0 - glm::dot(moved, t.b));
    return z * t.b + safe_root(1 - z * z) * across(moved, t.b);
}

}  // namespace candela
