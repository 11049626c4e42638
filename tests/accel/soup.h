// SPDX-License-Identifier: MIT
// Random triangles, and what a ray hits of them by brute force.
#pragma once

#include <random>

#include "renderer/accel/accel.h"

namespace candela::test {

class Random {
  public:
    float uniform() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
    Vec3 in_box(float half) { return half * (2.0f * Vec3(uniform(), uniform(), uniform()) - 1.0f); }
    Vec3 direction() {
        for (;;) {
            const Vec3 v = in_box(1);
            const float length = glm::length(v);
            if (length > 0.1f && length < 1) return v / length;
        }
    }

  private:
    std::mt19937 engine_{23};
};

// Triangles with room behind the last position, as Accel wants it.
struct Soup {
    std::vector<Vec3> positions;
    std::vector<Vec3u> triangles;

    Soup(Random& random, int count, float size) {
        for (int i = 0; i < count; ++i) {
            const Vec3 middle = random.in_box(1);
            for (int corner = 0; corner < 3; ++corner)
                positions.push_back(middle + random.in_box(size));
            triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
        }
        positions.resize(positions.size() + 2);
    }
    AccelGeometry geometry(bool has_opacity = false) const {
        return {std::span(positions).first(positions.size() - 2), triangles, has_opacity, {}};
    }
};

// Möller and Trumbore 1997, in double precision.
inline void hit_triangle(const Ray& ray, const glm::dvec3& p0, const glm::dvec3& p1, const glm::dvec3& p2,
                         uint32_t surface, uint32_t triangle, Hit& nearest) {
    const glm::dvec3 d(ray.direction), e1 = p1 - p0, e2 = p2 - p0, h = glm::cross(d, e2);
    const double determinant = glm::dot(e1, h);
    if (determinant == 0) return;
    const glm::dvec3 s = glm::dvec3(ray.origin) - p0, q = glm::cross(s, e1);
    const double u = glm::dot(s, h) / determinant, v = glm::dot(d, q) / determinant, t = glm::dot(e2, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1 || t <= 0 || t >= static_cast<double>(nearest.distance)) return;
    nearest = {static_cast<float>(t), static_cast<float>(u), static_cast<float>(v), surface, triangle};
}

inline void hit_soup(const Ray& ray, const Soup& soup, const Mat4& transform, uint32_t surface, Hit& nearest) {
    for (uint32_t i = 0; i < soup.triangles.size(); ++i) {
        const auto corner = [&](int k) {
            return glm::dvec3(glm::dmat4(transform) * glm::dvec4(soup.positions[soup.triangles[i][k]], 1));
        };
        hit_triangle(ray, corner(0), corner(1), corner(2), surface, i, nearest);
    }
}

}  // namespace candela::test
