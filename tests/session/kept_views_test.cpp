// SPDX-License-Identifier: MIT
// Views that were left and come back.
#include "renderer/session/kept_views.h"

#include <chrono>
#include <cstring>
#include <thread>

#include "renderer/session/render_session.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

std::shared_ptr<const World> lit_ball() {
    Scene scene;
    test::add_object(scene, test::make_sphere(Vec3(0), 1.0f, 24, 12), test::add_lambert(scene, Vec3(0.7f)));
    test::add_object(scene, test::make_quad(Vec3(-0.5f, 3, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1)),
                     test::add_emitter(scene, Vec3(5)));
    return test::build(std::move(scene));
}

RenderRequest request_from(const std::shared_ptr<const World>& world, float eye_x, uint32_t spp) {
    RenderRequest request;
    request.world = world;
    request.view.camera.world_from_camera = look_at(Vec3(eye_x, 1.5f, 4), Vec3(0), Vec3(0, 1, 0));
    request.view.extent = Vec2u(150, 90);
    request.max_spp = spp;
    return request;
}

Frame finished(RenderSession& session) {
    EXPECT_TRUE(session.wait_until_done(60));
    return *session.latest();
}

bool same_bits(const Frame& a, const Frame& b) {
    return a.image.size() == b.image.size() &&
           std::memcmp(a.image.data(), b.image.data(), a.image.size() * sizeof(Vec4)) == 0;
}

TEST(KeptViews, GoingBackGoesOnWhereItStoodToTheBit) {
    const std::shared_ptr<const World> world = lit_ball();
    const auto wait_for = [](RenderSession& session, uint64_t epoch, uint32_t spp) {
        const Frame* frame = session.latest();
        while (frame == nullptr || frame->epoch != epoch || session.status().spp < spp) {
            std::this_thread::sleep_for(std::chrono::microseconds(700));
            frame = session.latest();
        }
    };

    // Left at any moment, also in the middle of a pass, several times.
    RenderSession session({.threads = 3, .kept_bytes = uint64_t{64} << 20, .keep_after_seconds = 0});
    uint32_t left_with = 0;
    for (const uint32_t enough : {1u, 5u, 18u, 40u}) {
        wait_for(session, session.submit(request_from(world, 1, 1u << 20)), enough);
        EXPECT_GE(session.status().resumed_samples, left_with);
        left_with = enough;
        session.submit(request_from(world, -1, 3));
        finished(session);
        EXPECT_EQ(session.status().kept_views, 1u);
    }
    session.submit(request_from(world, 1, 1u << 20));
    session.stop();
    const uint32_t spp = finished(session).statistics.min_samples + 7;
    EXPECT_GE(spp, left_with + 7);
    session.submit(request_from(world, 1, spp));
    const Frame resumed = finished(session);
    EXPECT_EQ(session.status().resumed_samples, spp - 7);

    RenderSession alone({.threads = 2, .publish_frames = false});
    alone.submit(request_from(world, 1, spp));
    const Frame reference = finished(alone);
    EXPECT_TRUE(same_bits(reference, resumed));
    EXPECT_EQ(reference.statistics.total_samples, resumed.statistics.total_samples);
}

TEST(KeptViews, OneThatHasAllItsSamplesIsThereAtOnce) {
    const std::shared_ptr<const World> world = lit_ball();
    RenderSession session({.threads = 2, .kept_bytes = uint64_t{64} << 20, .keep_after_seconds = 0});
    session.submit(request_from(world, 1, 8));
    const Frame first = finished(session);
    session.submit(request_from(world, -1, 8));
    finished(session);
    session.submit(request_from(world, 1, 8));
    const Frame again = finished(session);
    EXPECT_TRUE(same_bits(first, again));
    EXPECT_EQ(again.rays, first.rays) << "rays were traced anew";
    EXPECT_EQ(again.history.points().size(), first.history.points().size());

    // Where it is to begin anew it does, with the same samples.
    session.submit(request_from(world, -1, 8));
    finished(session);
    RenderRequest anew = request_from(world, 1, 8);
    anew.resumes = false;
    session.submit(anew);
    EXPECT_TRUE(same_bits(first, finished(session)));
    EXPECT_EQ(session.status().resumed_samples, 0u);
}

