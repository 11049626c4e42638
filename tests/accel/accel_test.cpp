// SPDX-License-Identifier: MIT
// Hits against brute force, opacity inside the traversal, and rays that are none.
#include "tests/accel/soup.h"

namespace candela {
namespace {

using test::hit_soup;
using test::Random;
using test::Soup;

TEST(Accel, HitsAreThoseOfBruteForce) {
    Random random;
    const Soup world(random, 150, 0.3f), shared(random, 60, 0.2f);
    AccelInput input;
    input.fixed.geometries = {world.geometry()};
    input.fixed_surfaces = {0};
    input.shapes.emplace_back().geometries = {shared.geometry()};
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
    for (uint32_t i = 0; i < 3; ++i) {
        input.fixed.geometries.push_back({std::span(positions[i]).first(4), triangles, true, {}});
        input.fixed_surfaces.push_back(i);
    }
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
    input.fixed.geometries = {soup.geometry()};
    input.fixed_surfaces = {0};
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
    input.fixed.geometries = {soup.geometry()};
    input.fixed_surfaces = {0};
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
