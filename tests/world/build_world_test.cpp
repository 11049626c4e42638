// SPDX-License-Identifier: MIT
// Placement: what becomes world-space geometry, what shares a BVH, what is dropped, and who emits.
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/world/placement.h"
#include "renderer/world/shaded_material.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

using test::add_emitter;
using test::add_lambert;
using test::add_object;
using test::make_quad;

Hit shoot(const World& world, const Vec3& origin, const Vec3& direction) {
    return world.accel->intersect({origin, glm::normalize(direction), infinity}, 0);
}

void place_again(Scene& scene, const Mat4& world_from_object) {
    scene.instances.push_back({scene.instances[0].mesh, scene.instances[0].node, world_from_object});
}

TEST(ClassifyTransform, SeparatesUsableFlatAndUnusable) {
    EXPECT_EQ(classify_transform(Mat4(1)), TransformKind::invertible);
    EXPECT_EQ(classify_transform(glm::scale(Mat4(1), Vec3(-1, 2, 3))), TransformKind::invertible);
    EXPECT_EQ(classify_transform(glm::scale(Mat4(1), Vec3(1e-6f))), TransformKind::invertible);
    EXPECT_EQ(classify_transform(glm::scale(Mat4(1), Vec3(1, 0, 1))), TransformKind::flat);
    EXPECT_EQ(classify_transform(glm::scale(Mat4(1), Vec3(1, 0, 0))), TransformKind::unusable);
    EXPECT_EQ(classify_transform(glm::scale(Mat4(1), Vec3(0))), TransformKind::unusable);
    Mat4 bad(1);
    bad[3][0] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(classify_transform(bad), TransformKind::unusable);
}

// Where room was left behind them for what the accelerator reads past the last one.
TEST(BuildWorld, PositionsThatNothingMovesAreTraversedWhereTheyLie) {
    const auto surface_of = [](bool room, const Mat4& world_from_object) {
        Scene scene;
        Primitive sphere = test::make_sphere(Vec3(0), 1, 24, 12);
        std::vector<Vec3> positions;
        positions.reserve(sphere.positions.size() + (room ? position_padding : 0));
        positions.assign(sphere.positions.begin(), sphere.positions.end());
        sphere.positions = std::move(positions);
        add_object(scene, std::move(sphere), add_lambert(scene, Vec3(0.5f)), world_from_object);
        const auto world = test::build(std::move(scene));
        const Hit hit = shoot(*world, Vec3(0.1f, 0.2f, 9), Vec3(0, 0, -1));
        EXPECT_NEAR(hit.distance, 9 - std::sqrt(0.95f), 0.02f);
        const Surface& surface = world->surfaces[0];
        return surface.positions == surface.primitive->positions.data();
    };
    EXPECT_TRUE(surface_of(true, Mat4(1)));
    EXPECT_FALSE(surface_of(false, Mat4(1)));
    EXPECT_FALSE(surface_of(true, glm::rotate(Mat4(1), 0.1f, Vec3(0, 0, 1))));
}

