// SPDX-License-Identifier: MIT
// Hits against brute force, opacity inside the traversal, and rays that are none.
#include "renderer/accel/accel.h"

#include <random>

namespace candela {
namespace {

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
    AccelGeometry geometry(uint32_t surface, bool has_opacity = false) const {
        return {std::span(positions).first(positions.size() - 2), triangles, has_opacity, surface};
    }
};

// Möller and Trumbore 1997, in double precision.
void hit_triangle(const Ray& ray, const glm::dvec3& p0, const glm::dvec3& p1, const glm::dvec3& p2, uint32_t surface,
                  uint32_t triangle, Hit& nearest) {
    const glm::dvec3 d(ray.direction), e1 = p1 - p0, e2 = p2 - p0, h = glm::cross(d, e2);
    const double determinant = glm::dot(e1, h);
    if (determinant == 0) return;
    const glm::dvec3 s = glm::dvec3(ray.origin) - p0, q = glm::cross(s, e1);
    const double u = glm::dot(s, h) / determinant, v = glm::dot(d, q) / determinant, t = glm::dot(e2, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1 || t <= 0 || t >= static_cast<double>(nearest.distance)) return;
    nearest = {static_cast<float>(t), static_cast<float>(u), static_cast<float>(v), surface, triangle};
}

void hit_soup(const Ray& ray, const Soup& soup, const Mat4& transform, uint32_t surface, Hit& nearest) {
    for (uint32_t i = 0; i < soup.triangles.size(); ++i) {
        const auto corner = [&](int k) {
            return glm::dvec3(glm::dmat4(transform) * glm::dvec4(soup.positions[soup.triangles[i][k]], 1));
        };
        hit_triangle(ray, corner(0), corner(1), corner(2), surface, i, nearest);
    }
}

TEST(Accel, HitsAreThoseOfBruteForce) {
    Random random;
    const Soup world(random, 150, 0.3f), shared(random, 60, 0.2f);
    AccelInput input;
    input.world_geometry = {world.geometry(0)};
    input.groups = {{shared.geometry(0)}};
    // A mirror image, a squeezed and a turned one.
    const Mat4 mirrored(Vec4(-1, 0, 0, 0), Vec4(0, 1, 0, 0), Vec4(0, 0, 1, 0), Vec4(1.5f, 0, 0, 1));
    const Mat4 squeezed(Vec4(0, 0.3f, 0, 0), Vec4(2, 0, 0, 0), Vec4(0, 0, 1, 0), Vec4(-1, 0.5f, 0, 1));
    const Mat4 sheared(Vec4(1, 0.5f, 0, 0), Vec4(0, 1, 0.25f, 0), Vec4(0, 0, 0.5f, 0), Vec4(0, -1, 1, 1));
    input.instances = {{0, mirrored, 1}, {0, squeezed, 2}, {0, sheared, 3}};
    const std::unique_ptr<Accel> accel = Accel::build(input);

    int hits = 0, differing = 0;
    for (int i = 0; i < 3000; ++i) {
        const Ray ray{random.in_box(2), random.direction()};
        Hit expected;
        hit_soup(ray, world, Mat4(1), 0, expected);
        hit_soup(ray, shared, mirrored, 1, expected);
        hit_soup(ray, shared, squeezed, 2, expected);
        hit_soup(ray, shared, sheared, 3, expected);
        const Hit hit = accel->intersect(ray, 0);
        hits += expected.valid() ? 1 : 0;
        // A ray along an edge may go either way.
        if (hit.valid() != expected.valid() || hit.surface != expected.surface || hit.triangle != expected.triangle) {
            ++differing;
            continue;
        }
        if (!hit.valid()) continue;
        EXPECT_NEAR(hit.distance, expected.distance, 1e-4f * (1 + expected.distance));
        EXPECT_NEAR(hit.u, expected.u, 2e-3f);
        EXPECT_NEAR(hit.v, expected.v, 2e-3f);
        EXPECT_EQ(accel->transmittance({ray.origin, ray.direction, hit.distance * 1.001f}), Vec3(0));
        EXPECT_EQ(accel->transmittance({ray.origin, ray.direction, hit.distance * 0.999f}), Vec3(1));
    }
    EXPECT_GT(hits, 300);
    EXPECT_LE(differing, 2);
}

// Opacity by surface.
float opacity_of(const void* user, uint32_t surface, uint32_t, float, float) noexcept {
    return static_cast<const float*>(user)[surface];
}

// Squares across the z axis at 1, 2, 3 of these opacities.
std::unique_ptr<Accel> make_sheets(const float* opacities, std::vector<std::vector<Vec3>>& positions,
                                   const std::vector<Vec3u>& triangles) {
    AccelInput input;
    for (uint32_t i = 0; i < 3; ++i) {
        const auto z = static_cast<float>(i + 1);
        positions.push_back({{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}, {}, {}});
    }
    for (uint32_t i = 0; i < 3; ++i)
        input.world_geometry.push_back({std::span(positions[i]).first(4), triangles, true, i});
    input.opacity = opacity_of;
    input.opacity_user = opacities;
    return Accel::build(input);
}

TEST(Accel, LightIsWeakenedBySheetsOneByOne) {
    const float opacities[] = {0.25f, 0.5f, 0.0f};
    std::vector<std::vector<Vec3>> positions;
    const std::vector<Vec3u> triangles{{0, 1, 2}, {0, 2, 3}};
    const auto accel = make_sheets(opacities, positions, triangles);
    EXPECT_EQ(accel->transmittance({{0.3f, 0.1f, 0}, {0, 0, 1}}), Vec3(0.75f * 0.5f));
    EXPECT_EQ(accel->transmittance({{0.3f, 0.1f, 0}, {0, 0, 1}, 1.5f}), Vec3(0.75f));
    EXPECT_EQ(accel->transmittance({{0.3f, 0.1f, 4}, {0, 0, -1}, 1.5f}), Vec3(1.0f));
}

TEST(Accel, RaysStopAtASheetAsOftenAsItIsOpaque) {
    const float opacities[] = {0.25f, 0.5f, 1.0f};
    std::vector<std::vector<Vec3>> positions;
    const std::vector<Vec3u> triangles{{0, 1, 2}, {0, 2, 3}};
    const auto accel = make_sheets(opacities, positions, triangles);
    constexpr int count = 40000;
    int stopped[3] = {};
    for (uint32_t seed = 0; seed < count; ++seed) {
        const Hit hit = accel->intersect({{0.3f, 0.1f, 0}, {0, 0, 1}}, seed);
        ASSERT_TRUE(hit.valid());
        ++stopped[hit.surface];
    }
    const double expected[] = {0.25, 0.75 * 0.5, 0.75 * 0.5};
    for (int i = 0; i < 3; ++i) {
        const double p = expected[i];
        EXPECT_NEAR(stopped[i] / static_cast<double>(count), p, 4 * std::sqrt(p * (1 - p) / count)) << "sheet " << i;
    }
}

TEST(Accel, AFullyOpaqueOrClearSheetIsNoMatterOfChance) {
    const float opacities[] = {0.0f, 1.0f, 1.0f};
    std::vector<std::vector<Vec3>> positions;
    const std::vector<Vec3u> triangles{{0, 1, 2}, {0, 2, 3}};
    const auto accel = make_sheets(opacities, positions, triangles);
    for (uint32_t seed = 0; seed < 1000; ++seed)
        ASSERT_EQ(accel->intersect({{0.3f, 0.1f, 0}, {0, 0, 1}}, seed).surface, 1u);
}

TEST(Accel, RaysThatAreNotFiniteHitNothing) {
    Random random;
    const Soup soup(random, 20, 2);
    AccelInput input;
    input.world_geometry = {soup.geometry(0)};
    const auto accel = Accel::build(input);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float bad : {nan, infinity, -infinity}) {
        EXPECT_FALSE(accel->intersect({{bad, 0, 0}, {0, 0, 1}}, 0).valid());
        EXPECT_FALSE(accel->intersect({{0, 0, 0}, {0, bad, 1}}, 0).valid());
        accel->transmittance({{0, bad, 0}, {0, 0, 1}});
        accel->transmittance({{0, 0, 0}, {bad, 0, 1}});
    }
    accel->transmittance({{0, 0, 0}, {0, 0, 1}, nan});
    EXPECT_FALSE(accel->intersect({{0, 0, 0}, {0, 0, 1}, -1}, 0).valid());
}

