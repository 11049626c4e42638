// SPDX-License-Identifier: MIT
// A world made from another pose's looks as one made from nothing, to the bit, and makes only what moved.
#include <thread>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/integrator/integrator.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

using namespace test;

constexpr uint32_t room_instances = 2, ball = 2, lamp = 3, pane = 4, body = 5, twin = 6, sheet = 7;

Scene moving_scene() {
    Scene scene;
    SceneImage image;
    ImageRgba8 texels(8, 8, Rgba8{0, 0, 0, 255});
    texels(5, 2) = Rgba8{255, 255, 255, 255};
    image.pixels = std::make_shared<const ImageRgba8>(std::move(texels));
    scene.images.push_back(image);
    Texture texture;
    texture.image = {0};
    scene.textures.push_back(texture);

    const MaterialId white = add_lambert(scene, Vec3(0.7f));
    add_object(scene, make_quad(Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4)), white);
    add_object(scene, make_quad(Vec3(-2, 0, -2), Vec3(4, 0, 0), Vec3(0, 4, 0)), white);
    add_object(scene, make_sphere(Vec3(0), 0.5f, 24, 12), add_lambert(scene, Vec3(0.8f, 0.3f, 0.2f)));
    const MaterialId shining = add_emitter(scene, Vec3(1), Vec3(0), true);
    scene.materials[shining.value].emissive_strength = 200;
    scene.materials[shining.value].emissive.texture = {0};
    add_object(scene, make_quad(Vec3(-0.5f, 0, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1)), shining);
    const MaterialId card = add_lambert(scene, Vec3(0.2f, 0.9f, 0.3f));
    scene.materials[card.value].alpha_mode = AlphaMode::blend;
    scene.materials[card.value].base_color_factor.a = 0.5f;
    add_object(scene, make_quad(Vec3(-0.5f, -0.5f, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)), card);
    Material glass;
    glass.metallic_factor = 0;
    glass.roughness_factor = 0;
    glass.transmission.factor = 1;
    glass.volume.thickness_factor = 1;
    scene.materials.push_back(glass);
    add_object(scene, make_sphere(Vec3(0), 0.4f, 24, 12), {static_cast<uint32_t>(scene.materials.size() - 1)});
    scene.instances.push_back(scene.instances[ball]);
    add_object(scene, make_quad(Vec3(-0.4f, -0.4f, 0), Vec3(0.8f, 0, 0), Vec3(0, 0.8f, 0)), white);
    scene.environment = constant_environment(Vec3(0.2f, 0.3f, 0.4f));
    PunctualLight point;
    point.intensity = 3;
    scene.lights.push_back(point);
    scene.light_instances.push_back({{0}, {0}, Mat4(1)});
    for (uint32_t i = room_instances; i < scene.instances.size(); ++i)
        scene.instances[i].moves = true;
    scene.instances[body].deforms = true;
    return scene;
}

// The scene at a time: things move, the body bends, the sheet collapses to a line's thickness at t = 2.
std::shared_ptr<const Scene> at(const Scene& rest, float t) {
    auto scene = std::make_shared<Scene>(rest);
    const auto moved = [&](uint32_t i, const Vec3& to, float angle) {
        scene->instances[i].world_from_object = glm::rotate(glm::translate(Mat4(1), to), angle, Vec3(0, 1, 0.3f));
    };
    moved(ball, Vec3(-0.9f + 0.2f * t, 0.5f, 0.1f * t), t);
    moved(twin, Vec3(1.2f, 0.6f + 0.1f * t, -0.5f), 2 * t);
    moved(lamp, Vec3(0.1f * t, 2.5f, 0), 0.2f * t);
    moved(pane, Vec3(0.4f, 0.7f, 1.0f + 0.1f * t), 0.3f * t);
    moved(body, Vec3(0.3f, 0.6f, 0.2f), 0.5f);
    moved(sheet, Vec3(-1.2f, 1.4f, 0), 0.4f * t);
    if (t == 2) scene->instances[sheet].world_from_object[2] = Vec4(0);
    scene->light_instances[0].world_from_light = glm::translate(Mat4(1), Vec3(1, 2 + 0.1f * t, 1));
    Mesh bent = rest.mesh(rest.instances[body].mesh);
    for (Vec3& p : bent.primitives[0].positions)
        p.x += 0.4f * t * p.y * p.y;
    scene->meshes.push_back(std::make_shared<const Mesh>(std::move(bent)));
    scene->posed_mesh_count = 1;
    scene->instances[body].mesh = {static_cast<uint32_t>(scene->meshes.size() - 1)};
    return scene;
}

std::vector<Vec3> picture(const World& world) {
    View view;
    view.camera.world_from_camera = look_at(Vec3(0, 1.5f, 5), Vec3(0, 1.2f, 0), Vec3(0, 1, 0));
    view.extent = Vec2u(40, 30);
    std::vector<Vec3> out;
    RayCounts counts;
    for (uint16_t y = 0; y < view.extent.y; ++y) {
        for (uint16_t x = 0; x < view.extent.x; ++x) {
            for (uint32_t i = 0; i < 2; ++i)
                out.push_back(trace_sample(world, view, {}, {x, y, i}, counts).radiance);
        }
    }
    return out;
}

