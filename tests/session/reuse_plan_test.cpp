// SPDX-License-Identifier: MIT
// Sharing paths pays in a box and not under the sky, and the plan finds out which it is.
#include "renderer/session/reuse_plan.h"

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/integrator/path_reuse.h"
#include "tests/support/scenes.h"
#include "tests/support/tiles.h"

namespace candela {
namespace {

// The noise of single pixels, relative to the picture without sharing.
double noise_ratio(const World& world, const View& view) {
    RayCounts counts;
    double noise[2] = {};
    for (int k = 0; k < 2; ++k) {
        std::vector<RadianceSample> a(size_t{reuse_tile} * reuse_tile), b(a.size());
        const PathSharing sharing = k == 0 ? PathSharing::none : PathSharing::group;
        for (uint32_t index = 0; index < 64; index += 2) {
            trace_batch(world, view, {}, test::tile_at(0, 0, index, sharing), a, counts);
            trace_batch(world, view, {}, test::tile_at(0, 0, index + 1, sharing), b, counts);
            for (size_t i = 0; i < a.size(); ++i)
                noise[k] += static_cast<double>(sqr(luminance(a[i].radiance) - luminance(b[i].radiance)));
        }
    }
    return noise[1] / noise[0];
}

// A box that is open towards the eye, lit by a small lamp; and a rough field under the sky.
std::shared_ptr<const World> lit_box() {
    Scene scene;
    const MaterialId white = test::add_lambert(scene, Vec3(0.8f));
    test::add_object(scene, test::make_quad(Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4)), white);
    test::add_object(scene, test::make_quad(Vec3(-2, 4, -2), Vec3(4, 0, 0), Vec3(0, 0, 4)), white);
    test::add_object(scene, test::make_quad(Vec3(-2, 0, -2), Vec3(4, 0, 0), Vec3(0, 4, 0)), white);
    test::add_object(scene, test::make_quad(Vec3(-2, 0, 2), Vec3(0, 0, -4), Vec3(0, 4, 0)), white);
    test::add_object(scene, test::make_quad(Vec3(2, 0, -2), Vec3(0, 0, 4), Vec3(0, 4, 0)), white);
    test::add_object(scene, test::make_quad(Vec3(-0.2f, 2, -0.2f), Vec3(0, 0, 0.4f), Vec3(0.4f, 0, 0)),
                     test::add_emitter(scene, Vec3(20)));
    return test::build(std::move(scene));
}

std::shared_ptr<const World> open_field() {
    Scene scene;
    const MaterialId earth = test::add_lambert(scene, Vec3(0.4f));
    test::add_object(scene, test::make_quad(Vec3(-90, 0, 90), Vec3(180, 0, 0), Vec3(0, 0, -180)), earth);
    for (int i = 0; i < 8; ++i) {
        test::add_object(scene, test::make_sphere(Vec3(0), 0.3f, 12, 8), earth,
                         glm::translate(Mat4(1), Vec3(static_cast<float>(i % 4) - 1.5f, 0, static_cast<float>(i / 4))));
    }
    scene.environment = test::constant_environment(Vec3(1));
    return test::build(std::move(scene));
}

TEST(ReusePlan, ABoxIsLessNoisy) {
    EXPECT_LT(noise_ratio(*lit_box(), test::room_view(16)), 0.4);
}

PathSharing planned(const World& world, const View& view, uint32_t first_left) {
    ReusePlan plan(view.extent);
    RayCounts counts;
    std::vector<RadianceSample> traced(size_t{reuse_tile} * reuse_tile);
    for (uint32_t index = 0; index < ReusePlan::first_planned; ++index) {
        for (uint32_t tile = 0; tile < 4; ++tile) {
            // In another order every time.
            const uint32_t t = (tile + first_left) % 4;
            const auto samples = test::tile_at(t % 2 * reuse_tile, t / 2 * reuse_tile, index, plan.sharing(index, t));
            trace_batch(world, view, {}, samples, traced, counts);
            plan.note(t, samples, traced);
        }
    }
    plan.decide();
    return plan.sharing(ReusePlan::first_planned, 1);
}

TEST(ReusePlan, SharesInABoxAndNotUnderTheSky) {
    for (const uint32_t first : {0u, 1u, 3u}) {
        EXPECT_EQ(planned(*lit_box(), test::room_view(32), first), PathSharing::group);
        EXPECT_EQ(planned(*open_field(), test::room_view(32), first), PathSharing::none);
    }
    EXPECT_EQ(ReusePlan().sharing(7, 0), PathSharing::none);
}

}  // namespace
}  // namespace candela