TEST(Accel, AnEmptySceneIsEmpty) {
    const auto accel = Accel::build({});
    EXPECT_FALSE(accel->intersect({{0, 0, 0}, {0, 0, 1}}, 0).valid());
    EXPECT_EQ(accel->transmittance({{0, 0, 0}, {0, 0, 1}}), Vec3(1));
    EXPECT_TRUE(accel->bounds().empty());
}

TEST(Accel, ACancelledBuildSaysSo) {
    Random random;
    const Soup soup(random, 20000, 0.1f);
    AccelInput input;
    input.world_geometry = {soup.geometry(0)};
    const std::atomic<bool> cancel{true};
    EXPECT_THROW(Accel::build(input, {}, &cancel), AccelError);
}

TEST(Accel, CollapsedTransformsAreNotInstanced) {
    EXPECT_TRUE(can_be_instanced(Mat4(1)));
    EXPECT_FALSE(can_be_instanced(Mat4(0)));
    EXPECT_FALSE(can_be_instanced(Mat4(Vec4(1, 0, 0, 0), Vec4(0, 1, 0, 0), Vec4(0), Vec4(0, 0, 0, 1))));
    EXPECT_FALSE(can_be_instanced(Mat4(std::numeric_limits<float>::quiet_NaN())));
}

}  // namespace
}  // namespace candela
