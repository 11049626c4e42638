// SPDX-License-Identifier: MIT
// The path tracer against exact answers: every case with each estimator and sampler, by both drivers, within four
// standard errors of batch means, at a standard error small enough to mean something.
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/measure.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

using namespace test;

TEST(ClosedForms, StripLightOverLambertianPlane) {
    Scene scene;
    const float reach = 1000;
    test::add_object(scene, test::make_quad(Vec3(-50, 0, 50), Vec3(100, 0, 0), Vec3(0, 0, -100)),
                     test::add_lambert(scene, Vec3(1)));
    test::add_object(scene, test::make_quad(Vec3(-1, 1, -reach), Vec3(2, 0, 0), Vec3(0, 0, 2 * reach)),
                     test::add_emitter(scene, Vec3(1)));
    const auto world = test::build(std::move(scene));
    for (const float p : {0.0f, 1.0f, 3.0f}) {
        const double a = 1.0 - static_cast<double>(p);
        const double b = 1.0 + static_cast<double>(p);
        const double exact = 0.5 * (a / std::sqrt(a * a + 1) + b / std::sqrt(b * b + 1));
        // From below the strip, past its edge.
        const View view = look_at_point(Vec3(p + 0.2f, 0.5f, 0.3f), Vec3(p, 0, 0), Vec3(0, 1, 0));
        for (const Technique& technique : all_techniques) {
            const uint32_t batches = p > 2.0f ? 256 : p > 0.0f ? 64 : 32;
            expect_exact(measure(*world, view, technique, batches, 8192), exact, 1e-3,
                         "p=" + std::to_string(p) + " " + describe(technique));
        }
    }
}

TEST(ClosedForms, PointLightOverLambertianPlane) {
    Scene scene;
    test::add_object(scene, test::make_quad(Vec3(-50, 0, 50), Vec3(100, 0, 0), Vec3(0, 0, -100)),
                     test::add_lambert(scene, Vec3(0.5f)));
    PunctualLight light;
    light.intensity = 100.0f / (4.0f * pi);
    scene.lights.push_back(light);
    scene.light_instances.push_back({{0}, {0}, glm::translate(Mat4(1), Vec3(0, 1, 0))});
    const auto world = test::build(std::move(scene));
    for (const float r : {0.0f, 1.0f, 4.0f}) {
        const double d2 = 1.0 + static_cast<double>(r) * static_cast<double>(r);
        const double exact = 0.5 / 3.14159265358979 * 100.0 / (4 * 3.14159265358979 * d2 * std::sqrt(d2));
        const View view = look_at_point(Vec3(r, 0.5f, 0.4f), Vec3(r, 0, 0), Vec3(0, 1, 0));
        for (const Technique& technique : all_techniques) {
            const test::BatchMeans means = measure(*world, view, technique, 4, 256);
            EXPECT_NEAR(means.mean(), exact, 1e-5 * exact) << "r=" << r << " " << describe(technique);
        }
    }
}

TEST(ClosedForms, LightsOfAllKindsAddUp) {
    // Under a square lamp of side 2 at height 1: a point light below it, the sun past its edge, and what the lamp
    // leaves of the sky.
    Scene scene;
    test::add_object(scene, test::make_quad(Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4)),
                     test::add_lambert(scene, Vec3(1)));
    test::add_object(scene, test::make_quad(Vec3(-1, 1, -1), Vec3(2, 0, 0), Vec3(0, 0, 2)),
                     test::add_emitter(scene, Vec3(1)));
    PunctualLight point;
    point.intensity = 1.0f;
    scene.lights.push_back(point);
    scene.light_instances.push_back({{0}, {0}, glm::translate(Mat4(1), Vec3(0, 0.5f, 0))});
    PunctualLight sun;
    sun.kind = LightKind::directional;
    sun.intensity = 0.5f;
    scene.lights.push_back(sun);
    // Shines along -Z of its node: turned to 60° from the plane's normal.
    scene.light_instances.push_back(
        {{1}, {0}, glm::rotate(Mat4(1), pi / 2, Vec3(0, 1, 0)) * glm::rotate(Mat4(1), -pi / 6, Vec3(1, 0, 0))});
    scene.environment = test::constant_environment(Vec3(0.1f));
    const auto world = test::build(std::move(scene));
    // Form factor of a unit square at distance 1 over its corner, four times (Howell's catalogue, C-11).
    constexpr double pi_d = 3.14159265358979;
    const double lamp = 4 / pi_d * std::sqrt(0.5) * std::atan(std::sqrt(0.5));
    const double exact = lamp + 0.1 * (1 - lamp) + (1 / 0.25 + 0.5 * 0.5) / pi_d;
    const View view = look_at_point(Vec3(0.2f, 0.3f, 0.3f), Vec3(0), Vec3(0, 1, 0));
    for (const Technique& technique : all_techniques)
        expect_exact(measure(*world, view, technique, 128, 16384), exact, 1e-3, describe(technique));
}

