// SPDX-License-Identifier: MIT
#include "renderer/image/compare.h"
#include "renderer/image/heat.h"
#include "renderer/image/tone.h"

namespace candela {
namespace {

TEST(Tone, CurvesAreMonotoneAndMeetTheirAnchors) {
    for (const ToneCurve curve : {ToneCurve::linear, ToneCurve::neutral, ToneCurve::aces, ToneCurve::agx}) {
        float last = -1;
        for (float ev = -12; ev < 8; ev += 0.25f) {
            const Vec3 d = display_from_linear(Vec3(0.18f), {ev, curve});
            EXPECT_GE(d.x, last - 1e-4f);
            EXPECT_NEAR(d.x, d.y, 0.01f) << "grey stays grey";
            last = d.x;
        }
    }
    // Neutral leaves colours below its compression start as they are, less the Fresnel offset of 0.04.
    EXPECT_NEAR(linear_from_srgb(display_from_linear(Vec3(0.5f), {0, ToneCurve::neutral}).x), 0.46f, 1e-4f);
    EXPECT_NEAR(display_from_linear(Vec3(0.18f), {0, ToneCurve::linear}).x, 0.4613561f, 1e-5f);
    EXPECT_NEAR(linear_from_srgb(srgb_from_linear(0.3f)), 0.3f, 1e-6f);
}

TEST(Heat, ColoursGrowLighterAndScalesMeetTheirEnds) {
    float last = -1;
    for (float t = 0; t <= 1; t += 1.0f / 64) {
        const float lightness = luminance(heat_color(t));
        EXPECT_GT(lightness, last) << t;
        last = lightness;
    }
    EXPECT_LT(luminance(heat_color(0)), 0.01f);
    EXPECT_GT(luminance(heat_color(1)), 0.9f);
    EXPECT_EQ(heat_color(7), heat_color(1));
    const HeatScale decades{1e-3f, 1, true}, linear{0, 50, false};
    EXPECT_NEAR(decades.position(1e-2f), 1.0f / 3, 1e-6f);
    EXPECT_EQ(decades.position(0), 0);
    EXPECT_EQ(linear.position(25), 0.5f);
}

TEST(Compare, KnownDifferences) {
    ImageRgba32f a(32, 32, Vec4(0.5f, 0.5f, 0.5f, 1)), b(32, 32, Vec4(0.25f, 0.25f, 0.25f, 1));
    const ImageDifference same = compare_images(a, a);
    EXPECT_EQ(same.rmse, 0);
    EXPECT_NEAR(same.flip, 0, 1e-5);
    const ImageDifference d = compare_images(a, b);
    EXPECT_NEAR(d.rmse, 0.25, 1e-6);
    EXPECT_NEAR(d.mae, 0.25, 1e-6);
    EXPECT_NEAR(d.signed_mean, 0.25, 1e-6);
    EXPECT_NEAR(d.rel_mse, 1.0 / 1.01, 1e-5);
    EXPECT_THROW(compare_images(a, ImageRgba32f(2, 2)), std::invalid_argument);
}

TEST(Compare, FlipOfBlackAndWhiteIsNearOneAndSymmetric) {
    const ImageRgba32f black(48, 48, Vec4(0, 0, 0, 1)), white(48, 48, Vec4(1)), grey(48, 48, Vec4(0.2f, 0.2f, 0.2f, 1));
    EXPECT_NEAR(compare_images(black, white).flip, 0.97, 0.03);
    EXPECT_NEAR(compare_images(black, grey).flip, compare_images(grey, black).flip, 1e-5);
    EXPECT_LT(compare_images(black, grey).flip, compare_images(black, white).flip);
}

TEST(Compare, MapsAreThePixelsOfTheNumbers) {
    ImageRgba32f a(20, 10, Vec4(0.5f, 0.25f, 0.125f, 1)), b = a;
    b(3, 4) = Vec4(1, 1, 1, 1);
    a(7, 2) = Vec4(1, 1, 1, 1);
    const PictureComparison compared = compare_with_maps(a, b);
    const ImageDifference numbers = compare_images(a, b);
    EXPECT_EQ(compared.difference.rel_mse, numbers.rel_mse);
    EXPECT_EQ(compared.difference.flip, numbers.flip);
    double square = 0, flip = 0;
    for (const Vec4& pixel : compared.maps.pixels()) {
        square += static_cast<double>(pixel[static_cast<int>(ReferenceMetric::relative_square)]) / 200;
        flip += static_cast<double>(pixel[static_cast<int>(ReferenceMetric::flip)]) / 200;
    }
    EXPECT_NEAR(square, numbers.rel_mse, 1e-6 * numbers.rel_mse);
    EXPECT_NEAR(flip, numbers.flip, 1e-6);
    EXPECT_LT(compared.maps(3, 4).x, -0.5f) << "too dark";
    EXPECT_GT(compared.maps(7, 2).x, 0.5f) << "too bright";
    EXPECT_EQ(compared.maps(0, 0).x, 0.0f);
}

}  // namespace
}  // namespace candela
