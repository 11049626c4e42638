// SPDX-License-Identifier: MIT
// Numbered pictures of a turn and of an animation, written beside the window.
#include "app/viewer/frame_writer.h"

#include <fstream>

#include "app/frame_sequence.h"
#include "renderer/image/codec.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/sliding_square.h"
#include "tests/viewer/viewer_fixture.h"

namespace candela {
namespace {

using test::options_for;
using test::ViewerTest;

TEST(Turntable, GoesOnceAroundThePivot) {
    Camera camera;
    camera.world_from_camera = look_at({0, 1, 5}, {0, 1, 0}, {0, 1, 0});
    const Vec3 pivot(0, 1, 0);
    EXPECT_EQ(turned_camera(camera, pivot, 0, 4), camera);
    EXPECT_EQ(turned_camera(camera, pivot, 4, 4), camera);
    const Camera quarter = turned_camera(camera, pivot, 1, 4);
    EXPECT_LT(glm::distance(quarter.position(), Vec3(5, 1, 0)), 1e-5f) << "counter-clockwise seen from above";
    EXPECT_LT(glm::distance(quarter.forward(), Vec3(-1, 0, 0)), 1e-6f);
    const Camera last = turned_camera(camera, pivot, 3, 4);
    EXPECT_LT(glm::distance(last.position(), Vec3(-5, 1, 0)), 1e-5f);
    EXPECT_EQ(numbered("a/b.c.png", 7), "a/b.c_0007.png");
}

TEST(Sequences, AnAnimationsLastMomentIsNotShownTwice) {
    SequenceSettings settings;
    settings.kind = SequenceKind::animation;
    settings.fps = 24;
    EXPECT_EQ(picture_count(settings, 1.0), 24u);
    EXPECT_EQ(picture_count(settings, 1.01), 25u);
    EXPECT_EQ(picture_count(settings, 0.0), 1u);
    settings.kind = SequenceKind::turntable;
    settings.pictures = 36;
    EXPECT_EQ(picture_count(settings, 1.0), 36u);
}

class Sequence : public ViewerTest {
  protected:
    // In a folder of the test's own; returns what the window says at the end.
    std::string write(const SequenceSettings& settings) {
        const std::filesystem::path home = std::filesystem::current_path();
        std::filesystem::current_path(folder_.path());
        PanelEdits edits;
        edits.write_sequence = settings;
        viewer_->apply(edits);
        do {
            viewer_->update();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        } while (model().writing);
        std::filesystem::current_path(home);
        return model().notice;
    }
    ImageRgba8 read(const std::string& name) const {
        std::ifstream file(folder_.path() / name, std::ios::binary);
        const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        return decode_ldr(std::as_bytes(std::span(bytes)));
    }

    test::TemporaryFolder folder_;
};

TEST_F(Sequence, ATurnBeginsWithTheViewThatIsShown) {
    start(options_for((std::filesystem::current_path() / "assets/cornell_box.glb").string(), 1));
    drag(MouseButton::left, {100, 60}, {120, 60});
    finish();
    now_s_ += 10;
    const ImageRgba8 shown = picture();
    EXPECT_EQ(write({SequenceKind::turntable, 2, 24, 1}),
              "wrote 2 pictures: candela-cornell_box-turn-001_0000.png to candela-cornell_box-turn-001_0001.png");
    const ImageRgba8 first = read("candela-cornell_box-turn-001_0000.png");
    ASSERT_EQ(first.width(), shown.width());
    // The panels lie over the window's picture, at its foot.
    EXPECT_LT(test::difference(first, shown), 0.01);
    EXPECT_GT(test::difference(first, read("candela-cornell_box-turn-001_0001.png")), 2.0);
    write({SequenceKind::turntable, 1, 24, 1});
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "candela-cornell_box-turn-002_0000.png"))
        << "what is there is not written over";
}

TEST_F(Sequence, AnAnimationIsWrittenFromTheViewThatIsShown) {
    test::write_sliding_square((folder_.path() / "slide.gltf").string());
    start(options_for((folder_.path() / "slide.gltf").string(), 4));
    now_s_ += 10;
    const ImageRgba8 shown = picture();
    EXPECT_EQ(write({SequenceKind::animation, 36, 2, 4}),
              "wrote 2 pictures: candela-slide-animation-001_0000.png to candela-slide-animation-001_0001.png");
    const ImageRgba8 first = read("candela-slide-animation-001_0000.png"),
                     second = read("candela-slide-animation-001_0001.png");
    EXPECT_LT(test::difference(first, shown), 0.01);
    // Half a second later the square has gone a metre to the right: 34 pixels.
    EXPECT_GT(first(75, 75).r, first(75, 75).b + 20);
    EXPECT_LT(second(75, 75).r, second(75, 75).b + 20);
    EXPECT_EQ(model().playback.animation, std::nullopt) << "the window stays as it is";
}

}  // namespace
}  // namespace candela
