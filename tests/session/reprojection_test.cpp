// SPDX-License-Identifier: MIT
// The view before, seen from where the camera is now: it shows what is there, or nothing.
#include "renderer/session/reprojection.h"

#include <cstring>
#include <thread>

#include "renderer/session/render_session.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

// A red box before a blue wall that is far behind it, on a floor, all of them bright by themselves, so that a colour
// tells the surface.
std::shared_ptr<const World> colored_world() {
    static const std::shared_ptr<const World> world = [] {
        Scene scene;
        test::add_object(scene, test::make_quad(Vec3(-0.5f, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)),
                         test::add_emitter(scene, Vec3(1, 0, 0)));
        test::add_object(scene, test::make_quad(Vec3(-8, -1, -4), Vec3(16, 0, 0), Vec3(0, 8, 0)),
                         test::add_emitter(scene, Vec3(0, 0, 1)));
        test::add_object(scene, test::make_quad(Vec3(-8, -0.2f, 3), Vec3(16, 0, 0), Vec3(0, 0, -7)),
                         test::add_emitter(scene, Vec3(0, 1, 0)));
        scene.environment = test::constant_environment(Vec3(1));
        return test::build(std::move(scene));
    }();
    return world;
}

View view_from(float eye_x, float eye_y = 1.2f) {
    View view;
    view.camera.world_from_camera = look_at(Vec3(eye_x, eye_y, 3), Vec3(0, 0.6f, 0), Vec3(0, 1, 0));
    view.extent = Vec2u(160, 121);
    return view;
}

RenderRequest request_of(const View& view, uint32_t spp) {
    RenderRequest request;
    request.world = colored_world();
    request.view = view;
    request.max_spp = spp;
    return request;
}

Film film_of(const View& view, uint32_t spp) {
    RenderSession session({.threads = 2, .publish_frames = false});
    session.submit(request_of(view, spp));
    session.wait_until_done(60);
    return session.snapshot_film();
}

GuideLattice guides_of(const View& view, uint32_t stride) {
    GuideLattice out(view.extent, stride);
    for (uint32_t row = 0; row < out.size().y; ++row)
        out.trace_row(*colored_world(), view, row);
    return out;
}

struct Judged {
    double shown = 0;  // the part of all pixels that were reprojected
    double wrong = 0;  // the part of those that show another surface than is there
};

// Judges by colour, away from edges, where a pixel shows two surfaces.
Judged judge(const View& before, const View& after, uint32_t stride, uint32_t step = 1) {
    const Film old = film_of(before, 4), truth = film_of(after, 4);
    const GuideLattice guides = guides_of(before, 1);
    ImageRgba32f out(static_cast<int>(after.extent.x), static_cast<int>(after.extent.y));
    reproject_rows({&old, &guides, before}, after, guides_of(after, stride), 0, after.extent.y, out, step);
    size_t shown = 0, wrong = 0, all = 0;
    for (uint32_t y = 0; y < after.extent.y; ++y) {
        for (uint32_t x = 0; x < after.extent.x; ++x) {
            const FilmPixel& sums = truth.at({x, y});
            const Vec3 wanted = sums.radiance_sum / static_cast<float>(sums.count);
            ++all;
            const Vec4& got = out(static_cast<int>(x), static_cast<int>(y));
            if (std::isnan(got.x)) continue;
            ++shown;
            if (max_component(glm::abs(Vec3(got) - wanted)) > 0.7f) ++wrong;
        }
    }
    return {static_cast<double>(shown) / static_cast<double>(all),
            static_cast<double>(wrong) / static_cast<double>(shown)};
}

TEST(Reprojection, TheSameViewIsThereToTheLastPixel) {
    const Judged same = judge(view_from(0), view_from(0), 8);
    EXPECT_EQ(same.shown, 1.0);
    EXPECT_EQ(same.wrong, 0.0);
}

TEST(Reprojection, ASmallMoveKeepsNearlyEverythingAndShowsNothingWrong) {
    for (const uint32_t stride : {4u, 8u, 16u}) {
        const Judged moved = judge(view_from(0), view_from(0.15f, 1.3f), stride);
        EXPECT_GT(moved.shown, 0.9) << stride;
        EXPECT_LT(moved.wrong, 0.003) << stride;
    }
}

TEST(Reprojection, SquaresOfPixelsFillThePictureToo) {
    for (const uint32_t step : {2u, 4u, 8u}) {
        const Judged moved = judge(view_from(0), view_from(0.15f, 1.3f), 5, step);
        EXPECT_GT(moved.shown, 0.9) << step;
        EXPECT_LT(moved.wrong, 0.01 * step) << step;
    }
}

TEST(Reprojection, WhatComesIntoSightIsLeftOut) {
    // From the side the wall behind the box comes out on one side and goes on the other.
    const Judged moved = judge(view_from(-1.2f), view_from(1.2f), 4);
    EXPECT_GT(moved.shown, 0.3);
    EXPECT_LT(moved.shown, 0.9);
    EXPECT_LT(moved.wrong, 0.01);
}