TEST(Pose, IsTheWorldMadeFromNothingToTheBit) {
    const Scene rest = moving_scene();
    std::shared_ptr<const World> world = build_world(at(rest, 0));
    for (const float t : {0.5f, 2.0f, 2.0f, -1.0f, 1.0f}) {
        world = with_pose(world, at(rest, t));
        const std::vector<Vec3> posed = picture(*world);
        EXPECT_EQ(posed, picture(*build_world(at(rest, t)))) << "at " << t;
        EXPECT_NE(posed, picture(*build_world(at(rest, t + 0.1f))));
        EXPECT_EQ(world->lights.triangles.size(), build_world(at(rest, t))->lights.triangles.size());
    }
}

// A body of two parts that both vanish in a point, wholly or for some triangles, and come back.
TEST(Pose, WhatVanishesInAPointComesBack) {
    Scene rest = moving_scene();
    Mesh two_parts = rest.mesh(rest.instances[body].mesh);
    two_parts.primitives.push_back(two_parts.primitives[0]);
    for (Vec3& p : two_parts.primitives[1].positions)
        p += Vec3(0.3f, 0.8f, 0);
    rest.meshes[rest.instances[body].mesh.value] = std::make_shared<const Mesh>(two_parts);
    const auto with_share = [&](size_t vanished) {
        auto scene = std::make_shared<Scene>(*at(rest, 1));
        Mesh mesh = two_parts;
        for (Primitive& primitive : mesh.primitives) {
            for (size_t i = 0; i < primitive.positions.size() * vanished / 2; ++i)
                primitive.positions[i] = Vec3(0.1f);
        }
        scene->meshes.back() = std::make_shared<const Mesh>(std::move(mesh));
        return scene;
    };
    std::shared_ptr<const World> world = build_world(with_share(0));
    EXPECT_EQ(world->accel->work().trees_refitted, 1u);
    for (const size_t vanished : {1u, 2u, 0u}) {
        const auto scene = with_share(vanished);
        world = with_pose(world, scene);
        EXPECT_EQ(picture(*world), picture(*build_world(scene))) << vanished;
        EXPECT_EQ(world->accel->work().trees_refitted, vanished == 0 ? 1u : 0u);
    }
}

TEST(Pose, MakesOnlyWhatMoved) {
    const Scene rest = moving_scene();
    const auto first = build_world(at(rest, 0));
    // The room, the ball and its twin, the lamp, the card, the body, the sheet.
    EXPECT_EQ(first->accel->work().trees_built, 6u);
    auto second = with_pose(first, at(rest, 1));
    EXPECT_EQ(second->accel->work().trees_built, 1u) << "a second copy of the body, for the first is in use";
    EXPECT_EQ(second->accel->work().trees_shared, 5u);
    const auto third = with_pose(second, at(rest, 0.5f));
    EXPECT_EQ(third->accel->work().trees_built, 1u);
    second.reset();
    auto fourth = with_pose(third, at(rest, 0.9f));
    EXPECT_EQ(fourth->accel->work().trees_built, 0u);
    EXPECT_EQ(fourth->accel->work().trees_refitted, 1u);
    EXPECT_EQ(fourth->accel->fixed_tree(), first->accel->fixed_tree());

    // What collapses to a sheet is made anew, in the world instead of placed there; its own tree waits.
    fourth.reset();
    const auto flat = with_pose(third, at(rest, 2));
    EXPECT_EQ(flat->accel->work().trees_built, 1u);
    fourth = with_pose(flat, at(rest, 2.1f));
    fourth.reset();
    fourth = with_pose(flat, at(rest, 2.2f));
    EXPECT_EQ(fourth->accel->work().trees_built, 0u);
}

TEST(Pose, MaterialsLightsAndCamerasAloneTouchNoTree) {
    const Scene rest = moving_scene();
    const auto world = build_world(at(rest, 1));
    auto changed = std::make_shared<Scene>(*world->scene);
    changed->materials[0].base_color_factor = Vec4(1, 0, 0, 1);
    changed->lights[0].intensity = 30;
    const auto other = with_pose(world, changed);
    EXPECT_EQ(other->accel->work().trees_built + other->accel->work().trees_refitted, 0u);
    EXPECT_FALSE(other->accel->work().placement_built);
    EXPECT_EQ(picture(*other), picture(*build_world(changed)));
    EXPECT_NE(picture(*other), picture(*world));
}

TEST(Pose, MaterialsThatTurnTransparentAreSeenThrough) {
    const Scene rest = moving_scene();
    const auto world = build_world(at(rest, 1));
    auto changed = std::make_shared<Scene>(*world->scene);
    changed->materials[changed->mesh(changed->instances[ball].mesh).primitives[0].material.value].alpha_mode =
        AlphaMode::blend;
    changed->materials[changed->mesh(changed->instances[ball].mesh).primitives[0].material.value].base_color_factor.a =
        0.2f;
    const auto other = with_pose(world, changed);
    EXPECT_EQ(picture(*other), picture(*build_world(changed)));
    EXPECT_NE(picture(*other), picture(*world));
}

