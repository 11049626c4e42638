// SPDX-License-Identifier: MIT
// Lights made brighter after they were traced.
#include <cstring>
#include <thread>

#include "renderer/session/render_session.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

RenderRequest lit_request(uint32_t spp) {
    static const std::shared_ptr<const World> world = [] {
        Scene scene;
        test::add_object(scene, test::make_sphere(Vec3(0), 1.0f, 24, 12), test::add_lambert(scene, Vec3(0.7f)));
        test::add_object(scene, test::make_quad(Vec3(-0.5f, 3, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1)),
                         test::add_emitter(scene, Vec3(5)));
        scene.environment = test::constant_environment(Vec3(0.3f, 0.2f, 0.1f));
        return test::build(std::move(scene));
    }();
    RenderRequest request;
    request.world = world;
    request.view.camera.world_from_camera = look_at(Vec3(0, 1.5f, 4), Vec3(0), Vec3(0, 1, 0));
    request.view.extent = Vec2u(90, 60);
    request.max_spp = spp;
    return request;
}

Frame finished(RenderSession& session) {
    EXPECT_TRUE(session.wait_until_done(60));
    return *session.latest();
}

Frame weighed(RenderSession& session, std::vector<Vec3> weights) {
    const uint64_t weighing = session.weigh_lights(std::move(weights));
    const Frame* frame = session.latest();
    for (int i = 0; i < 5000 && frame->weighing != weighing; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        frame = session.latest();
    }
    EXPECT_EQ(frame->weighing, weighing);
    return *frame;
}

bool same_bits(const Frame& a, const Frame& b) {
    return a.image.size() == b.image.size() &&
           std::memcmp(a.image.data(), b.image.data(), a.image.size() * sizeof(Vec4)) == 0;
}

TEST(LightWeights, NothingIsTracedAnewAndLightsAsTheyAreAreThereToTheBit) {
    RenderSession plain({.threads = 2});
    RenderRequest alone = lit_request(6);
    alone.settings.reuse_paths = false;  // paths are not shared where lights are kept apart
    plain.submit(std::move(alone));
    const Frame wanted = finished(plain);

    RenderSession session({.threads = 3});
    RenderRequest request = lit_request(6);
    request.light_groups = make_light_groups(*request.world);
    ASSERT_EQ(request.light_groups->size(), 3u);
    session.submit(request);
    const Frame as_it_is = finished(session);
    EXPECT_TRUE(same_bits(wanted, as_it_is));
    EXPECT_EQ(wanted.rays, as_it_is.rays);

    // Twice the sky and no lamp: what is seen of the sky itself is exactly twice as bright.
    const Frame sky = weighed(session, {Vec3(2), Vec3(0), Vec3(1)});
    EXPECT_EQ(sky.epoch, as_it_is.epoch);
    EXPECT_EQ(sky.rays, as_it_is.rays);
    EXPECT_EQ(sky.image(2, 20), 2.0f * Vec4(Vec3(as_it_is.image(2, 20)), 0.5f));
    // And the parts make the whole.
    const Frame lamp = weighed(session, {Vec3(0), Vec3(1), Vec3(0)});
    for (size_t i = 0; i < wanted.image.size(); ++i) {
        const Vec3 sum = 0.5f * Vec3(sky.image.pixels()[i]) + Vec3(lamp.image.pixels()[i]);
        ASSERT_LE(max_component(glm::abs(sum - Vec3(wanted.image.pixels()[i]))),
                  1e-5f * std::max(1.0f, max_component(Vec3(wanted.image.pixels()[i]))));
    }
    // One channel of it; a snapshot is of the lights that are shown.
    const Frame red = weighed(session, {Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0)});
    EXPECT_EQ(red.image(45, 30).y, 0.0f);
    EXPECT_NEAR(red.image(45, 30).x, wanted.image(45, 30).x, 1e-5f);
    EXPECT_EQ(session.snapshot_film().at({45, 30}).radiance_sum.y, 0.0f);
    EXPECT_TRUE(same_bits(wanted, weighed(session, {Vec3(1), Vec3(1), Vec3(1)})));
}

TEST(LightWeights, AViewWithItsLightsApartIsKeptAsSuch) {
    RenderSession session({.threads = 2, .kept_bytes = uint64_t{64} << 20, .keep_after_seconds = 0});
    RenderRequest apart = lit_request(4), other = lit_request(2);
    apart.light_groups = make_light_groups(*apart.world);
    other.view.camera.yfov_radians *= 0.5f;
    session.submit(apart);
    const Frame first = finished(session);
    session.submit(other);
    finished(session);
    EXPECT_EQ(session.status().kept_bytes, 90u * 60 * (sizeof(FilmPixel) + 3 * sizeof(Vec3)));
    session.submit(lit_request(4));
    finished(session);
    EXPECT_EQ(session.status().resumed_samples, 0u) << "that one was not kept apart";
    session.submit(apart);
    EXPECT_TRUE(same_bits(first, finished(session)));
    EXPECT_EQ(session.status().resumed_samples, 4u);
    weighed(session, {Vec3(0), Vec3(1), Vec3(1)});
    EXPECT_EQ(session.latest()->image(2, 20).x, 0.0f);
}

}  // namespace
}  // namespace candela
