// SPDX-License-Identifier: MIT
// Going back to a view: nothing of it is lost. And how long an input waits for its picture.
#include <ctime>
#include <fstream>

#include "renderer/image/codec.h"
#include "renderer/image/compare.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/viewer_fixture.h"

namespace candela {
namespace {

using test::difference;
using test::options_for;
using test::ViewerTest;

TEST_F(ViewerTest, ABookmarkBringsBackViewLensExposureAndSamples) {
    start(options_for("assets/cornell_box.glb", 6));
    const ImageRgba8 plain = picture();
    press(Key::digit_9);
    press(Key::e);
    press(Key::t);
    finish();
    now_s_ += 10;
    const OrbitView view = model().view;
    const ToneSettings tone = model().display.tone;
    ASSERT_EQ(view.camera.projection, Projection::orthographic);
    press(Key::digit_4, {.ctrl = true});
    now_s_ += 10;
    const ImageRgba8 stored = picture();

    press(Key::c);
    press(Key::e, {.shift = true});
    drag(MouseButton::left, {100, 60}, {140, 60});
    finish();
    now_s_ += 10;
    EXPECT_GT(difference(stored, picture()), 2.0);
    press(Key::digit_4, {.shift = true});
    finish();
    now_s_ += 10;
    EXPECT_EQ(model().view, view);
    EXPECT_EQ(model().display.tone.exposure_ev, tone.exposure_ev);
    EXPECT_EQ(model().display.tone.curve, tone.curve);
    EXPECT_EQ(difference(stored, picture()), 0.0);
    EXPECT_EQ(model().status.resumed_samples, 6u) << "it was rendered again";
    EXPECT_GT(difference(stored, plain), 2.0);
}

TEST_F(ViewerTest, AnEmptyBookmarkSaysHowToFillIt) {
    start(options_for("assets/cornell_box.glb"));
    const OrbitView view = model().view;
    press(Key::digit_0, {.shift = true});
    EXPECT_EQ(model().view, view);
    EXPECT_NE(model().notice.find("Ctrl+0"), std::string::npos) << model().notice;
}

TEST_F(ViewerTest, ViewsThatWereLookedAtAreGoneBackToAndOn) {
    start(options_for("assets/cornell_box.glb"));
    std::vector<OrbitView> views{model().view};
    for (const Key key : {Key::digit_1, Key::digit_3, Key::digit_7}) {
        press(key);
        finish();
        views.push_back(model().view);
    }
    const auto alt = [&](Key key) {
        press(key, {.alt = true});
        finish();
    };
    for (const size_t i : {2u, 1u, 0u}) {
        alt(Key::left);
        EXPECT_EQ(model().view, views[i]) << i;
    }
    alt(Key::left);
    EXPECT_EQ(model().view, views[0]);
    EXPECT_NE(model().notice.find("no view before"), std::string::npos) << model().notice;
    for (const size_t i : {1u, 2u, 3u}) {
        alt(Key::right);
        EXPECT_EQ(model().view, views[i]) << i;
    }
}

TEST_F(ViewerTest, LightsAreReweightedWithoutARestart) {
    RenderOptions options = options_for("assets/cornell_box.glb", 6);
    options.integrator.reuse_paths = false;  // paths are not shared where lights are kept apart
    start(options);
    const ImageRgba8 before = picture();
    PanelEdits edits;
    edits.light_groups = true;
    viewer_->apply(edits);
    finish();
    now_s_ += 10;
    ASSERT_TRUE(model().lights.groups != nullptr);
    EXPECT_EQ(difference(before, picture()), 0.0) << "to keep lights apart changes nothing";
    const uint64_t epoch = model().status.epoch;

    edits = {};
    edits.light_weights = model().lights.weights;
    for (LightWeight& weight : *edits.light_weights)
        weight = {0.25f, Vec3(1, 0.5f, 0.5f)};
    viewer_->apply(edits);
    EXPECT_FALSE(viewer_->finished());
    finish();
    EXPECT_EQ(model().status.epoch, epoch);
    EXPECT_GT(difference(before, picture()), 10.0);
    EXPECT_NE(model().lights.words().find("× 0.25 (1 0.5 0.5)"), std::string::npos) << model().lights.words();

    // What is saved is what is shown, and says so.
    const test::TemporaryFolder folder;
    const std::filesystem::path saved = folder.path() / "saved.exr";
    viewer_->save(saved.string());
    EXPECT_LT(compare_images(read_linear(saved), viewer_->frame()->image).rel_mse, 1e-9);
    std::ifstream file(saved, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    EXPECT_NE(bytes.find("× 0.25 (1 0.5 0.5)"), std::string::npos);

    edits.light_weights->assign(edits.light_weights->size(), {});
    viewer_->apply(edits);
    finish();
    EXPECT_EQ(difference(before, picture()), 0.0);
    EXPECT_EQ(model().lights.words(), "");
}

TEST(ViewHistory, AnotherWayForgetsTheOldOne) {
    ViewHistory history;
    const auto view = [](float x) {
        OrbitView out;
        out.pivot.x = x;
        return out;
    };
    for (const float x : {0.0f, 1.0f, 1.0f, 2.0f})
        history.add(view(x));
    EXPECT_EQ(history.step(-1), view(1));
    history.add(view(3));
    EXPECT_FALSE(history.can_step(1));
    EXPECT_EQ(history.step(-1), view(1));
    EXPECT_EQ(history.step(-1), view(0));
    EXPECT_EQ(history.step(-1), std::nullopt);
    EXPECT_EQ(history.step(1), view(1));
    EXPECT_EQ(history.step(1), view(3));
}

TEST(LatencyMeter, AnInputWaitsUntilAPictureOfItsEpochIsShown) {
    LatencyMeter meter;
    meter.submitted(3, 1.0);
    meter.submitted(4, 1.5);
    EXPECT_TRUE(meter.waits(3));
    meter.shown(2, 1.6);
    EXPECT_EQ(meter.summary().count, 0u);
    meter.shown(4, 2.0);
    EXPECT_FALSE(meter.waits(4));
    EXPECT_EQ(meter.summary().count, 1u) << "one picture answers both";
    EXPECT_EQ(meter.summary().last_s, 1.0) << "the oldest input waited longest";
    meter.shown(4, 3.0);
    EXPECT_EQ(meter.summary().count, 1u);
    meter.submitted(5, 10.0);
    meter.shown(6, 10.25);
    EXPECT_EQ(meter.summary().last_s, 0.25);
    EXPECT_EQ(meter.summary().worst_s, 1.0);
}

TEST_F(ViewerTest, LatencyIsFromTheInputToThePresentedPicture) {
    start(options_for("assets/cornell_box.glb"));
    viewer_->presented();
    EXPECT_EQ(model().latency.count, 0u) << "to open a scene is no edit";
    const uint64_t before = model().frame_epoch;
    press(Key::digit_1);
    now_s_ += 0.5;
    viewer_->presented();
    EXPECT_EQ(model().latency.count, 0u) << "the old picture is no answer";
    finish();
    EXPECT_GT(model().frame_epoch, before);
    const double input_s = now_s_;
    viewer_->presented();
    ASSERT_EQ(model().latency.count, 1u);
    EXPECT_NEAR(model().latency.last_s, input_s - 100 - 0.3, 1e-6) << "the clock stood at 100.3 when the key came";
}

TEST_F(ViewerTest, AViewThatIsDoneTakesNoTimeOfTheProcessor) {
    start(options_for("assets/cornell_box.glb"));
    const std::clock_t cpu_before = std::clock();
    const auto begin = std::chrono::steady_clock::now();
    const auto elapsed_s = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    while (elapsed_s() < 1.0) {
        std::this_thread::sleep_for(std::chrono::duration<double>(viewer_->seconds_until_update()));
        EXPECT_FALSE(viewer_->update());
    }
    const double cpu_s = static_cast<double>(std::clock() - cpu_before) / CLOCKS_PER_SEC;
    EXPECT_LT(cpu_s, 0.005 * elapsed_s());
}

}  // namespace
}  // namespace candela
