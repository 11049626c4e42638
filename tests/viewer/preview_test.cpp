// SPDX-License-Identifier: MIT
// A scene is shown before its pictures are decoded, and what comes of it when they never are.
#include <atomic>

#include "app/exit_status.h"
#include "tests/viewer/viewer_fixture.h"

namespace candela {
namespace {

using namespace test;

const std::string textured = "assets/alpha_cards.glb";

// Loads that stand still once their preview is out, until the test lets them go on, or fail.
class PreviewTest : public ViewerTest {
  protected:
    PreviewTest() {
        prepare_ = [this](const RenderOptions& options, const std::function<void(const char*, double)>& progress,
                          const std::atomic<bool>* cancel, const std::function<void(RenderJob)>& preview) {
            const auto shown = [&](RenderJob job) {
                if (preview) preview(std::move(job));
                while (!go_on_ && !*cancel)
                    std::this_thread::sleep_for(std::chrono::milliseconds(1));
                if (fails_) throw CommandError(ExitStatus::unreadable_scene, options.scene + ": no memory is left");
            };
            return prepare_render(options, progress, cancel, shown);
        };
    }
    // Until a preview's picture, or anything else of the file, has come.
    void wait_for_picture_of(const std::string& title) {
        const auto begin = std::chrono::steady_clock::now();
        const uint64_t before = viewer_->model().frame_epoch;
        while (viewer_->title() != title || viewer_->model().frame_epoch == before) {
            viewer_->update();
            viewer_->draw();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            ASSERT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60)) << "no preview comes";
        }
    }
    bool shows_pictures() const {
        const Scene& scene = *model().job.world->scene;
        return std::all_of(scene.images.begin(), scene.images.end(),
                           [](const SceneImage& image) { return image.pixels != nullptr; });
    }

    std::atomic<bool> go_on_{false}, fails_{false};
};

TEST_F(PreviewTest, IsShownUntilThePicturesAreThere) {
    start(options_for("assets/cornell_box.glb"));
    viewer_->open(textured);
    wait_for_picture_of("candela - alpha_cards.glb");
    EXPECT_FALSE(shows_pictures());
    EXPECT_TRUE(model().loading);
    EXPECT_FALSE(viewer_->finished());
    EXPECT_EQ(viewer_->frame()->statistics.non_finite, 0u);
    const ImageRgba8 preview = picture();
    EXPECT_GT(difference(preview, ImageRgba8(preview.width(), preview.height(), Rgba8(0, 0, 0, 255))), 20.0) << "dark";
    go_on_ = true;
    finish();
    EXPECT_TRUE(shows_pictures());
    EXPECT_FALSE(model().loading);
    const ImageRgba8 whole = picture();
    EXPECT_GT(difference(preview, whole), 0.5);

    // The same as where nothing was shown before.
    prepare_ = nullptr;
    viewer_.reset();
    context_.reset();
    start(options_for(textured));
    EXPECT_EQ(difference(whole, picture()), 0.0);
}

TEST_F(PreviewTest, WhatThePersonDoesMeanwhileStays) {
    start(options_for("assets/cornell_box.glb"));
    viewer_->open(textured);
    wait_for_picture_of("candela - alpha_cards.glb");
    drag(MouseButton::left, Vec2(60, 60), Vec2(120, 80));
    const Mat4 turned = model().view.camera.world_from_camera;
    go_on_ = true;
    finish();
    EXPECT_TRUE(shows_pictures());
    EXPECT_EQ(model().view.camera.world_from_camera, turned);
    EXPECT_EQ(model().job.request.view.camera.world_from_camera, turned);
}

TEST_F(PreviewTest, AFailureAfterItBringsTheOldSceneBack) {
    start(options_for("assets/cornell_box.glb"));
    drag(MouseButton::left, Vec2(60, 60), Vec2(120, 80));
    finish();
    const ImageRgba8 before = picture();
    viewer_->open(textured);
    wait_for_picture_of("candela - alpha_cards.glb");
    EXPECT_GT(difference(before, picture()), 0.5);
    fails_ = go_on_ = true;
    finish();
    EXPECT_EQ(viewer_->title(), "candela - cornell_box.glb");
    EXPECT_EQ(viewer_->load_status(), ExitStatus::unreadable_scene);
    EXPECT_NE(model().notice.find("no memory is left"), std::string::npos);
    press(Key::escape);
    finish();
    EXPECT_EQ(difference(before, picture()), 0.0);
}

TEST_F(PreviewTest, AFailureAfterItLeavesNothingWhereNothingWas) {
    waits_ = false;
    start(options_for(textured));
    wait_for_picture_of("candela - alpha_cards.glb");
    fails_ = go_on_ = true;
    finish();
    EXPECT_FALSE(model().has_scene());
    EXPECT_EQ(viewer_->frame(), nullptr);
    EXPECT_NE(viewer_->load_error(), "");
}

TEST_F(PreviewTest, ThatIsReplacedIsNotWhatComesBack) {
    start(options_for("assets/cornell_box.glb"));
    const ImageRgba8 before = picture();
    viewer_->open(textured);
    wait_for_picture_of("candela - alpha_cards.glb");
    viewer_->handle(FilesDropped{{"assets/no_such_file.glb"}, {}});
    finish();
    EXPECT_EQ(viewer_->title(), "candela - cornell_box.glb");
    press(Key::escape);
    finish();
    EXPECT_EQ(difference(before, picture()), 0.0);

    // Nor is it where another preview has been shown since.
    viewer_->open(textured);
    wait_for_picture_of("candela - alpha_cards.glb");
    viewer_->open(textured);
    wait_for_picture_of("candela - alpha_cards.glb");
    fails_ = go_on_ = true;
    finish();
    EXPECT_EQ(viewer_->title(), "candela - cornell_box.glb");
    press(Key::escape);
    finish();
    EXPECT_EQ(difference(before, picture()), 0.0);
    fails_ = go_on_ = false;

    // A scene that can be read wins over both.
    viewer_->open(textured);
    wait_for_picture_of("candela - alpha_cards.glb");
    viewer_->handle(FilesDropped{{"assets/veach_plates.glb"}, {}});
    go_on_ = true;
    finish();
    EXPECT_EQ(viewer_->title(), "candela - veach_plates.glb");
}

TEST_F(PreviewTest, ClosingMeanwhileJoinsEverything) {
    start(options_for("assets/cornell_box.glb"));
    viewer_->open(textured);
    wait_for_picture_of("candela - alpha_cards.glb");
    viewer_.reset();
}

}  // namespace
}  // namespace candela
