// SPDX-License-Identifier: MIT
// Animations in the viewer: their time, the poses that are shown, and what stays as it was.
#include <fstream>

#include "app/pose_choice.h"
#include "tests/viewer/sliding_square.h"
#include "tests/viewer/viewer_fixture.h"

namespace candela {
namespace {

using test::difference;
using test::extent;
using test::options_for;
using test::ViewerTest;

Animation keyed(std::vector<float> times_s) {
    Animation out;
    out.duration_s = times_s.back();
    AnimationChannel channel;
    channel.sampler.times_s = std::make_shared<const std::vector<float>>(std::move(times_s));
    out.channels.push_back(channel);
    return out;
}

TEST(Playback, FramesAreThoseOfTheFileWhereItHasSome) {
    EXPECT_DOUBLE_EQ(frame_step_s(keyed({0, 1})), 1.0 / 24);
    EXPECT_DOUBLE_EQ(frame_step_s(keyed({0, 0.1f, 0.15f, 1})), 1.0 / 24);
    std::vector<float> thirty, dense;
    for (int i = 0; i <= 30; ++i) {
        thirty.push_back(static_cast<float>(i) / 30.0f);
        dense.push_back(static_cast<float>(i) / 240.0f);
    }
    EXPECT_NEAR(frame_step_s(keyed(thirty)), 1.0 / 30, 1e-6);
    EXPECT_DOUBLE_EQ(frame_step_s(keyed(dense)), 1.0 / 24);
}

TEST(Playback, TimeRunsInACircleAndStepsHitFrames) {
    EXPECT_NEAR(advance(0.9, 0.2, 1), 0.1, 1e-12);
    EXPECT_EQ(advance(0.9, 0.2, 0), 0.0);
    EXPECT_NEAR(frame_at(0.26, 0.1, 1), 0.2, 1e-12);
    EXPECT_NEAR(frame_at(0.1 + 0.1 + 0.1, 0.1, 1), 0.3, 1e-12);
    EXPECT_NEAR(step_frames(0.26, 1, 0.1, 1), 0.3, 1e-12);
    EXPECT_NEAR(step_frames(0.26, -1, 0.1, 1), 0.2, 1e-12);
    EXPECT_NEAR(step_frames(0.3, -1, 0.1, 1), 0.2, 1e-12);
    EXPECT_NEAR(step_frames(1.0, 1, 0.1, 1), 0.0, 1e-12);
    EXPECT_NEAR(step_frames(0.0, -1, 0.1, 1), 1.0, 1e-12);
    double time_s = 0;
    for (int i = 0; i < 24; ++i)
        time_s = step_frames(time_s, 1, 1.0 / 24, 1);
    EXPECT_NEAR(time_s, 1.0, 1e-9);
}

class PlaybackTest : public ViewerTest {
  protected:
    PlaybackTest() {
        std::filesystem::create_directories(folder_);
        test::write_sliding_square(file());
    }
    ~PlaybackTest() override {
        std::error_code error;
        std::filesystem::remove_all(folder_, error);
    }
    std::string file() const { return (folder_ / "slide.gltf").string(); }
    // How far the square has been moved.
    float slid() const { return model().job.world->scene->instances.at(0).world_from_object[3].x; }

    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("candela playback " + std::to_string(getpid()));
};

TEST_F(PlaybackTest, SpacePlaysAndStops) {
    start(options_for(file()));
    EXPECT_FALSE(model().playback.animation);
    const ImageRgba8 before = picture();
    press(Key::space);
    EXPECT_TRUE(model().playback.playing);
    // A second and a half in steps of a frame: every pose shows before the next is taken.
    int poses = 0;
    float last = slid();
    for (int i = 0; i < 36; ++i) {
        now_s_ += 1.0 / 24;
        const uint64_t shown = model().frame_epoch;
        for (int k = 0; k < 2000 && model().frame_epoch == shown; ++k) {
            viewer_->update();
            viewer_->draw();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        poses += slid() != last ? 1 : 0;
        last = slid();
    }
    EXPECT_GE(poses, 34);
    EXPECT_LT(viewer_->seconds_until_update(), 0.01);
    press(Key::space);
    EXPECT_FALSE(model().playback.playing);
    finish();
    EXPECT_NEAR(model().playback.time_s, 0.5, 0.05) << "it begins again behind its end";
    EXPECT_NEAR(slid(), 2 * model().playback.time_s, 1e-4f);
    EXPECT_EQ(model().status.spp, 4u) << "a pose that stands converges";
    EXPECT_GT(difference(before, picture()), 2.0);
    EXPECT_GT(viewer_->seconds_until_update(), 0.1);
}

TEST_F(PlaybackTest, BracketsStepAFrame) {
    start(options_for(file()));
    press(Key::right_bracket);
    press(Key::right_bracket);
    finish();
    EXPECT_NEAR(slid(), 2.0f * 2 / 24, 1e-5f);
    press(Key::left_bracket);
    finish();
    EXPECT_NEAR(slid(), 2.0f / 24, 1e-5f);
    press(Key::left_bracket);
    press(Key::left_bracket);
    finish();
    EXPECT_NEAR(slid(), 2, 1e-5f) << "before the beginning is the end";
}

TEST_F(PlaybackTest, PosingKeepsTheViewAndTheSettings) {
    start(options_for(file()));
    drag(MouseButton::left, {100, 60}, {140, 60});
    press(Key::e);
    press(Key::j);
    finish();
    const OrbitView view = model().view;
    const BackgroundKind background = model().options.integrator.background;
    const float exposure = model().display.tone.exposure_ev;
    press(Key::right_bracket);
    press(Key::space);
    now_s_ += 0.2;
    for (int i = 0; i < 50; ++i) {
        viewer_->update();
        viewer_->draw();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    press(Key::space);
    finish();
    EXPECT_NE(slid(), 0);
    EXPECT_EQ(model().view, view);
    EXPECT_EQ(model().options.integrator.background, background);
    EXPECT_EQ(model().job.request.settings.background, background);
    EXPECT_EQ(model().display.tone.exposure_ev, exposure);
}

TEST_F(PlaybackTest, OptionsChooseWhereItStands) {
    RenderOptions options = options_for(file());
    options.animation = "slide";
    options.at_seconds = 0.25;
    start(options);
    EXPECT_EQ(model().playback.animation, 0u);
    EXPECT_NEAR(model().playback.time_s, 0.25, 1e-6);
    EXPECT_NEAR(slid(), 0.5f, 1e-5f);
    const ImageRgba8 before = picture();
    // There and back is the same picture, and a reload comes back to the pose.
    press(Key::right_bracket);
    finish();
    EXPECT_GT(difference(before, picture()), 0.2);
    press(Key::left_bracket);
    finish();
    EXPECT_NEAR(model().playback.time_s, 0.25, 1e-6);
    EXPECT_EQ(difference(before, picture()), 0.0);
    press(Key::f5);
    finish();
    EXPECT_NEAR(slid(), 0.5f, 1e-5f);
    EXPECT_EQ(difference(before, picture()), 0.0);
}

TEST_F(PlaybackTest, TheTimelineSeeks) {
    RenderOptions options = options_for(file());
    options.animation = "slide";
    options.at_seconds = 0.0;
    start(options);
    context_->resize({640, 400});
    viewer_->handle(WindowResized{{640, 400}, {640, 400}, 1});
    finish();
    // The slider fills the right of the panel over the status line, from about 286 to 613.
    drag(MouseButton::left, {300, 340}, {450, 340});
    finish();
    EXPECT_NEAR(model().playback.time_s, 0.5, 0.03);
    EXPECT_NEAR(slid(), 2 * model().playback.time_s, 1e-4f);
    EXPECT_FALSE(model().playback.playing);
    // The button beside it plays.
    click({45, 340});
    for (int i = 0; i < 4; ++i)
        picture();
    EXPECT_TRUE(model().playback.playing);
}

TEST_F(PlaybackTest, ACameraOfTheFileCarriesWhoeverLooksThroughIt) {
    RenderOptions options = options_for(file());
    options.animation = "back";
    options.at_seconds = 0.25;
    start(options);
    EXPECT_NEAR(model().view.camera.position().z, 6, 1e-5f);
    press(Key::right_bracket);
    finish();
    EXPECT_NEAR(model().view.camera.position().z, 4 + 8.0f * 7 / 24, 1e-4f);
    // Who has moved away stays where they are.
    drag(MouseButton::left, {100, 60}, {140, 60});
    finish();
    const OrbitView view = model().view;
    press(Key::right_bracket);
    finish();
    EXPECT_EQ(model().view, view);
}

TEST_F(PlaybackTest, FilesWithoutAnimationsSaySo) {
    start(options_for("assets/cornell_box.glb"));
    press(Key::space);
    press(Key::right_bracket);
    EXPECT_FALSE(model().playback.playing);
    EXPECT_NE(model().notice.find("no animations"), std::string::npos);
    finish();
}

TEST_F(PlaybackTest, ClosingWhileItPlaysJoinsEverything) {
    start(options_for(file()));
    press(Key::space);
    now_s_ += 0.3;
    viewer_->update();
    viewer_.reset();
}

}  // namespace
}  // namespace candela