TEST(BuildWorld, SharedAndSinglePlacementGiveTheSameSurface) {
    const Mat4 placed = glm::translate(Mat4(1), Vec3(3, 1, -2)) * glm::rotate(Mat4(1), 0.7f, Vec3(1, 2, 3)) *
                        glm::scale(Mat4(1), Vec3(1.5f, -0.5f, 2.0f));
    const auto make = [&](bool twice) {
        Scene scene;
        add_object(scene, test::make_sphere(Vec3(0), 1, 24, 12), add_lambert(scene, Vec3(0.5f)), placed);
        if (twice) place_again(scene, glm::translate(Mat4(1), Vec3(1000, 0, 0)));
        return test::build(std::move(scene));
    };
    const auto single = make(false);
    const auto shared = make(true);
    ASSERT_TRUE(single->surfaces[0].positions_in_world);
    ASSERT_FALSE(shared->surfaces[0].positions_in_world);
    for (int i = 0; i < 200; ++i) {
        const float angle = 0.0314f * static_cast<float>(i);
        const Vec3 target =
            Vec3(placed[3]) + 0.3f * Vec3(std::cos(7 * angle), std::sin(5 * angle), std::cos(3 * angle));
        const Vec3 eye = Vec3(placed[3]) + 6.0f * Vec3(std::cos(angle), std::sin(2 * angle), std::sin(angle));
        const Vec3 direction = glm::normalize(target - eye);
        const Hit a = shoot(*single, eye, direction);
        const Hit b = shoot(*shared, eye, direction);
        ASSERT_EQ(a.valid(), b.valid());
        if (!a.valid()) continue;
        const SurfacePoint pa = make_surface_point(*single, a, -direction);
        const SurfacePoint pb = make_surface_point(*shared, b, -direction);
        EXPECT_LT(glm::length(pa.position - pb.position), 1e-4f);
        EXPECT_GT(glm::dot(pa.shading.normal, pb.shading.normal), 0.9999f);
        EXPECT_EQ(pa.front_face, pb.front_face);
        EXPECT_TRUE(pa.front_face) << "an outside view of a mirrored closed mesh must see fronts";
    }
}

TEST(BuildWorld, FlatTransformStaysVisibleAndUnusableIsDropped) {
    Scene scene;
    add_object(scene, test::make_sphere(Vec3(0), 1, 24, 12), add_lambert(scene, Vec3(0.5f)),
               glm::scale(Mat4(1), Vec3(1, 0, 1)));
    place_again(scene, glm::translate(Mat4(1), Vec3(10, 0, 0)) * glm::scale(Mat4(1), Vec3(1, 0, 0)));
    const auto world = test::build(std::move(scene));
    EXPECT_EQ(world->warnings.size(), 1u);
    const Hit hit = shoot(*world, Vec3(0.1f, 5, 0.1f), Vec3(0, -1, 0));
    ASSERT_TRUE(hit.valid());
    const SurfacePoint point = make_surface_point(*world, hit, Vec3(0, 1, 0));
    EXPECT_NEAR(point.geometric_normal.y, 1.0f, 1e-6f);
    EXPECT_FALSE(shoot(*world, Vec3(10, 5, 0), Vec3(0, -1, 0)).valid());
}

// What single precision cannot invert is no instance: it is moved to world space, or left out where that is no better.
TEST(BuildWorld, PlacesBeyondReachOfInstancesDoNotStopTheWorld) {
    Scene scene;
    add_object(scene, test::make_sphere(Vec3(0), 1, 24, 12), add_lambert(scene, Vec3(0.5f)));
    place_again(scene, glm::translate(Mat4(1), Vec3(1e16f, 0, 0)) * glm::scale(Mat4(1), Vec3(1e-4f)));
    EXPECT_EQ(classify_transform(scene.instances.back().world_from_object), TransformKind::flat);
    EXPECT_EQ(test::build(scene)->warnings.size(), 0u);
    place_again(scene, glm::translate(Mat4(1), Vec3(0, -3e38f, 0)));
    EXPECT_EQ(classify_transform(scene.instances.back().world_from_object), TransformKind::unusable);
    place_again(scene, glm::scale(Mat4(1), Vec3(1e-13f)));
    const auto world = test::build(std::move(scene));
    EXPECT_EQ(world->warnings.size(), 1u);
    EXPECT_TRUE(shoot(*world, Vec3(0.1f, 5, 0.1f), Vec3(0, -1, 0)).valid());
}

