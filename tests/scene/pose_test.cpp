// SPDX-License-Identifier: MIT
// Poses of scenes made in code: what moves, what deforms, what stays shared.
#include "renderer/scene/pose.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/scene/animation.h"
#include "renderer/scene/deform.h"

namespace candela {
namespace {

AnimationChannel channel(const char* pointer, std::vector<float> times, std::vector<float> values, uint32_t width) {
    const auto match = find_animated_property(pointer);
    AnimationChannel out;
    out.property = match->property;
    out.object = match->object;
    out.sampler.times_s = std::make_shared<const std::vector<float>>(std::move(times));
    out.sampler.values = std::move(values);
    out.sampler.width = width;
    out.sampler.is_rotation = match->property->is_rotation;
    return out;
}

void animate(Scene& scene, std::vector<AnimationChannel> channels) {
    auto animation = std::make_shared<Animation>();
    animation->channels = std::move(channels);
    scene.animations.push_back(std::move(animation));
}

Primitive triangle() {
    Primitive out;
    out.positions = {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    out.normals.assign(3, Vec3(0, 0, 1));
    out.tangents.assign(3, Vec4(1, 0, 0, 1));
    out.triangles = {Vec3u(0, 1, 2)};
    return out;
}

// Two nodes, the second below the first, each with a mesh of its own.
Scene two_nodes(Primitive first, Primitive second) {
    Scene scene;
    for (Primitive* primitive : {&first, &second}) {
        Mesh mesh;
        mesh.primitives.push_back(std::move(*primitive));
        Node node;
        node.mesh = MeshId{static_cast<uint32_t>(scene.meshes.size())};
        scene.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
        scene.nodes.push_back(node);
    }
    scene.nodes[0].children = {NodeId{1}};
    scene.nodes[1].parent = NodeId{0};
    scene.roots = {NodeId{0}};
    return scene;
}

std::shared_ptr<const Scene> at_rest(Scene scene) {
    mark_moving_nodes(scene);
    pose_scene(scene);
    return std::make_shared<const Scene>(std::move(scene));
}

TEST(Pose, NodesMoveWithTheirChildrenAndMeshesStayShared) {
    Scene scene = two_nodes(triangle(), triangle());
    scene.images.push_back({"i", std::make_shared<const ImageRgba8>(1, 1)});
    scene.nodes[1].translation = Vec3(0, 2, 0);
    scene.nodes[1].parent_from_node = glm::translate(Mat4(1), Vec3(0, 2, 0));
    animate(scene, {channel("/nodes/0/translation", {0, 2}, {0, 0, 0, 10, 0, 0}, 3)});
    animate(scene, {channel("/nodes/1/scale", {0, 2}, {1, 1, 1, 3, 1, 1}, 3)});
    const auto rest = at_rest(std::move(scene));
    const auto posed = posed_scene(rest, 0, 0.5f);
    EXPECT_EQ(Vec3(posed->instances.at(0).world_from_object[3]), Vec3(2.5f, 0, 0));
    EXPECT_EQ(Vec3(posed->instances.at(1).world_from_object[3]), Vec3(2.5f, 2, 0));
    EXPECT_EQ(posed->meshes[0], rest->meshes[0]);
    EXPECT_EQ(posed->images[0].pixels, rest->images[0].pixels);
    EXPECT_EQ(Vec3(rest->instances.at(0).world_from_object[3]), Vec3(0)) << "rest must stay";
    // The other animation leaves the first node at rest.
    const auto scaled = posed_scene(rest, 1, 1.0f);
    EXPECT_EQ(scaled->instances[0].world_from_object, rest->instances[0].world_from_object);
    EXPECT_EQ(Vec3(scaled->instances[1].world_from_object[0]), Vec3(2, 0, 0));
    EXPECT_EQ(Vec3(scaled->instances[1].world_from_object[3]), Vec3(0, 2, 0)) << "translation must stay";
}

TEST(Pose, OnlyWhatAnAnimationReachesMoves) {
    Scene scene = two_nodes(triangle(), triangle());
    animate(scene, {channel("/nodes/1/rotation", {0}, {0, 0, 0, 1}, 4)});
    const auto rest = at_rest(std::move(scene));
    EXPECT_FALSE(rest->instances.at(0).moves);
    EXPECT_TRUE(rest->instances.at(1).moves);
    EXPECT_FALSE(rest->instances[1].deforms);
    // What moves the first moves the second, which hangs from it.
    Scene both = two_nodes(triangle(), triangle());
    animate(both, {channel("/nodes/0/rotation", {0}, {0, 0, 0, 1}, 4)});
    const auto moving = at_rest(std::move(both));
    EXPECT_TRUE(moving->instances.at(0).moves);
    EXPECT_TRUE(moving->instances.at(1).moves);
}

TEST(Pose, HiddenNodesHideWhatHangsFromThem) {
    Scene scene = two_nodes(triangle(), triangle());
    animate(scene, {channel("/nodes/0/extensions/KHR_node_visibility/visible", {0, 1}, {1, 0}, 1)});
    scene.nodes[1].visible = false;
    const auto rest = at_rest(std::move(scene));
    EXPECT_EQ(posed_scene(rest, 0, 0.0f)->instances.size(), 1u);
    EXPECT_EQ(posed_scene(rest, 0, 1.0f)->instances.size(), 0u);
}

TEST(Pose, MorphTargetsBlendAndUnitNormalsStayUnit) {
    Primitive primitive = triangle();
    Deformation deformation;
    deformation.targets.resize(2);
    deformation.targets[0].positions = {Vec3(0, 0, 1), Vec3(0), Vec3(0)};
    deformation.targets[1].normals = {Vec3(3, 0, -1), Vec3(0), Vec3(0)};
    primitive.deformation = std::make_shared<const Deformation>(std::move(deformation));
    Scene scene = two_nodes(std::move(primitive), triangle());
    scene.nodes[0].morph_weights = {0, 0};
    animate(scene, {channel("/nodes/0/weights", {0, 1}, {0, 0, 0.5f, 1}, 2)});
    const auto rest = at_rest(std::move(scene));
    ASSERT_EQ(rest->posed_mesh_count, 1u);
    EXPECT_TRUE(rest->instances[0].deforms && rest->instances[0].moves);
    EXPECT_EQ(rest->meshes[2], rest->meshes[0]) << "without weights it is the mesh as modelled";
    const auto posed = posed_scene(rest, 0, 1.0f);
    const Primitive& shape = posed->mesh(posed->instances[0].mesh).primitives[0];
    EXPECT_EQ(shape.positions[0], Vec3(0, 0, 0.5f));
    EXPECT_EQ(shape.positions[1], Vec3(1, 0, 0));
    EXPECT_NEAR(glm::distance(shape.normals[0], Vec3(1, 0, 0)), 0, 1e-6f);
    EXPECT_EQ(posed->instances[1].mesh.value, 1u);
    EXPECT_EQ(unique_triangle_count(*posed), 2u);
    // The same weights again: the same mesh.
    EXPECT_EQ(posed_scene(posed, 0, 5.0f)->meshes[2], posed->meshes[2]);
}

TEST(Pose, MorphTargetsMoveTextureCoordinatesAndColoursInTheirRange) {
    Primitive primitive = triangle();
    primitive.uv[0] = primitive.uv[1] = {Vec2(0), Vec2(1, 0), Vec2(0, 1)};
    primitive.colors = {Vec4(0.5f), Vec4(1), Vec4(0.25f)};
    Deformation deformation;
    deformation.targets.resize(2);
    deformation.targets[0].uv[1] = {Vec2(2, 4), Vec2(0), Vec2(0)};
    deformation.targets[1].uv[0] = {Vec2(0), Vec2(0), Vec2(0.5f, -1)};
    deformation.targets[1].colors = {Vec4(-1, 1, 0.25f, 0), Vec4(0, 0, 0, -0.5f), Vec4(0)};
    primitive.deformation = std::make_shared<const Deformation>(std::move(deformation));
    Scene scene = two_nodes(std::move(primitive), triangle());
    scene.nodes[0].morph_weights = {0, 0};
    animate(scene, {channel("/nodes/0/weights", {0, 1}, {0, 0, 0.5f, 1}, 2)});
    const auto rest = at_rest(std::move(scene));
    const auto posed = posed_scene(rest, 0, 1.0f);
    const Primitive& shape = posed->mesh(posed->instances[0].mesh).primitives[0];
    EXPECT_EQ(shape.uv[1][0], Vec2(1, 2));
    EXPECT_EQ(shape.uv[1][1], Vec2(1, 0));
    EXPECT_EQ(shape.uv[0][2], Vec2(0.5f, 0));
    EXPECT_EQ(shape.colors[0], Vec4(0, 1, 0.75f, 0.5f));
    EXPECT_EQ(shape.colors[1], Vec4(1, 1, 1, 0.5f));
    EXPECT_EQ(shape.colors[2], Vec4(0.25f));
}

// A triangle on one joint, whose own node's transform must not matter.
Scene skinned_triangle(const Mat4& world_from_joint, const Mat4& joint_from_mesh) {
    Primitive primitive = triangle();
    Deformation deformation;
    deformation.influences_per_vertex = 4;
    deformation.joints.assign(12, 0);
    deformation.weights.assign(12, 0.0f);
    for (size_t i = 0; i < 12; i += 4)
        deformation.weights[i] = 1.0f;
    deformation.joint_count = 1;
    primitive.deformation = std::make_shared<const Deformation>(std::move(deformation));
    Scene scene = two_nodes(std::move(primitive), triangle());
    scene.nodes[1].mesh = {};
    scene.nodes[1].parent = {};
    scene.nodes[1].parent_from_node = world_from_joint;
    scene.nodes[0].children.clear();
    scene.nodes[0].parent_from_node = glm::translate(Mat4(1), Vec3(100));
    scene.nodes[0].skin = SkinId{0};
    scene.roots = {NodeId{0}, NodeId{1}};
    Skin skin;
    skin.joints = {NodeId{1}};
    skin.joint_from_mesh = {joint_from_mesh};
    scene.skins.push_back(std::make_shared<const Skin>(std::move(skin)));
    return scene;
}

TEST(Pose, JointsCarryVerticesToTheWorldWhateverTheirNodeDoes) {
    const Mat4 joint = glm::translate(Mat4(1), Vec3(5, 0, 0)) * glm::rotate(Mat4(1), pi / 2, Vec3(0, 1, 0)) *
                       glm::scale(Mat4(1), Vec3(1, 1, 2));
    const auto rest = at_rest(skinned_triangle(joint, glm::translate(Mat4(1), Vec3(0, 0, 3))));
    const Instance& instance = rest->instances.at(0);
    EXPECT_EQ(instance.world_from_object, Mat4(1.0f));
    EXPECT_TRUE(instance.deforms);
    EXPECT_FALSE(instance.moves) << "nothing is animated";
    const Primitive& shape = rest->mesh(instance.mesh).primitives[0];
    // z = 3, stretched to 6, turned to x.
    EXPECT_NEAR(glm::distance(shape.positions[0], Vec3(11, 0, 0)), 0, 1e-5f);
    EXPECT_NEAR(glm::distance(shape.positions[1], Vec3(11, 0, -1)), 0, 1e-5f);
    EXPECT_NEAR(glm::distance(shape.normals[0], Vec3(1, 0, 0)), 0, 1e-6f);
    EXPECT_NEAR(glm::distance(Vec3(shape.tangents[0]), Vec3(0, 0, -1)), 0, 1e-6f);
    EXPECT_EQ(shape.triangles[0], Vec3u(0, 1, 2));
}

TEST(Pose, NormalsOfStretchedSkinsFollowTheInverseTranspose) {
    Scene scene = skinned_triangle(glm::scale(Mat4(1), Vec3(1, 1, 4)), Mat4(1));
    Mesh mesh = *scene.meshes[0];
    mesh.primitives[0].normals.assign(3, glm::normalize(Vec3(0, 1, 1)));
    scene.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));
    const auto rest = at_rest(std::move(scene));
    const Primitive& shape = rest->mesh(rest->instances.at(0).mesh).primitives[0];
    EXPECT_NEAR(glm::distance(shape.normals[0], glm::normalize(Vec3(0, 4, 1))), 0, 1e-6f);
}

TEST(Pose, MirroredSkinsTurnTheirTrianglesOver) {
    const auto rest = at_rest(skinned_triangle(glm::scale(Mat4(1), Vec3(-1, 1, 1)), Mat4(1)));
    const Primitive& shape = rest->mesh(rest->instances.at(0).mesh).primitives[0];
    const Vec3u t = shape.triangles[0];
    const Vec3 geometric =
        glm::cross(shape.positions[t.y] - shape.positions[t.x], shape.positions[t.z] - shape.positions[t.x]);
    EXPECT_GT(geometric.z, 0) << "the front stays in front";
    EXPECT_EQ(shape.normals[0], Vec3(0, 0, 1));
    EXPECT_EQ(shape.tangents[0], Vec4(-1, 0, 0, -1)) << "the bitangent stays";
}

TEST(Pose, WhatIsNotFiniteIsLeftOutAndSaid) {
    Scene scene = skinned_triangle(Mat4(1), Mat4(1));
    animate(scene, {channel("/nodes/1/translation", {0}, {1e30f, 0, 0}, 3)});
    const auto rest = at_rest(std::move(scene));
    EXPECT_TRUE(rest->instances.at(0).moves);
    std::vector<NodeId> left_out;
    EXPECT_TRUE(posed_scene(rest, 0, 0, &left_out)->instances.empty());
    EXPECT_EQ(left_out, std::vector{NodeId{0}});
}

TEST(Pose, MaterialsLightsAndCamerasAreDriven) {
    Scene scene = two_nodes(triangle(), triangle());
    scene.materials.resize(1);
    scene.lights.resize(1);
    scene.file_cameras.resize(1);
    scene.nodes[1].camera = CameraId{0};
    scene.nodes[1].light = LightId{0};
    scene.animated_uvs.push_back({MaterialId{0}, 2, {{0.25, 0}, 0, {1, 1}}});
    animate(scene, {channel("/materials/0/pbrMetallicRoughness/baseColorFactor", {0}, {0.5f, 2, -1, 0.25f}, 4),
                    channel("/materials/0/extensions/KHR_materials_volume/attenuationDistance", {0}, {0}, 1),
                    channel("/materials/0/extensions/KHR_materials_sheen/sheenRoughnessFactor", {0}, {0.75f}, 1),
                    channel("/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle", {0}, {1.0f}, 1),
                    channel("/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", {0}, {0.5f}, 1),
                    channel("/cameras/0/perspective/yfov", {0}, {0.3f}, 1),
                    channel("/nodes/1/translation", {0}, {0, 0, 7}, 3)});
    AnimationChannel turn =
        channel("/materials/0/normalTexture/extensions/KHR_texture_transform/rotation", {0}, {pi / 2}, 1);
    turn.object = 0;
    Animation with_turn = *scene.animations[0];
    with_turn.channels.push_back(turn);
    scene.animations[0] = std::make_shared<const Animation>(std::move(with_turn));
    const auto rest = at_rest(std::move(scene));
    const auto posed = posed_scene(rest, 0, 0);
    const Material& material = posed->materials[0];
    EXPECT_EQ(material.base_color_factor, Vec4(0.5f, 1, 0, 0.25f));
    EXPECT_EQ(material.volume.attenuation_distance_m, infinity);
    EXPECT_EQ(material.sheen.roughness_factor, 0.75f);
    EXPECT_EQ(posed->lights[0].inner_cone_radians, 0.5f);
    EXPECT_EQ(posed->cameras.at(0).camera.yfov_radians, 0.3f);
    EXPECT_EQ(posed->cameras[0].camera.position(), Vec3(0, 0, 7));
    EXPECT_EQ(Vec3(posed->light_instances.at(0).world_from_light[3]), Vec3(0, 0, 7));
    // (1, 0) turns to (0, -1), then moves by the file's own offset.
    const Vec2 uv = material.normal.uv_transform * Vec3(1, 0, 1);
    EXPECT_NEAR(glm::distance(uv, Vec2(0.25f, -1)), 0, 1e-6f);
}

}  // namespace
}  // namespace candela
