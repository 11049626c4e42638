// SPDX-License-Identifier: MIT
// The session's promise: the picture depends on the request alone, not on threads, history or timing.
#include <chrono>
#include <cstring>
#include <thread>

#include "renderer/session/render_session.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

std::shared_ptr<const World> small_world() {
    static const std::shared_ptr<const World> world = [] {
        Scene scene;
        test::add_object(scene, test::make_quad(Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4)),
                         test::add_lambert(scene, Vec3(0.6f)));
        test::add_object(scene, test::make_sphere(Vec3(0, 0.7f, 0), 0.7f, 24, 12),
                         test::add_lambert(scene, Vec3(0.8f, 0.3f, 0.2f)));
        test::add_object(scene, test::make_quad(Vec3(-0.5f, 3, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1)),
                         test::add_emitter(scene, Vec3(5)));
        scene.environment = test::constant_environment(Vec3(0.3f));
        return test::build(std::move(scene));
    }();
    return world;
}

RenderRequest request_from(float eye_x, uint32_t spp, Vec2u extent = Vec2u(75, 50)) {
    RenderRequest request;
    request.world = small_world();
    request.view.camera.world_from_camera = look_at(Vec3(eye_x, 1.5f, 4), Vec3(0, 0.7f, 0), Vec3(0, 1, 0));
    request.view.extent = extent;
    request.max_spp = spp;
    return request;
}

Frame finished(RenderSession& session) {
    EXPECT_TRUE(session.wait_until_done(60));
    const Frame* frame = session.latest();
    EXPECT_NE(frame, nullptr);
    return *frame;
}

bool same_bits(const Frame& a, const Frame& b) {
    return a.image.size() == b.image.size() &&
           std::memcmp(a.image.data(), b.image.data(), a.image.size() * sizeof(Vec4)) == 0;
}

Frame render_alone(const RenderRequest& request, unsigned threads, bool publish) {
    SessionOptions options;
    options.threads = threads;
    options.publish_frames = publish;
    RenderSession session(options);
    session.submit(request);
    return finished(session);
}

TEST(RenderSession, AnyNumberOfThreadsAndWindowOrHeadlessGiveTheSameBits) {
    const RenderRequest request = request_from(1, 5);
    const Frame reference = render_alone(request, 1, false);
    EXPECT_EQ(reference.statistics.total_samples, 5u * 75 * 50);
    EXPECT_EQ(reference.statistics.non_finite, 0u);
    EXPECT_TRUE(same_bits(reference, render_alone(request, 2, false)));
    EXPECT_TRUE(same_bits(reference, render_alone(request, 5, true)));
}

TEST(RenderSession, ThePictureForgetsWhatCameBefore) {
    const RenderRequest wanted = request_from(-1, 4);
    const Frame reference = render_alone(wanted, 2, false);
    RenderSession session({.threads = 2});
    session.submit(request_from(1, 1000));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    session.submit(request_from(2, 3, Vec2u(31, 17)));
    session.submit(wanted);
    EXPECT_TRUE(same_bits(reference, finished(session)));
}

TEST(RenderSession, PausingChangesNothing) {
    const RenderRequest wanted = request_from(0, 40);
    const Frame reference = render_alone(wanted, 2, false);
    RenderSession session({.threads = 2});
    session.submit(wanted);
    for (int i = 0; i < 5; ++i) {
        session.pause();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        session.resume();
    }
    EXPECT_TRUE(same_bits(reference, finished(session)));
}

TEST(RenderSession, FewerWorkersMakeTheSamePicture) {
    const RenderRequest request = request_from(1, 5);
    SessionOptions options;
    options.threads = 3;
    RenderSession session(options);
    session.use_workers(0);
    session.submit(request);
    EXPECT_TRUE(same_bits(finished(session), render_alone(request, 3, true)));
}

TEST(RenderSession, StopKeepsWhatThereIs) {
    RenderSession session({.threads = 2, .publish_frames = false});
    session.submit(request_from(0, 1u << 30));
    while (session.status().spp < 2)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    session.stop();
    const Frame frame = finished(session);
    EXPECT_GE(frame.statistics.mean_samples, 2.0);
    const Film film = session.snapshot_film();
    uint64_t samples = 0;
    for (const FilmPixel& pixel : film.pixels())
        samples += pixel.count;
    EXPECT_EQ(samples, frame.statistics.total_samples);
}

TEST(RenderSession, EveryEpochOfADragShowsAFirstFrame) {
    RenderSession session({.threads = 2});
    uint64_t shown = 0;
    int pictures = 0;
    for (int i = 0; i < 100; ++i) {
        session.submit(request_from(0.02f * static_cast<float>(i), 1u << 30));
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        const Frame* frame = session.latest();
        if (frame != nullptr && frame->epoch != shown) {
            shown = frame->epoch;
            ++pictures;
        }
    }
    EXPECT_GT(pictures, 10);
}