TEST(BuildWorld, EmissiveTrianglesLieOnTheirSurfaceAndFaceItsFront) {
    // A quad facing -y whose transform mirrors: the front stays where glTF's winding rule says.
    Scene scene;
    const MaterialId emitter = add_emitter(scene, Vec3(2, 3, 4));
    add_object(scene, make_quad(Vec3(0), Vec3(1, 0, 0), Vec3(0, 0, 1)), emitter, glm::scale(Mat4(1), Vec3(2, 1, -1)));
    const auto world = test::build(std::move(scene));
    ASSERT_EQ(world->lights.triangles.size(), 2u);
    float area = 0;
    for (const EmissiveTriangle& light : world->lights.triangles) {
        const Vec3 normal = glm::cross(light.edge1, light.edge2);
        area += 0.5f * glm::length(normal);
        const Vec3 center = light.p0 + (light.edge1 + light.edge2) / 3.0f;
        const Vec3 toward_front = glm::normalize(normal);
        const Hit hit = shoot(*world, center + toward_front, -toward_front);
        ASSERT_TRUE(hit.valid());
        const SurfacePoint point = make_surface_point(*world, hit, toward_front);
        EXPECT_TRUE(point.front_face);
        EXPECT_EQ(shade_material(*world, point, toward_front).emission, Vec3(2, 3, 4));
        const SurfacePoint behind =
            make_surface_point(*world, shoot(*world, center - toward_front, toward_front), -toward_front);
        EXPECT_EQ(shade_material(*world, behind, -toward_front).emission, Vec3(0));
    }
    EXPECT_NEAR(area, 2.0f, 1e-5f);
}

TEST(BuildWorld, EnvironmentChangesWithoutBuildingAgain) {
    Scene scene;
    add_object(scene, make_quad(Vec3(0), Vec3(1, 0, 0), Vec3(0, 0, -1)), add_lambert(scene, Vec3(0.5f)));
    auto world = test::build(std::move(scene));
    const auto changed = with_environment(world, test::constant_environment(Vec3(3)));
    const auto again = with_environment(changed, std::nullopt);
    EXPECT_EQ(changed->accel->fixed_tree(), world->accel->fixed_tree());
    EXPECT_EQ(changed->accel->work().trees_built, 0u);
    ASSERT_TRUE(changed->lights.environment);
    EXPECT_EQ(changed->lights.environment->radiance(Vec3(0, 1, 0)), Vec3(3));
    EXPECT_FALSE(again->lights.environment);
    const std::weak_ptr<const World> first = world;
    world.reset();
    EXPECT_TRUE(first.expired()) << "worlds must not keep their predecessors";
    EXPECT_TRUE(shoot(*again, Vec3(0.3f, 1, -0.3f), Vec3(0, -1, 0)).valid());
}

TEST(SurfaceOpacity, MaskAndBlendFollowTheSpecification) {
    Scene scene;
    const MaterialId mask = add_lambert(scene, Vec3(1));
    scene.materials[mask.value].alpha_mode = AlphaMode::mask;
    scene.materials[mask.value].alpha_cutoff = 0.5f;
    scene.materials[mask.value].base_color_factor.a = 0.8f;
    const MaterialId blend = add_lambert(scene, Vec3(1));
    scene.materials[blend.value].alpha_mode = AlphaMode::blend;
    scene.materials[blend.value].base_color_factor.a = 0.25f;
    Primitive quad = make_quad(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0));
    quad.colors = {Vec4(1, 1, 1, 1), Vec4(1, 1, 1, 0), Vec4(1, 1, 1, 0), Vec4(1, 1, 1, 1)};
    add_object(scene, quad, mask);
    add_object(scene, make_quad(Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, 1, 0)), blend);
    const auto world = test::build(std::move(scene));

    EXPECT_EQ(surface_opacity(*world, 0, 0, 0.0f, 0.0f), 1.0f);
    EXPECT_EQ(surface_opacity(*world, 0, 0, 1.0f, 0.0f), 0.0f);
    EXPECT_EQ(surface_opacity(*world, 1, 0, 0.3f, 0.3f), 0.25f);
    // Left half of the card blocks, right half lets through to the sheet that blocks a quarter.
    const Ray left{Vec3(0.1f, 0.5f, 1), Vec3(0, 0, -1), infinity};
    const Ray right{Vec3(0.9f, 0.5f, 1), Vec3(0, 0, -1), infinity};
    EXPECT_EQ(world->accel->transmittance(left), Vec3(0));
    EXPECT_EQ(world->accel->transmittance(right), Vec3(0.75f));
}

}  // namespace
}  // namespace candela
