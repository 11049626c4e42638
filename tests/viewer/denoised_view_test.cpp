// SPDX-License-Identifier: MIT
// The denoised preview: when it is shown, that it is told from the truth, and its files.
#include "renderer/image/codec.h"
#include "renderer/image/compare.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/viewer_fixture.h"

namespace candela {
namespace {

using test::difference;
using test::options_for;
using test::ViewerTest;

TEST_F(ViewerTest, DShowsTheDenoisedPictureAndTheTrueOneAgain) {
    start(options_for("assets/cornell_box.glb"));
    const ImageRgba8 noisy = picture();
    const uint64_t epoch = model().status.epoch;
    const ImageRgba32f truth = viewer_->frame()->image;
    press(Key::d);
    finish();
    ASSERT_TRUE(model().denoised_spp.has_value());
    EXPECT_EQ(*model().denoised_spp, 4u);
    EXPECT_GT(difference(noisy, picture()), 3);
    EXPECT_EQ(viewer_->frame()->image.pixels(), truth.pixels()) << "the frame stays the truth";
    EXPECT_EQ(model().status.epoch, epoch) << "nothing is rendered anew";
    press(Key::d);
    finish();
    EXPECT_FALSE(model().denoised_spp.has_value());
    EXPECT_EQ(difference(noisy, picture()), 0);
}

TEST_F(ViewerTest, AnotherViewIsDenoisedToo) {
    RenderOptions options = options_for("assets/cornell_box.glb");
    options.denoise = true;
    start(options);
    ASSERT_TRUE(model().denoised_spp.has_value());
    const ImageRgba8 front = picture();
    press(Key::digit_7);
    viewer_->update();
    finish();
    EXPECT_TRUE(model().denoised_spp.has_value());
    EXPECT_GT(difference(front, picture()), 3);
}

TEST_F(ViewerTest, TheTruthIsSavedUnlessTheDenoisedPictureIsAskedFor) {
    RenderOptions options = options_for("assets/cornell_box.glb");
    start(options);
    const test::TemporaryFolder folder;
    const std::string path = (folder.path() / "truth.exr").string(), other = (folder.path() / "denoised.exr").string();
    EXPECT_THROW(viewer_->save_denoised(other), CommandError);
    press(Key::d);
    finish();
    viewer_->save(path);
    viewer_->save_denoised(other);
    const ImageRgba32f truth = read_linear(path), denoised = read_linear(other);
    EXPECT_LT(compare_images(truth, viewer_->frame()->image).rel_mse, 1e-9);
    EXPECT_GT(compare_images(truth, denoised).rel_mse, 1e-3);
}

}  // namespace
}  // namespace candela
