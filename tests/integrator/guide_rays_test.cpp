// SPDX-License-Identifier: MIT
#include "renderer/integrator/guide_rays.h"

#include "tests/support/scenes.h"

namespace candela {
namespace {

constexpr Vec2u extent(24, 16);

View front_view() {
    View view;
    view.camera.world_from_camera = look_at(Vec3(0, 0, 4), Vec3(0), Vec3(0, 1, 0));
    view.extent = extent;
    return view;
}

// A wall that fills the left half of the picture.
std::shared_ptr<const World> half_wall() {
    Scene scene;
    test::add_object(scene, test::make_quad(Vec3(-20, -20, 0), Vec3(20, 0, 0), Vec3(0, 40, 0)),
                     test::add_lambert(scene, Vec3(0.8f, 0.4f, 0.2f)));
    return test::build(std::move(scene));
}

TEST(GuideRays, TellAlbedoNormalAndDepth) {
    Guides guides(extent);
    ASSERT_TRUE(add_guides(*half_wall(), front_view(), {}, 4, guides));
    ASSERT_EQ(guides.passes, 4u);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(guides.albedo(5, 8)[c] / 4, Vec3(0.8f, 0.4f, 0.2f)[c], 1e-3f);
    EXPECT_NEAR(guides.normal(5, 8).z / 4, 1, 1e-5f);
    EXPECT_NEAR(guides.depth(9, 8) / 4, 4, 0.1f);
    // Beside the wall nothing divides the colour, and nothing has a face.
    EXPECT_EQ(guides.albedo(20, 8), Vec3(4));
    EXPECT_EQ(guides.normal(20, 8), Vec3(0));
    EXPECT_EQ(guides.depth(20, 8), 0.0f);
    // The edge is as soft as the picture's.
    EXPECT_GT(guides.depth(11, 8) + guides.depth(12, 8), 4.0f);
    EXPECT_LT(guides.depth(11, 8) + guides.depth(12, 8), 31.0f);
}

TEST(GuideRays, AreTheSameInOneGoAndInSeveral) {
    const std::shared_ptr<const World> world = half_wall();
    Guides once(extent), twice(extent);
    add_guides(*world, front_view(), {}, 8, once);
    add_guides(*world, front_view(), {}, 3, twice);
    add_guides(*world, front_view(), {}, 8, twice);
    EXPECT_EQ(once.depth.pixels(), twice.depth.pixels());
    EXPECT_EQ(once.albedo.pixels(), twice.albedo.pixels());
    const std::atomic<bool> cancel{true};
    EXPECT_FALSE(add_guides(*world, front_view(), {}, 16, twice, &cancel));
}

}  // namespace
}  // namespace candela
