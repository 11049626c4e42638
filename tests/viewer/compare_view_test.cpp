// SPDX-License-Identifier: MIT
// Two settings beside each other, and a reference picture.
#include "app/viewer/compared_settings.h"

#include "app/viewer/panels.h"
#include "renderer/image/codec.h"
#include "renderer/image/heat.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/viewer_fixture.h"

namespace candela {
namespace {

using test::difference;
using test::extent;
using test::options_for;
using test::ViewerTest;

TEST(ComparedSettings, WordsReplaceWhatTheyName) {
    IntegratorSettings settings;
    settings.sampler = SamplerKind::independent;
    std::string unknown;
    EXPECT_EQ(compared_settings(settings, {"light"}, &unknown),
              (ComparedSettings{Estimator::light, SamplerKind::independent, 0}));
    EXPECT_EQ(compared_settings(settings, {"bsdf", "sobol", "depth=3"}, &unknown),
              (ComparedSettings{Estimator::bsdf, SamplerKind::sobol, 3}));
    EXPECT_EQ(unknown, "");
    for (const char* word : {"depth=", "depth=x", "depth=2x", "mist"}) {
        unknown.clear();
        compared_settings(settings, {word, "mis"}, &unknown);
        EXPECT_EQ(unknown, word);
    }
    EXPECT_EQ(opposite_of({}).estimator, Estimator::bsdf);
    EXPECT_EQ(opposite_of(opposite_of({}).in({})).estimator, Estimator::light);
}

TEST(ComparedSettings, SidesAreNamedByWhatDiffers) {
    IntegratorSettings a, b;
    EXPECT_EQ(words_of(a, b), "both techniques");
    b.estimator = Estimator::bsdf;
    EXPECT_EQ(words_of(a, b), "both techniques");
    EXPECT_EQ(words_of(b, a), "directions");
    a.max_depth = 2;
    a.sampler = SamplerKind::independent;
    EXPECT_EQ(words_of(a, b), "both techniques, independent points, depth 2");
    EXPECT_EQ(words_of(b, a), "directions, Sobol points, any depth");
}

// Mean absolute difference of columns [begin, end) above everything that is drawn over the picture.
double changed(const ImageRgba8& a, const ImageRgba8& b, int begin, int end) {
    double sum = 0;
    for (int y = 0; y < 45; ++y) {
        for (int x = begin; x < end; ++x) {
            for (int c = 0; c < 3; ++c)
                sum += std::abs(a(x, y)[c] - b(x, y)[c]);
        }
    }
    return sum / (3.0 * 45 * (end - begin));
}

TEST_F(ViewerTest, BShowsOtherSettingsToTheRightOfTheWipe) {
    RenderOptions options = options_for("assets/cornell_box.glb");
    start(options);
    const ImageRgba8 plain = picture();
    const ImageRgba32f before = viewer_->frame()->image;
    press(Key::b);
    finish();
    now_s_ += 10;
    ASSERT_TRUE(model().comparison.shown);
    EXPECT_EQ(model().comparison.status.spp, 4u);
    EXPECT_GT(model().comparison.film.relative_error, model().film.relative_error) << "directions miss the lamp";
    EXPECT_FALSE(comparison_words(model()).empty());
    const ImageRgba8 both = picture();
    EXPECT_EQ(viewer_->frame()->image.pixels(), before.pixels()) << "half of the cores make the same picture";
    EXPECT_EQ(changed(plain, both, 0, 98), 0);
    EXPECT_GT(changed(plain, both, 103, 200), 10);

    // What stands at the right is what those settings render alone.
    options.integrator.estimator = Estimator::bsdf;
    press(Key::b);
    viewer_.reset();
    context_.reset();
    start(options);
    EXPECT_EQ(changed(picture(), both, 103, 200), 0);
}

TEST_F(ViewerTest, AComparisonFollowsTheViewAndEndsWithoutATrace) {
    start(options_for("assets/cornell_box.glb"));
    press(Key::b);
    finish();
    const ImageRgba8 front = picture();
    press(Key::digit_7);
    finish();
    EXPECT_GT(changed(front, picture(), 103, 200), 10);
    press(Key::b);
    finish();
    const ImageRgba8 top = picture();
    viewer_.reset();
    context_.reset();
    start(options_for("assets/cornell_box.glb"));
    press(Key::digit_7);
    finish();
    EXPECT_EQ(difference(top, picture()), 0);
    // A map takes its place.
    press(Key::b);
    press(Key::v);
    finish();
    EXPECT_FALSE(model().comparison.shown);
    EXPECT_TRUE(model().map.shown);
}

TEST_F(ViewerTest, AReferenceIsShownWithShiftAndMeasuredWithM) {
    const test::TemporaryFolder folder;
    const std::string path = (folder.path() / "reference.exr").string();
    start(options_for("assets/cornell_box.glb"));
    press(Key::m);
    EXPECT_FALSE(model().map.shown) << "there is nothing to measure against";
    const ImageRgba8 plain = picture();
    // Half as bright.
    ImageRgba32f half = viewer_->frame()->image;
    for (Vec4& pixel : half.pixels())
        pixel = Vec4(0.5f * Vec3(pixel), pixel.a);
    write_exr(path, half, false, {});
    viewer_->handle(FilesDropped{{path}, {.shift = true}});
    finish();
    ASSERT_TRUE(model().reference && model().reference->mean_samples);
    const ImageDifference expected = compare_images(viewer_->frame()->image, half);
    EXPECT_NEAR(model().reference->difference.rel_mse, expected.rel_mse, 1e-3 * expected.rel_mse);
    EXPECT_GT(model().reference->difference.signed_mean, 0);

    viewer_->handle(KeyPressed{Key::shift, true, {.shift = true}});
    const ImageRgba8 held = picture();
    EXPECT_GT(changed(plain, held, 40, 160), 5);
    viewer_->handle(KeyPressed{Key::shift, false, {}});
    now_s_ += 10;
    finish();
    EXPECT_EQ(changed(plain, picture(), 40, 160), 0);

    press(Key::m);
    finish();
    EXPECT_EQ(model().map.metric, ReferenceMetric::signed_difference);
    // Twice as bright as the truth, of which a tenth of the mean softens the rest.
    const ImageRgba8 mapped = picture();
    const Vec3 bright = 255.0f * difference_color(1);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mapped(150, 10)[c], bright[c], 1);
    press(Key::m);
    EXPECT_EQ(model().map.metric, ReferenceMetric::relative_square);
    press(Key::m);
    EXPECT_EQ(model().map.metric, ReferenceMetric::flip);
    press(Key::m);
    EXPECT_FALSE(model().map.shown);
    press(Key::v);
    EXPECT_FALSE(model().map.metric.has_value());
}

TEST_F(ViewerTest, AReferenceOfAnotherSizeIsOnlyShown) {
    const test::TemporaryFolder folder;
    const std::string path = (folder.path() / "small.exr").string();
    write_exr(path, ImageRgba32f(20, 15, Vec4(1, 0, 0, 1)), false, {});
    start(options_for("assets/cornell_box.glb"));
    viewer_->handle(FilesDropped{{path}, {.shift = true}});
    finish();
    ASSERT_TRUE(model().reference.has_value());
    EXPECT_FALSE(model().reference->mean_samples.has_value());
    EXPECT_NE(model().notice.find("20x15"), std::string::npos) << model().notice;
    now_s_ += 10;
    viewer_->handle(KeyPressed{Key::shift, true, {.shift = true}});
    const Rgba8 drawn = picture()(100, 75);
    EXPECT_GT(drawn.r, 150);
    EXPECT_LT(drawn.g, 60);
    // One that cannot be read leaves it.
    viewer_->handle(FilesDropped{{(folder.path() / "none.exr").string()}, {.shift = true}});
    EXPECT_TRUE(model().notice_is_error);
    EXPECT_EQ(model().reference->path, path);
}

}  // namespace
}  // namespace candela