TEST(KeptViews, AnotherWorldSettingOrLensIsAnotherView) {
    const std::shared_ptr<const World> world = lit_ball(), other = lit_ball();
    RenderSession session({.threads = 2, .kept_bytes = uint64_t{64} << 20, .keep_after_seconds = 0});
    const RenderRequest plain = request_from(world, 1, 4);
    std::vector<RenderRequest> requests(5, plain);
    requests[1].world = other;
    requests[2].settings.seed = 1;
    requests[3].view.camera.aperture_diameter_m = 0.2f;
    requests[4].view.camera.projection = Projection::orthographic;
    for (const RenderRequest& request : requests) {
        session.submit(request);
        finished(session);
        EXPECT_EQ(session.status().resumed_samples, 0u);
    }
    for (const RenderRequest& request : requests) {
        session.submit(request);
        finished(session);
        EXPECT_EQ(session.status().resumed_samples, 4u);
    }
}

TEST(KeptViews, WhatWasHardlyLookedAtIsKeptOnlyWithABookmark) {
    const std::shared_ptr<const World> world = lit_ball();
    RenderSession session({.threads = 2, .kept_bytes = uint64_t{64} << 20, .keep_after_seconds = 1000});
    session.submit(request_from(world, 1, 4));
    finished(session);
    session.submit(request_from(world, 2, 4));
    finished(session);
    EXPECT_EQ(session.status().kept_views, 0u);
    session.bookmark_view();
    session.submit(request_from(world, 3, 4));
    finished(session);
    EXPECT_EQ(session.status().kept_views, 1u);
    session.submit(request_from(world, 2, 4));
    finished(session);
    EXPECT_EQ(session.status().resumed_samples, 4u);
}

TEST(KeptViews, TheOldestGoFirstAndBookmarksLast) {
    const std::shared_ptr<const World> world = lit_ball();
    const auto key = [&](float x) {
        const RenderRequest request = request_from(world, x, 1);
        return ViewKey{request.world, request.view, request.settings};
    };
    const auto samples = [] {
        auto out = std::make_shared<ViewSamples>();
        out->film = Film(Vec2u(10, 10));
        out->schedule.emplace(Vec2u(10, 10), 1, false);
        out->schedule->next(1000);
        return out;
    };
    KeptViews kept(3 * samples()->bytes());
    kept.keep(key(0), samples(), true);
    for (int i = 1; i < 5; ++i)
        kept.keep(key(static_cast<float>(i)), samples(), false);
    EXPECT_EQ(kept.count(), 3u);
    EXPECT_EQ(kept.bytes(), 3 * samples()->bytes());
    EXPECT_EQ(kept.samples_of(key(0)), 1u);
    EXPECT_EQ(kept.samples_of(key(2)), 0u);
    EXPECT_EQ(kept.samples_of(key(3)), 1u);
    EXPECT_NE(kept.take(key(4)), nullptr);
    EXPECT_EQ(kept.take(key(4)), nullptr);
    EXPECT_EQ(kept.count(), 2u);
}

TEST(KeptViews, AWorldThatIsGoneIsNotKeptAlive) {
    std::shared_ptr<const World> world = lit_ball();
    const std::weak_ptr<const World> watched = world;
    RenderSession session({.threads = 2, .kept_bytes = uint64_t{64} << 20, .keep_after_seconds = 0});
    for (const float x : {1.0f, 2.0f}) {
        session.submit(request_from(world, x, 2));
        finished(session);
    }
    EXPECT_EQ(session.status().kept_views, 1u);
    world = lit_ball();
    session.submit(request_from(world, 1, 2));
    finished(session);
    EXPECT_TRUE(watched.expired());
    session.submit(request_from(world, 2, 2));
    finished(session);
    EXPECT_EQ(session.status().kept_views, 1u) << "only that of the new world";
}

}  // namespace
}  // namespace candela