TEST(Pose, HiddenThingsComeBackWithTheirTrees) {
    Scene rest = moving_scene();
    for (const uint32_t i : {ball, lamp, pane, body, sheet})
        rest.nodes[rest.instances[i].node.value].moves = true;
    const auto shown = at(rest, 1);
    auto hidden = std::make_shared<Scene>(*shown);
    hidden->instances.erase(hidden->instances.begin() + pane, hidden->instances.begin() + pane + 1);
    hidden->instances.pop_back();
    const auto world = build_world(shown);
    const auto without = with_pose(world, hidden);
    EXPECT_EQ(without->accel->work().trees_built, 0u);
    EXPECT_EQ(picture(*without), picture(*build_world(hidden)));
    const auto back = with_pose(without, shown);
    EXPECT_EQ(back->accel->work().trees_built, 0u);
    EXPECT_EQ(picture(*back), picture(*world));
}

// A mesh that one node shows for good and another now and then does not change its place with it.
TEST(Pose, ScenerySharedWithHiddenThingsStaysWhereItIs) {
    Scene rest = moving_scene();
    rest.instances[twin].moves = false;
    rest.instances[twin].world_from_object = glm::translate(Mat4(1), Vec3(1.2f, 0.6f, -0.5f));
    rest.nodes[rest.instances[ball].node.value].moves = true;
    const auto shown = std::make_shared<const Scene>(rest);
    auto hidden = std::make_shared<Scene>(rest);
    hidden->instances.erase(hidden->instances.begin() + ball, hidden->instances.begin() + ball + 1);
    const auto world = build_world(shown);
    const auto without = with_pose(world, hidden);
    EXPECT_EQ(without->accel->work().trees_built, 0u);
    EXPECT_EQ(without->fixed.parts.size(), world->fixed.parts.size());
    EXPECT_EQ(picture(*without), picture(*build_world(hidden)));
}

TEST(Pose, WhatMovesWithoutBeingMarkedIsSeenToo) {
    const Scene rest = moving_scene();
    const auto world = build_world(at(rest, 1));
    auto changed = std::make_shared<Scene>(*world->scene);
    changed->instances[0].world_from_object[3].y = 0.3f;
    const auto other = with_pose(world, changed);
    EXPECT_EQ(other->accel->work().trees_built, 1u);
    EXPECT_EQ(picture(*other), picture(*build_world(changed)));
    EXPECT_NE(picture(*other), picture(*world));
}

TEST(Pose, LampsThatChangeAreChosenByWhatTheyShineNow) {
    const Scene rest = moving_scene();
    const auto world = build_world(at(rest, 1));
    auto changed = std::make_shared<Scene>(*world->scene);
    changed->materials[changed->mesh(changed->instances[lamp].mesh).primitives[0].material.value].emissive_factor =
        Vec3(0.1f, 0, 0.2f);
    EXPECT_EQ(picture(*with_pose(world, changed)), picture(*build_world(changed)));
}

TEST(Pose, SceneryIsInOnePieceThatIsNotMoved) {
    const Scene rest = moving_scene();
    const auto world = build_world(at(rest, 1));
    EXPECT_EQ(world->fixed.parts.size(), room_instances);
    EXPECT_TRUE(world->surfaces[0].positions_in_world);
    EXPECT_FALSE(world->surfaces[ball].positions_in_world);
    // Without movement all that is placed once is scenery.
    Scene still = rest;
    for (Instance& instance : still.instances)
        instance.moves = instance.deforms = false;
    EXPECT_EQ(build_world(std::make_shared<const Scene>(still))->fixed.parts.size(), 6u);
}

TEST(Pose, OldWorldsAreTracedOnAndLeaveNothingBehind) {
    const Scene rest = moving_scene();
    std::shared_ptr<const World> old = build_world(at(rest, 0.5f));
    const std::vector<Vec3> expected = picture(*old);
    std::atomic<bool> stop{false}, same{true};
    std::atomic<int> pictures{0};
    std::thread tracer([&] {
        while (!stop) {
            if (picture(*old) != expected) same = false;
            ++pictures;
        }
    });
    std::shared_ptr<const World> newest = old;
    uint64_t few = 0;
    for (int i = 0; i < 100 || pictures < 10; ++i) {
        newest = with_pose(newest, at(rest, 0.01f * static_cast<float>(i)));
        if (i == 5) few = newest->accel->memory_bytes();
    }
    stop = true;
    tracer.join();
    EXPECT_TRUE(same);
    EXPECT_LE(newest->accel->memory_bytes(), few + few / 20);
    EXPECT_EQ(picture(*newest), picture(*build_world(newest->scene)));
    const std::weak_ptr<const World> first = old;
    old.reset();
    EXPECT_TRUE(first.expired()) << "a pose keeps the one before";
}

}  // namespace
}  // namespace candela