TEST(ClosedForms, IntegratingSphereConvergesToTheGeometricSeries) {
    for (const float albedo : {0.5f, 0.9f}) {
        Scene scene;
        const MaterialId wall = test::add_emitter(scene, Vec3(1), Vec3(albedo));
        test::add_object(scene, test::make_sphere(Vec3(0), 1, 48, 24, true), wall);
        const auto world = test::build(std::move(scene));
        const View view = look_at_point(Vec3(0.1f, 0.2f, 0), Vec3(0.7f, 0.5f, 0.3f), Vec3(0, 1, 0));
        for (const Technique& technique : all_techniques) {
            // Smooth normals on flat facets lose the sliver of directions between the two horizons: under 1e-3 of the
            // light.
            const test::BatchMeans means = measure(*world, view, technique, 16, 4096);
            const double exact = 1.0 / (1.0 - static_cast<double>(albedo));
            EXPECT_NEAR(means.mean(), exact, 4 * means.standard_error() + 2e-3 * exact) << describe(technique);
            EXPECT_LT(means.standard_error(), 1e-2 * exact) << describe(technique);
        }
    }
}

TEST(ClosedForms, LambertianPlaneUnderConstantSky) {
    Scene scene;
    test::add_object(scene, test::make_quad(Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2)),
                     test::add_lambert(scene, Vec3(0.25f)));
    scene.environment = test::constant_environment(Vec3(2));
    const auto world = test::build(std::move(scene));
    const View view = look_at_point(Vec3(0, 1, 0.5f), Vec3(0), Vec3(0, 1, 0));
    for (const Technique& technique : all_techniques) {
        expect_exact(measure(*world, view, technique, 32, 8192), 0.5, 1e-3, describe(technique));
    }
}

TEST(ClosedForms, WhiteFurnaceSphereIsInvisible) {
    // Flat facets: interpolated normals would lose the light between the two horizons.
    Primitive sphere = test::make_sphere(Vec3(0), 1, 64, 32);
    sphere.normals.clear();
    sphere.flat_normals = true;
    Scene scene;
    test::add_object(scene, std::move(sphere), test::add_lambert(scene, Vec3(1)));
    scene.environment = test::constant_environment(Vec3(1));
    const auto world = test::build(std::move(scene));
    for (const Technique& technique : all_techniques) {
        const View view = look_at_point(Vec3(0.3f, 0.2f, 5), Vec3(0.3f, 0.2f, 0), Vec3(0, 1, 0));
        expect_exact(measure(*world, view, technique, 32, 8192), 1.0, 1e-3, describe(technique));
    }
}

TEST(ClosedForms, BlendedSheetsDarkenTheLightBehindThem) {
    // Two sheets of opacity 0.25 before a plane: the camera sees through them, and so does the light.
    Scene scene;
    test::add_object(scene, test::make_quad(Vec3(-9, 0, 9), Vec3(18, 0, 0), Vec3(0, 0, -18)),
                     test::add_lambert(scene, Vec3(1)));
    const MaterialId black_glass = test::add_lambert(scene, Vec3(0));
    scene.materials[black_glass.value].alpha_mode = AlphaMode::blend;
    scene.materials[black_glass.value].base_color_factor.a = 0.25f;
    for (const float y : {1.0f, 2.0f}) {
        test::add_object(scene, test::make_quad(Vec3(-900, y, 900), Vec3(1800, 0, 0), Vec3(0, 0, -1800)), black_glass);
    }
    PunctualLight light;
    light.kind = LightKind::directional;
    light.intensity = pi;
    scene.lights.push_back(light);
    scene.light_instances.push_back({{0}, {0}, glm::rotate(Mat4(1), -pi / 2, Vec3(1, 0, 0))});
    const auto world = test::build(std::move(scene));
    // Off the sheets' diagonals, where a ray would meet both triangles.
    const View view = look_at_point(Vec3(0.3f, 3, 0.5f), Vec3(0.3f, 0, 0), Vec3(0, 1, 0));
    const double through = 0.75 * 0.75;
    expect_exact(measure(*world, view, {}, 32, 8192), through * through, 5e-3, "through both ways");
}

}  // namespace
}  // namespace candela