TEST(Reprojection, AnObjectThatTheOldViewDidNotHaveIsNoGhost) {
    // The old view looks over the box.
    View above = view_from(0, 1.2f);
    above.camera.world_from_camera = look_at(Vec3(0, 4.5f, 3), Vec3(0, 2.5f, -4), Vec3(0, 1, 0));
    const Judged moved = judge(above, view_from(0), 4);
    EXPECT_LT(moved.wrong, 0.01);
}

TEST(Reprojection, WhatLiesBehindAnObjectDoesNotShineThroughIt) {
    // The old view stands between the box and the wall, and sees what the box then hides.
    View between = view_from(0);
    between.camera.world_from_camera = look_at(Vec3(0, 1.2f, -0.3f), Vec3(0, 0.6f, -4), Vec3(0, 1, 0));
    between.camera.yfov_radians = 1.4f;
    const Judged moved = judge(between, view_from(0), 4);
    EXPECT_GT(moved.shown, 0.2);
    EXPECT_LT(moved.wrong, 0.01);
}

TEST(Reprojection, TheBackOfACardIsNotItsFront) {
    // The same places, from the other side: the back is dark.
    View behind = view_from(0);
    behind.camera.world_from_camera = look_at(Vec3(0, 1.2f, -3), Vec3(0, 0.6f, 0), Vec3(0, 1, 0));
    const Judged moved = judge(view_from(0), behind, 4);
    EXPECT_GT(moved.shown, 0.0) << "the floor is seen from both sides";
    EXPECT_LT(moved.wrong, 0.01);
}

TEST(Reprojection, OrthographicAndPanoramaViewsMoveToo) {
    for (const Projection projection : {Projection::orthographic, Projection::panorama}) {
        View before = view_from(0), after = view_from(0.1f);
        before.camera.projection = after.camera.projection = projection;
        const Judged moved = judge(before, after, 8);
        EXPECT_GT(moved.shown, 0.85) << name_of(projection);
        EXPECT_LT(moved.wrong, 0.005) << name_of(projection);
    }
}

TEST(Reprojection, OwnSamplesTakeOverAndTheFilmStaysItsOwn) {
    SessionOptions options;
    options.threads = 2;
    options.reproject = true;
    RenderSession session(options);
    session.submit(request_of(view_from(0), 8));
    ASSERT_TRUE(session.wait_until_done(60));
    EXPECT_FALSE(session.latest()->is_reprojected) << "nothing was before it";

    // The guides of the first view are traced when it is done; the next views come from it.
    bool was_reprojected = false;
    for (int i = 1; i <= 200 && !was_reprojected; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        const uint64_t epoch = session.submit(request_of(view_from(0.0005f * static_cast<float>(i)), 1u << 20));
        const Frame* frame = session.latest();
        while (frame == nullptr || frame->epoch != epoch)
            frame = session.latest();
        was_reprojected = frame->is_reprojected;
        if (!was_reprojected) continue;
        EXPECT_EQ(frame->reprojected.size(), frame->image.size());
        EXPECT_NE(std::memcmp(frame->reprojected.data(), frame->image.data(), frame->image.size() * sizeof(Vec4)), 0);
        // Until every pixel has enough of its own.
        while (frame->is_reprojected || frame->epoch != epoch) {
            EXPECT_LT(frame->statistics.min_samples, most_reprojected_samples);
            frame = session.latest();
        }
        EXPECT_GE(frame->statistics.min_samples, most_reprojected_samples);
    }
    EXPECT_TRUE(was_reprojected);

    const RenderRequest last = request_of(view_from(0.3f), 5);
    session.submit(last);
    ASSERT_TRUE(session.wait_until_done(60));
    const Frame* frame = session.latest();
    EXPECT_FALSE(frame->is_reprojected) << "what is done is shown as it is";
    const Film alone = film_of(last.view, 5);
    const Film film = session.snapshot_film();
    EXPECT_EQ(std::memcmp(alone.pixels().data(), film.pixels().data(), alone.pixels().size_bytes()), 0);
}

TEST(Reprojection, AnotherSettingIsAnotherPicture) {
    SessionOptions options;
    options.threads = 2;
    options.reproject = true;
    RenderSession session(options);
    for (int i = 0; i < 6; ++i) {
        RenderRequest request = request_of(view_from(0.01f * static_cast<float>(i)), 5);
        request.settings.max_depth = 1u + static_cast<uint32_t>(i) % 2;
        const uint64_t epoch = session.submit(request);
        const Frame* frame = session.latest();
        while (frame == nullptr || frame->epoch != epoch) {
            frame = session.latest();
            if (frame != nullptr && frame->epoch == epoch) {
                EXPECT_FALSE(frame->is_reprojected);
            }
        }
        session.wait_until_done(60);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

}  // namespace
}  // namespace candela
