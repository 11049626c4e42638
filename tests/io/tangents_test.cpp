// SPDX-License-Identifier: MIT
#include "renderer/io/tangents.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

TEST(Tangents, FollowUAndPointUpThePicture) {
    Primitive quad = test::make_quad(Vec3(0), Vec3(2, 0, 0), Vec3(0, 1, 0));
    quad.normals.assign(4, Vec3(0, 0, 1));
    quad.flat_normals = false;
    generate_tangents(quad, 0);
    ASSERT_EQ(quad.tangents.size(), 4u);
    for (const Vec4& t : quad.tangents)
        EXPECT_EQ(t, Vec4(1, 0, 0, 1));
}

TEST(Tangents, MirroredTextureSplitsSharedVertices) {
    // Two triangles share an edge, but the texture of the second is mirrored.
    Primitive p;
    p.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0)};
    p.normals.assign(4, Vec3(0, 0, 1));
    p.uv[0] = {Vec2(0, 1), Vec2(1, 1), Vec2(0, 0), Vec2(1, 1)};
    p.triangles = {Vec3u(0, 1, 2), Vec3u(0, 2, 3)};
    generate_tangents(p, 0);
    EXPECT_EQ(p.positions.size(), 6u);
    EXPECT_EQ(p.tangents[p.triangles[0].x], Vec4(1, 0, 0, 1));
    EXPECT_EQ(p.tangents[p.triangles[1].x], Vec4(-1, 0, 0, -1));
}

TEST(Tangents, DegenerateTextureStillGivesFrames) {
    Primitive quad = test::make_quad(Vec3(0), Vec3(2, 0, 0), Vec3(0, 1, 0));
    quad.normals.assign(4, Vec3(0, 0, 1));
    quad.uv[0].assign(4, Vec2(0.5f));
    generate_tangents(quad, 0);
    for (const Vec4& t : quad.tangents)
        EXPECT_NEAR(glm::dot(Vec3(t), Vec3(0, 0, 1)), 0, 1e-6);
}

}  // namespace
}  // namespace candela
