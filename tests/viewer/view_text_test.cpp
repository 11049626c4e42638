// SPDX-License-Identifier: MIT
// A view leaves as text and comes back as the same view; what is no view says so.
#include "app/viewer/view_text.h"

namespace candela {
namespace {

Bookmark some_view() {
    Bookmark out;
    out.view.camera.world_from_camera = look_at({3.25f, 2, -5}, {0.5f, 0.25f, 1}, {0, 1, 0});
    out.view.pivot = {0.5f, 0.25f, 1};
    out.view.camera.yfov_radians = 0.61f;
    out.view.camera.focus_distance_m = pivot_distance(out.view);
    out.tone = {-0.75f, ToneCurve::aces};
    return out;
}

void expect_alike(const Bookmark& a, const Bookmark& b) {
    for (int column = 0; column < 4; ++column) {
        EXPECT_LT(
            glm::distance(Vec3(a.view.camera.world_from_camera[column]), Vec3(b.view.camera.world_from_camera[column])),
            1e-5f)
            << column;
    }
    EXPECT_LT(glm::distance(a.view.pivot, b.view.pivot), 1e-4f);
    EXPECT_EQ(a.view.camera.projection, b.view.camera.projection);
    EXPECT_NEAR(a.view.camera.yfov_radians, b.view.camera.yfov_radians, 1e-5f);
    EXPECT_NEAR(a.view.camera.ortho_half_height_m, b.view.camera.ortho_half_height_m, 1e-4f);
    EXPECT_EQ(a.view.camera.aperture_diameter_m, b.view.camera.aperture_diameter_m);
    EXPECT_EQ(a.view.camera.aperture_blades, b.view.camera.aperture_blades);
    EXPECT_NEAR(a.view.camera.focus_distance_m, b.view.camera.focus_distance_m, 1e-4f);
    EXPECT_EQ(a.tone.exposure_ev, b.tone.exposure_ev);
    EXPECT_EQ(a.tone.curve, b.tone.curve);
}

TEST(ViewText, ComesBackAsTheViewThatItWas) {
    Bookmark views[] = {some_view(), some_view(), some_view(), some_view()};
    views[0].view.camera.ortho_half_height_m = std::tan(0.5f * 0.61f) * pivot_distance(views[0].view);
    views[1].view.camera.aperture_diameter_m = 0.05f;
    views[1].view.camera.focus_distance_m = 2.5f;
    views[1].view.camera.aperture_blades = 6;
    views[1].view.camera.ortho_half_height_m = views[0].view.camera.ortho_half_height_m;
    // Straight down, where nothing but --up says which way is up.
    views[2].view.camera.world_from_camera = look_at({1, 9, 2}, {1, 0, 2}, {0.6f, 0, 0.8f});
    views[2].view.pivot = {1, 0, 2};
    views[2].view.camera.focus_distance_m = 9;
    views[2].view.camera.ortho_half_height_m = 9 * std::tan(0.5f * 0.61f);
    views[3].view.camera.projection = Projection::orthographic;
    views[3].view.camera.ortho_half_height_m = 1.5f;
    views[3].view.camera.yfov_radians = 2 * std::atan(1.5f / pivot_distance(views[3].view));
    for (const Bookmark& view : views) {
        std::string problem;
        Bookmark other;
        const std::optional<Bookmark> back = view_from_text(text_of(view), other, problem);
        ASSERT_TRUE(back) << problem;
        expect_alike(*back, view);
    }
}

TEST(ViewText, TakesWhatAPersonWrites) {
    std::string problem;
    const Bookmark base = some_view();
    const std::optional<Bookmark> view =
        view_from_text("  --eye=0,1,5\n --target 0,1,0\t--exposure -2 ", base, problem);
    ASSERT_TRUE(view) << problem;
    EXPECT_EQ(view->view.camera.position(), Vec3(0, 1, 5));
    EXPECT_EQ(view->view.camera.forward(), Vec3(0, 0, -1));
    EXPECT_EQ(view->tone.exposure_ev, -2);
    EXPECT_EQ(view->tone.curve, base.tone.curve) << "what is not said stays";
    EXPECT_EQ(view->view.camera.yfov_radians, base.view.camera.yfov_radians);
}

TEST(ViewText, WhatIsNoViewSaysWhy) {
    const std::pair<const char*, const char*> cases[] = {
        {"", "empty"},
        {" \n ", "empty"},
        {"https://example.org/a/rather/long/address", "\"https://example.org/a/ra…\""},
        {"--eye 0,0,5", "no --eye and --target"},
        {"--fov 30", "no --eye and --target"},
        {"--eye 0,0,5 --target 0,0", "--target 0,0: that is not three numbers"},
        {"--eye 0,0,5 --target 0,0,0,1", "three numbers"},
        {"--eye 0,0,5 --target 0,0,x", "three numbers"},
        {"--eye 0,0,nan --target 0,0,0", "three numbers"},
        {"--eye 0,0,5 --target 0,0,5", "same point"},
        {"--eye 0,0,5 --target 0,0,0 --fov 360", "--fov 360 is not"},
        {"--eye 0,0,5 --target 0,0,0 --fov", "--fov has no value"},
        {"--eye 0,0,5 --eye 0,0,4 --target 0,0,0", "--eye stands there twice"},
        {"--eye 0,0,5 --target 0,0,0 --tonemap kodak", "--tonemap kodak is not known"},
        {"--eye 0,0,5 --target 0,0,0 --record /tmp/x", "--record"},
        {"--eye 1e38,1e38,1e38 --target -1e38,-1e38,-1e38", "looks nowhere"},
    };
    for (const auto& [text, why] : cases) {
        std::string problem;
        EXPECT_FALSE(view_from_text(text, {}, problem)) << text;
        EXPECT_NE(problem.find(why), std::string::npos) << text << ": " << problem;
        EXPECT_EQ(problem.find('\n'), std::string::npos);
    }
    std::string problem;
    EXPECT_FALSE(view_from_text(std::string(1 << 20, 'x'), {}, problem));
    EXPECT_LT(problem.size(), 200u);
}

}  // namespace
}  // namespace candela
