// SPDX-License-Identifier: MIT
// Interpolation and normal mapping at a hit.
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/world/surface_point.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

// A unit quad facing +z with a normal map of one texel, seen from `eye`.
struct MappedQuad {
    explicit MappedQuad(const Rgba8& texel, const Mat4& world_from_object = Mat4(1)) {
        Scene scene;
        scene.images.emplace_back().pixels = std::make_shared<const ImageRgba8>(1, 1, texel);
        Texture texture;
        texture.image = {0};
        scene.textures.push_back(texture);
        const MaterialId material = test::add_lambert(scene, Vec3(1));
        scene.materials[0].normal.texture = {0};
        scene.materials[0].double_sided = true;
        test::add_object(scene, test::make_quad(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)), material, world_from_object);
        world = test::build(std::move(scene));
    }
    SurfacePoint look(const Vec3& target, const Vec3& direction) const {
        const Hit hit = world->accel->intersect({target - direction, direction, infinity}, 0);
        EXPECT_TRUE(hit.valid());
        return make_surface_point(*world, hit, -direction);
    }
    std::shared_ptr<const World> world;
};

const Vec3 into(0, 0, -1);

TEST(SurfacePoint, NormalMapTiltsAlongUAndAgainstV) {
    // Red is +x of the tangent frame, which follows u; green is up in the picture, which is against glTF's v.
    const float s = std::sqrt(0.5f);
    const auto texel = [](float x, float y, float z) {
        return Rgba8(std::lround((x * 0.5f + 0.5f) * 255), std::lround((y * 0.5f + 0.5f) * 255),
                     std::lround((z * 0.5f + 0.5f) * 255), 255);
    };
    const Vec3 target(0.4f, 0.6f, 0);
    EXPECT_LT(glm::length(MappedQuad(texel(s, 0, s)).look(target, into).shading.normal - Vec3(s, 0, s)), 0.01f);
    EXPECT_LT(glm::length(MappedQuad(texel(0, s, s)).look(target, into).shading.normal - Vec3(0, s, s)), 0.01f);

    // From behind, the whole tilted normal is reversed.
    EXPECT_LT(glm::length(MappedQuad(texel(s, 0, s)).look(target, -into).shading.normal - Vec3(-s, 0, -s)), 0.01f);

    // Mirrored in x: the picture is mirrored with the quad, and so is its relief.
    const Mat4 mirror = glm::scale(Mat4(1), Vec3(-1, 1, 1));
    EXPECT_LT(glm::length(MappedQuad(texel(s, 0, s), mirror).look(Vec3(-0.4f, 0.6f, 0), into).shading.normal -
                          Vec3(-s, 0, s)),
              0.01f);
    EXPECT_LT(
        glm::length(MappedQuad(texel(0, s, s), mirror).look(Vec3(-0.4f, 0.6f, 0), into).shading.normal - Vec3(0, s, s)),
        0.01f);
}

// A sphere that its node stretches and mirrors is an ellipsoid: its normals are along (x/a², y/b², z/c²).
TEST(SurfacePoint, NormalsOfStretchedThingsStandOnThem) {
    for (const Vec3 axes : {Vec3(1, 2, 0.5f), Vec3(-1, 2, 0.5f)}) {
        Scene scene;
        test::add_object(scene, test::make_sphere(Vec3(0), 1, 128, 64), test::add_lambert(scene, Vec3(1)),
                         glm::scale(Mat4(1), axes));
        const auto world = test::build(std::move(scene));
        for (const Vec3 from : {Vec3(0.4f, 1, 3), Vec3(-2, 0.3f, -1.1f), Vec3(0.2f, -3, 0.4f)}) {
            const Vec3 direction = -glm::normalize(from);
            const Hit hit = world->accel->intersect({2.0f * from, direction, infinity}, 0);
            ASSERT_TRUE(hit.valid());
            const SurfacePoint point = make_surface_point(*world, hit, -direction);
            const Vec3 expected = glm::normalize(point.position / (axes * axes));
            EXPECT_GT(glm::dot(point.shading.normal, expected), 0.9995f);
            EXPECT_GT(glm::dot(point.geometric_normal, expected), 0.99f);
        }
    }
}

TEST(SurfacePoint, ShadingNormalNeverFacesAway) {
    const MappedQuad quad(Rgba8(255, 128, 128, 255));  // tilted by 90°
    for (const Vec3 direction : {Vec3(1, 0, -0.2f), Vec3(-1, 0, -0.2f), Vec3(0, 1, -1), Vec3(1, 0, 0.3f)}) {
        const Vec3 d = glm::normalize(direction);
        const SurfacePoint point = quad.look(Vec3(0.5f, 0.5f, 0), d);
        EXPECT_GT(glm::dot(point.shading.normal, -d), 0.0f);
        EXPECT_GT(glm::dot(point.geometric_normal, -d), 0.0f);
        EXPECT_NEAR(glm::length(point.shading.normal), 1.0f, 1e-5f);
    }
}

TEST(SurfacePoint, PositionAndUvAreInterpolated) {
    const MappedQuad quad(Rgba8(128, 128, 255, 255), glm::translate(Mat4(1), Vec3(5, 6, 7)));
    const SurfacePoint point = quad.look(Vec3(5.25f, 6.75f, 7), into);
    EXPECT_LT(glm::length(point.position - Vec3(5.25f, 6.75f, 7)), 1e-5f);
    EXPECT_LT(glm::length(point.uv[0] - Vec2(0.25f, 0.25f)), 1e-5f);
}

}  // namespace
}  // namespace candela
