// SPDX-License-Identifier: MIT
// Normals that lean away from the true surface: no light through its back, and no black where a mirror would reflect
// into itself.
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/measure.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

using namespace test;

// A plane at height 0, seen from above, whose normals lean by the angle towards +X.
Primitive leaning_plane(float lean_radians) {
    Primitive plane = make_quad(Vec3(-50, 0, 50), Vec3(100, 0, 0), Vec3(0, 0, -100));
    plane.flat_normals = false;
    plane.normals.assign(4, Vec3(std::sin(lean_radians), std::cos(lean_radians), 0));
    return plane;
}

TEST(ShadingNormal, NoLightComesThroughTheBack) {
    // A lamp and a point light below, in directions that the leaning normal calls above.
    Scene scene;
    add_object(scene, leaning_plane(1.2f), add_lambert(scene, Vec3(1)));
    add_object(scene, make_quad(Vec3(0.5f, -1, 20), Vec3(40, 0, 0), Vec3(0, 0, -40)), add_emitter(scene, Vec3(1)));
    PunctualLight point;
    scene.lights.push_back(point);
    scene.light_instances.push_back({{0}, {0}, glm::translate(Mat4(1), Vec3(2, -0.5f, 0))});
    const auto world = build(std::move(scene));
    const View view = look_at_point(Vec3(0.3f, 1, 0.2f), Vec3(0), Vec3(0, 1, 0));
    for (const Technique& technique : all_techniques)
        EXPECT_EQ(measure(*world, view, technique, 4, 4096).mean(), 0.0) << describe(technique);
}

TEST(ShadingNormal, AMirrorThatLeansReflectsTheSkyAndNotItself) {
    // Seen from the low side its mirror direction would run below the plane.
    Scene scene;
    const MaterialId mirror = add_lambert(scene, Vec3(1));
    Material& material = scene.materials[mirror.value];
    material = Material{};
    material.metallic_factor = 1;
    material.roughness_factor = 0;
    add_object(scene, leaning_plane(0.6f), mirror);
    scene.environment = constant_environment(Vec3(1));
    const auto world = build(std::move(scene));
    const View view = look_at_point(Vec3(-1, 0.2f, 0.1f), Vec3(0), Vec3(0, 1, 0));
    for (const Technique& technique : all_techniques)
        EXPECT_NEAR(measure(*world, view, technique, 4, 1024).mean(), 1.0, 1e-4) << describe(technique);
}

}  // namespace
}  // namespace candela