TEST(RenderSession, StopsAtTheAskedErrorAndTime) {
    RenderRequest request = request_from(0, 1u << 20);
    request.until_relative_error = 0.05;
    RenderSession session({.threads = 2, .publish_frames = false});
    session.submit(request);
    const Frame frame = finished(session);
    EXPECT_LE(frame.statistics.relative_error, 0.05);
    EXPECT_GT(frame.statistics.relative_error, 0.01);

    request.until_relative_error = 0;
    request.max_seconds = 0.05;
    session.submit(request);
    EXPECT_GE(finished(session).render_seconds, 0.05);
}

TEST(RenderSession, MapsComeWhenTheyAreAskedForAndChangeNothing) {
    const RenderRequest wanted = request_from(0, 6);
    RenderSession session({.threads = 2});
    session.submit(wanted);
    const Frame plain = finished(session);
    EXPECT_EQ(plain.maps.size(), 0u);

    session.show_maps(true);
    const Frame* mapped = session.latest();
    for (int i = 0; i < 5000 && mapped->serial == plain.serial; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        mapped = session.latest();
    }
    ASSERT_EQ(mapped->maps.size(), plain.image.size()) << "a picture that is done is published again";
    EXPECT_TRUE(same_bits(plain, *mapped));
    double rays = 0, samples = 0;
    for (const Vec4& pixel : mapped->maps.pixels()) {
        EXPECT_GE(pixel[static_cast<int>(PixelMap::error)], 0);
        samples += static_cast<double>(pixel[static_cast<int>(PixelMap::samples)]);
        rays +=
            static_cast<double>(pixel[static_cast<int>(PixelMap::rays)] * pixel[static_cast<int>(PixelMap::samples)]);
    }
    EXPECT_EQ(samples, static_cast<double>(plain.statistics.total_samples));
    EXPECT_NEAR(rays, static_cast<double>(plain.rays), 1e-5 * static_cast<double>(plain.rays));

    session.submit(wanted);
    EXPECT_EQ(finished(session).maps.size(), plain.image.size());
    session.show_maps(false);
    session.submit(wanted);
    EXPECT_EQ(finished(session).maps.size(), 0u);
}

TEST(RenderSession, FramesTellHowTheErrorFell) {
    RenderSession session({.threads = 2});
    session.submit(request_from(0, 80));
    const Frame frame = finished(session);
    const std::vector<ErrorPoint>& points = frame.history.points();
    ASSERT_GT(points.size(), 8u);
    EXPECT_EQ(points.front().spp, 2u);
    EXPECT_EQ(points.back().spp, 80u);
    EXPECT_EQ(points.back().relative_error, frame.statistics.relative_error);
    EXPECT_EQ(points.back().relative_error_95, frame.statistics.relative_error_95);
    EXPECT_LT(points.back().relative_error, 0.5 * points.front().relative_error);
    for (size_t i = 1; i < points.size(); ++i)
        EXPECT_GT(points[i].seconds, points[i - 1].seconds);
    // Another view begins anew.
    session.submit(request_from(1, 6));
    EXPECT_EQ(finished(session).history.points().size(), 3u) << "after 2, 4 and 6 samples";
}

TEST(RenderSession, RefusesWhatCannotBeRendered) {
    RenderSession session({.threads = 1});
    RenderRequest request = request_from(0, 1);
    request.view.extent = Vec2u(0, 10);
    EXPECT_THROW(session.submit(request), std::invalid_argument);
    request.world = nullptr;
    EXPECT_THROW(session.submit(request), std::invalid_argument);
}

TEST(RenderSession, ManyRandomSubmitsEndInTheLastPicture) {
    const RenderRequest wanted = request_from(0.5f, 2, Vec2u(40, 30));
    const Frame reference = render_alone(wanted, 1, false);
    RenderSession session({.threads = 3});
    uint32_t random = 1;
    for (int i = 0; i < 1000; ++i) {
        random = random * 1664525u + 1013904223u;
        const Vec2u extent(8 + (random >> 24) % 40, 8 + (random >> 16) % 40);
        session.submit(request_from(static_cast<float>(random >> 28), 1u + (random >> 20) % 3, extent));
        if (random % 7 == 0) session.latest();
        if (random % 31 == 0) std::this_thread::yield();
        if (random % 97 == 0) session.snapshot_film();
    }
    session.submit(wanted);
    EXPECT_TRUE(same_bits(reference, finished(session)));
}

}  // namespace
}  // namespace candela
