// SPDX-License-Identifier: MIT
// What the shader draws is what the CPU's tone map computes.
#include "app/gl/display.h"

#include <random>

#include "app/gl/osmesa_context.h"

namespace candela {
namespace {

constexpr ToneCurve curves[] = {ToneCurve::linear, ToneCurve::neutral, ToneCurve::aces, ToneCurve::agx};

// Radiance from 1e-4 to 1e3 in every hue, black, and pure primaries.
Frame make_frame(int width, int height) {
    Frame frame;
    frame.image = ImageRgba32f(width, height);
    frame.epoch = 1;
    frame.serial = 1;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> exponent(-4.0f, 3.0f);
    for (Vec4& pixel : frame.image.pixels()) {
        pixel = Vec4(std::pow(10.0f, exponent(random)), std::pow(10.0f, exponent(random)),
                     std::pow(10.0f, exponent(random)), 1);
    }
    frame.image(0, 0) = Vec4(0, 0, 0, 1);
    frame.image(1, 0) = Vec4(1, 0, 0, 1);
    frame.image(2, 0) = Vec4(0, 1, 0, 1);
    frame.image(3, 0) = Vec4(0, 0, 5, 1);
    return frame;
}

TEST(Display, ReadBackEqualsTheToneMapOfTheCpu) {
    const Frame frame = make_frame(173, 61);
    const OsmesaContext context({173, 61});
    Display display(context);
    display.upload(frame);
    for (const ToneCurve curve : curves) {
        for (const float exposure_ev : {-2.5f, 0.0f, 1.0f}) {
            const ToneSettings tone{exposure_ev, curve};
            display.draw({tone, false});
            const ImageRgba8 drawn = read_back(context);
            for (size_t i = 0; i < drawn.size(); ++i) {
                // Rounded to the nearest of 256 levels, give or take what the driver's pow and log2 lose.
                const Vec3 exact = 255.0f * display_from_linear(Vec3(frame.image.pixels()[i]), tone);
                for (int c = 0; c < 3; ++c) {
                    ASSERT_NEAR(drawn.pixels()[i][c], exact[c], 0.5f + 0.02f)
                        << name_of(curve) << " " << exposure_ev << " EV, pixel " << i << ", channel " << c;
                }
                ASSERT_EQ(drawn.pixels()[i].a, 255);
            }
        }
    }
}

TEST(Display, PremultipliedPixelsKeepTheirColourAndAlpha) {
    Frame frame = make_frame(64, 8);
    for (size_t i = 0; i < frame.image.size(); ++i)
        frame.image.pixels()[i] *= static_cast<float>(i % 5) / 4.0f;
    const OsmesaContext context({64, 8});
    Display display(context);
    display.upload(frame);
    display.draw({{}, false});
    const ImageRgba8 drawn = read_back(context);
    const ImageRgba8 expected = tone_map(frame.image, {});
    for (size_t i = 0; i < drawn.size(); ++i) {
        for (int c = 0; c < 4; ++c)
            ASSERT_NEAR(drawn.pixels()[i][c], expected.pixels()[i][c], 1) << i;
    }
}

TEST(Display, TransparentPixelsShowACheckerboard) {
    Frame frame = make_frame(32, 32);
    for (Vec4& pixel : frame.image.pixels())
        pixel = Vec4(0);
    const OsmesaContext context({32, 32});
    Display display(context);
    display.upload(frame);
    display.draw({});
    const ImageRgba8 drawn = read_back(context);
    EXPECT_NE(drawn(0, 31), drawn(8, 31));
    EXPECT_EQ(drawn(0, 31), drawn(16, 31));
    EXPECT_EQ(drawn(0, 31).a, 255);
}

TEST(Display, AFrameOfAnotherShapeIsFittedInTheMiddle) {
    Frame frame;
    frame.image = ImageRgba32f(40, 20, Vec4(1, 1, 1, 1));
    frame.epoch = 1;
    const OsmesaContext context({100, 100});
    Display display(context);
    display.upload(frame);
    display.draw({{0, ToneCurve::linear}, true});
    const ImageRgba8 drawn = read_back(context);
    const Rgba8 white(255), border = drawn(0, 0);
    EXPECT_NE(border, white);
    EXPECT_EQ(drawn(50, 24), border);
    EXPECT_EQ(drawn(50, 25), white);
    EXPECT_EQ(drawn(0, 50), white);
    EXPECT_EQ(drawn(99, 74), white);
    EXPECT_EQ(drawn(50, 75), border);
}

// One number in each channel; the error is unknown in the first row.
Frame mapped_frame(int width, int height) {
    Frame frame = make_frame(width, height);
    frame.maps = ImageRgba32f(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float t = static_cast<float>(x) / static_cast<float>(width - 1);
            frame.maps(x, y) = Vec4(y == 0 ? -1.0f : std::pow(10.0f, -4 + 5 * t), 100 * t, 30 * t * t, 12 - 12 * t);
        }
    }
    return frame;
}

TEST(Display, MapsHaveTheColoursOfTheCpu) {
    const Frame frame = mapped_frame(173, 9);
    const OsmesaContext context({173, 9});
    Display display(context);
    display.upload(frame);
    const std::pair<PixelMap, HeatScale> shown[] = {{PixelMap::error, {1e-3f, 1, true}},
                                                    {PixelMap::samples, {0, 100, false}},
                                                    {PixelMap::rays, {0, 20, false}},
                                                    {PixelMap::bounces, {0, 20, false}}};
    for (const auto& [map, scale] : shown) {
        display.draw({{}, false, DisplayedMap{map, scale, 0}});
        const ImageRgba8 drawn = read_back(context);
        for (int x = 0; x < 173; ++x) {
            const Vec3 exact = 255.0f * heat_color(scale.position(frame.maps(x, 4)[static_cast<int>(map)]));
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(drawn(x, 4)[c], exact[c], 0.5f + 0.1f) << static_cast<int>(map) << " at " << x;
        }
        if (map == PixelMap::error) {
            EXPECT_EQ(drawn(20, 0), Rgba8(64, 64, 64, 255)) << "unknown";
        }
    }
}

TEST(Display, DifferencesAndTheOtherPictureStandInTheFramesPlace) {
    const Frame frame = make_frame(100, 10);
    const OsmesaContext context({100, 10});
    Display display(context);
    display.upload(frame);
    ImageRgba32f differences(100, 10);
    for (int y = 0; y < 10; ++y) {
        for (int x = 0; x < 100; ++x)
            differences(x, y) = Vec4(static_cast<float>(x - 50) / 50, 0, 0, 0);
    }
    display.upload_differences(differences);
    DisplaySettings settings{{}, false, DisplayedMap{PixelMap::error, {-0.5f, 0.5f, false}, 0}};
    settings.map->metric = ReferenceMetric::signed_difference;
    display.draw(settings);
    const ImageRgba8 map = read_back(context);
    for (int x = 0; x < 100; ++x) {
        const Vec3 exact = 255.0f * difference_color(differences(x, 5).x / 0.5f);
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(map(x, 5)[c], exact[c], 0.5f + 0.1f) << x;
    }

    settings = {{0, ToneCurve::linear}, false};
    display.draw(settings);
    const ImageRgba8 plain = read_back(context);
    display.upload_other(ImageRgba32f(100, 10, Vec4(0, 1, 0, 1)));
    settings.other = 0.4f;
    display.draw(settings);
    const ImageRgba8 both = read_back(context);
    for (int x = 0; x < 100; ++x)
        ASSERT_EQ(both(x, 5), x < 40 ? plain(x, 5) : Rgba8(0, 255, 0, 255)) << x;
}

TEST(Display, TheWipeParts) {
    const Frame frame = mapped_frame(100, 10);
    const OsmesaContext context({100, 10});
    Display display(context);
    display.upload(frame);
    display.draw({{}, false});
    const ImageRgba8 plain = read_back(context);
    const HeatScale scale{0, 100, false};
    display.draw({{}, false, DisplayedMap{PixelMap::samples, scale, 0}});
    const ImageRgba8 map = read_back(context);
    display.draw({{}, false, DisplayedMap{PixelMap::samples, scale, 0.3f}});
    const ImageRgba8 both = read_back(context);
    for (int x = 0; x < 100; ++x)
        ASSERT_EQ(both(x, 5), x < 30 ? plain(x, 5) : map(x, 5)) << x;

    // A frame that came without maps is only a picture, whatever is asked for.
    Frame without = make_frame(100, 10);
    without.serial = 2;
    display.upload(without);
    display.draw({{}, false, DisplayedMap{PixelMap::samples, scale, 0}});
    EXPECT_EQ(read_back(context)(70, 5), plain(70, 5));
}

TEST(Display, ANewFrameReplacesTheOldAndAnEqualOneIsNotUploadedAgain) {
    Frame frame;
    frame.image = ImageRgba32f(8, 8, Vec4(1, 1, 1, 1));
    frame.epoch = 1;
    frame.serial = 1;
    const OsmesaContext context({8, 8});
    Display display(context);
    display.upload(frame);
    display.draw({{0, ToneCurve::linear}, true});
    EXPECT_EQ(read_back(context)(3, 3), Rgba8(255));

    for (Vec4& pixel : frame.image.pixels())
        pixel = Vec4(0, 0, 0, 1);
    display.upload(frame);
    display.draw({{0, ToneCurve::linear}, true});
    EXPECT_EQ(read_back(context)(3, 3), Rgba8(255));

    frame.serial = 2;
    display.upload(frame);
    display.draw({{0, ToneCurve::linear}, true});
    EXPECT_EQ(read_back(context)(3, 3), Rgba8(0, 0, 0, 255));
}

TEST(Display, RowsStandUpright) {
    Frame frame = make_frame(16, 16);
    for (int x = 0; x < 16; ++x)
        frame.image(x, 0) = Vec4(1, 0, 0, 1);
    for (int x = 0; x < 16; ++x)
        frame.image(x, 15) = Vec4(0, 1, 0, 1);
    const OsmesaContext context({16, 16});
    Display display(context);
    display.upload(frame);
    display.draw({{0, ToneCurve::linear}, true});
    const ImageRgba8 drawn = read_back(context);
    EXPECT_EQ(drawn(5, 0), Rgba8(255, 0, 0, 255));
    EXPECT_EQ(drawn(5, 15), Rgba8(0, 255, 0, 255));
}

TEST(OsmesaContext, ResizesAndKeepsItsPrograms) {
    OsmesaContext context({16, 16});
    Display display(context);
    display.upload(make_frame(16, 16));
    context.resize({33, 47});
    display.draw({});
    EXPECT_EQ(read_back(context).width(), 33);
    EXPECT_EQ(context.gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(OsmesaContext, SaysWhatItCannotDraw) {
    EXPECT_THROW(OsmesaContext({60000, 8}), GlError);
}

TEST(GlFunctions, AMissingFunctionIsNamed) {
    try {
        load_gl_functions([](const char*) -> void* { return nullptr; });
        FAIL();
    } catch (const GlError& error) {
        EXPECT_NE(std::string(error.what()).find("glActiveTexture"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace candela
