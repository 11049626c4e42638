// SPDX-License-Identifier: MIT
#include "renderer/io/tangents.h"
#include "renderer/scene/deform.h"
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

// A quad that morphs round the y axis, and one whose texture turns: their tangents are those of the morphed shape.
TEST(Tangents, FollowMorphTargets) {
    Primitive quad = test::make_quad(Vec3(0), Vec3(2, 0, 0), Vec3(0, 1, 0));
    quad.normals.assign(4, Vec3(0, 0, 1));
    quad.flat_normals = false;
    Deformation deformation;
    deformation.targets.resize(3);
    deformation.targets[0].positions = {Vec3(0), Vec3(-2, 0, -2), Vec3(-2, 0, -2), Vec3(0)};
    deformation.targets[0].normals.assign(4, Vec3(1, 0, -1));
    deformation.targets[1].uv[0] = {Vec2(0), Vec2(0, -0.5f), Vec2(0, -0.5f), Vec2(0)};
    quad.deformation = std::make_shared<const Deformation>(deformation);
    generate_tangents(quad, 0);
    ASSERT_EQ(quad.positions.size(), 4u);
    EXPECT_TRUE(quad.deformation->targets[2].tangents.empty());

    Mesh mesh;
    mesh.primitives.push_back(quad);
    const auto tangents_at = [&](std::vector<float> weights) {
        return deform(mesh, {std::move(weights), false, {}, Mat4(1)})->primitives[0].tangents;
    };
    for (const Vec4& t : tangents_at({1, 0, 0}))
        EXPECT_LT(glm::distance(t, Vec4(0, 0, -1, 1)), 1e-6f);
    for (const Vec4& t : tangents_at({0.5f, 0, 0}))
        EXPECT_LT(glm::distance(Vec3(t), glm::normalize(Vec3(1, 0, -1))), 1e-6f);
    for (const Vec4& t : tangents_at({0, 0, 1}))
        EXPECT_EQ(t, Vec4(1, 0, 0, 1));
    // The texture sheared by the target, on a mesh that has it so.
    Primitive turned = quad;
    turned.deformation = nullptr;
    for (size_t i = 0; i < 4; ++i)
        turned.uv[0][i] += deformation.targets[1].uv[0][i];
    generate_tangents(turned, 0);
    const std::vector<Vec4> morphed = tangents_at({0, 1, 0});
    for (size_t i = 0; i < 4; ++i)
        EXPECT_LT(glm::distance(Vec3(morphed[i]), Vec3(turned.tangents[i])), 1e-6f);
    EXPECT_GT(glm::distance(Vec3(morphed[0]), Vec3(1, 0, 0)), 0.1f) << "it turned at all";
}

}  // namespace
}  // namespace candela
