// SPDX-License-Identifier: MIT
// The error view: maps beside the picture, their wipe, and what is said of the error.
#include "app/viewer/error_words.h"

#include "app/viewer/panels.h"
#include "tests/viewer/viewer_fixture.h"

namespace candela {
namespace {

using test::difference;
using test::extent;
using test::options_for;
using test::ViewerTest;

constexpr Modifiers shift{.shift = true};

TEST(ErrorWords, NumbersHaveTwoDigitsThatCount) {
    EXPECT_EQ(percent_text(0.0082), "0.82 %");
    EXPECT_EQ(percent_text(0.0208), "2.1 %");
    EXPECT_EQ(percent_text(0.123), "12 %");
    EXPECT_EQ(percent_text(0.09996), "10 %");
    EXPECT_EQ(percent_text(1.234), "120 %");
    EXPECT_EQ(percent_text(0.000456), "0.046 %");
    EXPECT_EQ(percent_text(0), "0 %");
    EXPECT_EQ(about_text(0.2), "1 s");
    EXPECT_EQ(about_text(42.4), "42 s");
    EXPECT_EQ(about_text(600), "10 min");
    EXPECT_EQ(about_text(3 * 3600), "3.0 h");
}

TEST(ErrorWords, TheNextTargetIsTheOneAskedForOrARoundNumberBelow) {
    EXPECT_DOUBLE_EQ(next_target(0.03, std::nullopt), 0.02);
    EXPECT_DOUBLE_EQ(next_target(0.0201, std::nullopt), 0.01) << "what is as good as reached is no target";
    EXPECT_DOUBLE_EQ(next_target(0.7, std::nullopt), 0.5);
    EXPECT_DOUBLE_EQ(next_target(0.03, 0.005), 0.005);
    EXPECT_DOUBLE_EQ(next_target(0.004, 0.005), 0.002);
}

TEST(ErrorWords, TheSentenceTellsMeanBoundAndTime) {
    FilmStatistics film;
    film.relative_error = std::numeric_limits<double>::quiet_NaN();
    ErrorHistory history;
    EXPECT_TRUE(error_words(film, history, std::nullopt, true).sentence.empty());
    for (uint32_t n = 2; n <= 64; n += 2)
        history.add({n, 0.5 * n, 0.16 / std::sqrt(n), 0.4 / std::sqrt(n)});
    film.relative_error = 0.02;
    film.relative_error_95 = 0.05;
    // At 0.02 after 32 s; half of it takes four times as long.
    EXPECT_EQ(error_words(film, history, std::nullopt, true).sentence,
              "mean error ±2.0 %, 95 % of pixels within ±5.0 %, about 96 s to ±1 %");
    EXPECT_EQ(error_words(film, history, std::nullopt, false).sentence,
              "mean error ±2.0 %, 95 % of pixels within ±5.0 %");
    EXPECT_EQ(error_words(film, history, std::nullopt, true).brief, "error ±2.0 %, 95 % within ±5.0 %");
}

// What the picture shows left and right of the line, away from line, legend and labels.
double changed(const ImageRgba8& a, const ImageRgba8& b, int x_begin, int x_end) {
    double sum = 0;
    int count = 0;
    for (int y = 4; y < 30; ++y) {
        for (int x = x_begin; x < x_end; ++x, ++count) {
            for (int c = 0; c < 3; ++c)
                sum += std::abs(a(x, y)[c] - b(x, y)[c]);
        }
    }
    return sum / (3.0 * count);
}

TEST_F(ViewerTest, VShowsTheErrorToTheRightOfTheWipeAndHidesItAgain) {
    start(options_for("assets/cornell_box.glb"));
    const uint64_t epoch = model().status.epoch;
    const ImageRgba8 plain = picture();
    press(Key::v);
    finish();
    const ImageRgba8 mapped = picture();
    ASSERT_GT(viewer_->frame()->maps.size(), 0u);
    EXPECT_EQ(changed(plain, mapped, 0, 98), 0) << "left of the line stands the picture";
    EXPECT_GT(changed(plain, mapped, 103, 200), 20);
    const float error = viewer_->frame()->maps(150, 20).x;
    const Vec3 expected = 255.0f * heat_color(HeatScale{1e-3f, 1, true}.position(error));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mapped(150, 20)[c], expected[c], 1);
    press(Key::v);
    finish();
    EXPECT_EQ(difference(plain, picture()), 0);
    EXPECT_EQ(model().status.epoch, epoch) << "nothing is rendered anew";
}

TEST_F(ViewerTest, ShiftVStepsThroughTheMaps) {
    start(options_for("assets/cornell_box.glb"));
    ImageRgba8 last = picture();
    for (const PixelMap map : {PixelMap::error, PixelMap::samples, PixelMap::rays, PixelMap::bounces}) {
        press(Key::v, shift);
        finish();
        EXPECT_EQ(model().map.map, map);
        EXPECT_GT(changed(last, picture(), 103, 200), 2) << static_cast<int>(map);
        last = picture();
    }
    EXPECT_GE(model().map_scale.high, 2) << "bounces";
    press(Key::v, shift);
    EXPECT_EQ(model().map.map, PixelMap::error);
}

TEST_F(ViewerTest, TheWipeIsDraggedByItsLineOrMovedByKeys) {
    start(options_for("assets/cornell_box.glb"));
    press(Key::v);
    finish();
    const OrbitView view = model().view;
    drag(MouseButton::left, {103, 60}, {40, 70});
    EXPECT_EQ(model().view, view);
    EXPECT_FLOAT_EQ(model().map.wipe, 0.2f);
    const ImageRgba8 moved = picture();
    press(Key::period);
    EXPECT_FLOAT_EQ(model().map.wipe, 0.25f);
    EXPECT_GT(changed(moved, picture(), 42, 48), 5);
    for (int i = 0; i < 30; ++i)
        press(Key::comma);
    EXPECT_EQ(model().map.wipe, 0);
    // Elsewhere the same drag turns the scene; without a map so does one at the line's place.
    drag(MouseButton::left, {103, 60}, {60, 60});
    EXPECT_NE(model().view, view);
    press(Key::v);
    const OrbitView turned = model().view;
    drag(MouseButton::left, {0, 60}, {40, 60});
    EXPECT_NE(model().view, turned);
}

TEST_F(ViewerTest, AMapThatIsAskedForAtTheStartComesWithTheLastPicture) {
    RenderOptions options = options_for("assets/cornell_box.glb");
    options.map = PixelMap::rays;
    options.wipe = 0.25f;
    options.open = {"statistics"};
    start(options);
    EXPECT_TRUE(model().show_statistics);
    ASSERT_GT(viewer_->frame()->maps.size(), 0u);
    EXPECT_EQ(wipe_x(model()), 50.0f);
    EXPECT_GE(model().map_scale.high, viewer_->frame()->maps(150, 20)[static_cast<int>(PixelMap::rays)]);
    // A view that is edited keeps it.
    press(Key::digit_7);
    finish();
    EXPECT_GT(viewer_->frame()->maps.size(), 0u);
}

TEST_F(ViewerTest, ThePanelChoosesMaps) {
    start(options_for("assets/cornell_box.glb"));
    const ImageRgba8 plain = picture();
    // As the panel leaves it.
    ViewerModel& edited = const_cast<ViewerModel&>(model());
    edited.map = {true, PixelMap::bounces, 0.5f};
    PanelEdits edits;
    edits.map = true;
    viewer_->apply(edits);
    finish();
    EXPECT_GT(changed(plain, picture(), 103, 200), 2);
}

}  // namespace
}  // namespace candela
