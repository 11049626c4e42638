// SPDX-License-Identifier: MIT
#include "renderer/integrator/ledger.h"

#include "renderer/io/load_gltf.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

constexpr Vec2u extent(32, 24);

struct Box {
    std::shared_ptr<const World> world;
    View view;
};

Box cornell_box() {
    static const Box box = [] {
        Diagnostics diagnostics;
        const auto scene = std::make_shared<const Scene>(load_gltf("assets/cornell_box.glb", diagnostics));
        return Box{build_world(scene), {scene->cameras.front().camera, extent}};
    }();
    return box;
}

TEST(Ledger, IsTheSampleOfThePictureToTheBit) {
    const Box box = cornell_box();
    for (uint16_t i = 0; i < 200; ++i) {
        const PixelSample sample{static_cast<uint16_t>(i % 32), static_cast<uint16_t>(i / 10), i};
        RayCounts counts;
        const RadianceSample traced = trace_sample(*box.world, box.view, {}, sample, counts);
        const Ledger ledger = trace_ledger(*box.world, box.view, {}, sample, 10);
        ASSERT_EQ(ledger.radiance, traced.radiance) << i;
        // Its rows add up to it, and the surfaces to what it cost.
        Vec3 sum(0);
        for (const LedgerVertex& vertex : ledger.vertices)
            sum += vertex.found + vertex.connected;
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(sum[c], traced.radiance[c], 1e-4f * (1 + traced.radiance[c]));
        ASSERT_EQ(ledger.vertices.size(), traced.segments);
    }
}

TEST(Ledger, TellsWhatHappened) {
    // A mirror on the floor that shows a lamp overhead; a pane of glass in between would be passed.
    Scene scene;
    Material mirror;
    mirror.roughness_factor = 0;
    mirror.metallic_factor = 1;
    scene.materials.push_back(mirror);
    test::add_object(scene, test::make_quad(Vec3(-9, 0, 9), Vec3(18, 0, 0), Vec3(0, 0, -18)), MaterialId{0});
    test::add_object(scene, test::make_quad(Vec3(-9, 5, -9), Vec3(18, 0, 0), Vec3(0, 0, 18)),
                     test::add_emitter(scene, Vec3(2), Vec3(0)));
    const std::shared_ptr<const World> world = test::build(std::move(scene));
    View view;
    view.camera.world_from_camera = look_at(Vec3(0, 2, 2), Vec3(0, 0, 0), Vec3(0, 1, 0));
    view.extent = extent;
    const Ledger ledger = trace_ledger(*world, view, {}, {16, 12, 3}, 100);
    ASSERT_EQ(ledger.vertices.size(), 2u);
    EXPECT_EQ(ledger.vertices[0].event, PathEvent::mirrored);
    EXPECT_EQ(ledger.vertices[0].material, 0u);
    EXPECT_EQ(ledger.vertices[0].pdf, 0.0f) << "a delta has none";
    EXPECT_NEAR(ledger.vertices[0].position.y, 0, 1e-5f);
    EXPECT_EQ(ledger.vertices[1].event, PathEvent::ended);
    EXPECT_NEAR(ledger.vertices[1].found.g, 2, 1e-4f);
    EXPECT_NEAR(ledger.vertices[1].position.y, 5, 1e-4f);
    EXPECT_EQ(ledger.eye, Vec3(0, 2, 2));
}

TEST(Ledger, TheBrightestSampleIsTheBrightest) {
    const Box box = cornell_box();
    const std::optional<PixelSample> found = brightest_sample(*box.world, box.view, {}, {9, 20}, 100);
    ASSERT_TRUE(found.has_value());
    float best = -1;
    uint32_t index = 0;
    for (uint32_t i = 0; i < 100; ++i) {
        RayCounts counts;
        const float here = luminance(trace_sample(*box.world, box.view, {}, {9, 20, i}, counts).radiance);
        if (here > best) {
            best = here;
            index = i;
        }
    }
    EXPECT_EQ(found->index, index);
    EXPECT_EQ(found->x, 9);
    EXPECT_EQ(found->y, 20);
    const std::atomic<bool> cancel{true};
    EXPECT_FALSE(brightest_sample(*box.world, box.view, {}, {9, 20}, 100, &cancel).has_value());
}

}  // namespace
}  // namespace candela
