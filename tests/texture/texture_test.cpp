// SPDX-License-Identifier: MIT
#include "renderer/texture/texture.h"

#include "renderer/image/tone.h"

namespace candela {
namespace {

// A row of reds 0, 51, 102, 153 with alpha 255 − red, twice; greens count rows.
std::vector<Rgba8> make_pixels() {
    std::vector<Rgba8> out;
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 4; ++x)
            out.emplace_back(51 * x, 255 * y, 0, 255 - 51 * x);
    }
    return out;
}

class TextureTest : public testing::Test {
  protected:
    TextureView view(WrapMode wrap, TextureFilter filter = TextureFilter::linear) const {
        return {pixels_.data(), 4, 2, wrap, wrap, filter, filter, MipFilter::linear, {}};
    }
    // Red, in steps of 51, at a column of pixel centres.
    static float red(const TextureView& texture, float column) {
        return lookup_linear(texture, {(column + 0.5f) / 4, 0.25f}).r * 5;
    }
    std::vector<Rgba8> pixels_ = make_pixels();
};

TEST_F(TextureTest, CentresAreExactAndHalvesAreMeans) {
    const TextureView texture = view(WrapMode::clamp_to_edge);
    EXPECT_NEAR(red(texture, 2), 2, 1e-4f);
    EXPECT_NEAR(red(texture, 1.5f), 1.5f, 1e-4f);
    EXPECT_NEAR(red(texture, 0.25f), 0.25f, 1e-4f);
    // Down the rows.
    EXPECT_NEAR(lookup_linear(texture, {0.5f, 0.25f}).g, 0, 1e-4f);
    EXPECT_NEAR(lookup_linear(texture, {0.5f, 0.5f}).g, 0.5f, 1e-4f);
    EXPECT_NEAR(lookup_linear(texture, {0.5f, 0.75f}).g, 1, 1e-4f);
}

TEST_F(TextureTest, NearestTakesOnePixel) {
    const TextureView texture = view(WrapMode::repeat, TextureFilter::nearest);
    EXPECT_FLOAT_EQ(red(texture, 1.4f), 1);
    EXPECT_FLOAT_EQ(red(texture, 1.6f), 2);
}

TEST_F(TextureTest, WrapModes) {
    const TextureView repeat = view(WrapMode::repeat), clamp = view(WrapMode::clamp_to_edge),
                      mirror = view(WrapMode::mirrored_repeat);
    // Pixel columns beyond the image: −1, 4, 5, and one period further.
    EXPECT_NEAR(red(repeat, -1), 3, 1e-3f);
    EXPECT_NEAR(red(repeat, 4), 0, 1e-3f);
    EXPECT_NEAR(red(repeat, 9), 1, 1e-3f);
    EXPECT_NEAR(red(repeat, 3.5f), 1.5f, 1e-3f) << "the seam blends last and first";
    EXPECT_NEAR(red(clamp, -1), 0, 1e-3f);
    EXPECT_NEAR(red(clamp, 6), 3, 1e-3f);
    EXPECT_NEAR(red(mirror, -1), 0, 1e-3f);
    EXPECT_NEAR(red(mirror, -2), 1, 1e-3f);
    EXPECT_NEAR(red(mirror, 4), 3, 1e-3f);
    EXPECT_NEAR(red(mirror, 6), 1, 1e-3f);
    EXPECT_NEAR(red(mirror, 8), 0, 1e-3f);
}

TEST_F(TextureTest, SrgbIsDecodedBeforeFilteringAndAlphaIsLinear) {
    const TextureView texture = view(WrapMode::clamp_to_edge);
    const Vec4 value = lookup_srgb(texture, {2.0f / 4, 0.25f});  // half-way between columns 1 and 2
    EXPECT_NEAR(value.r, (linear_from_srgb(0.2f) + linear_from_srgb(0.4f)) / 2, 1e-4f);
    EXPECT_NEAR(value.a, 0.7f, 1e-4f);
    EXPECT_NEAR(lookup_alpha(texture, {2.0f / 4, 0.25f}), 0.7f, 1e-4f);
}

TEST_F(TextureTest, WildCoordinatesAreSurvived) {
    for (const WrapMode wrap : {WrapMode::repeat, WrapMode::clamp_to_edge, WrapMode::mirrored_repeat}) {
        for (const float bad : {1e30f, -1e30f, infinity, -infinity, std::numeric_limits<float>::quiet_NaN()}) {
            const Vec4 value = lookup_linear(view(wrap), {bad, bad});
            EXPECT_TRUE(value.r >= 0 && value.r <= 1);
        }
    }
}

TEST(Texture, WithoutAnImageItIsWhite) {
    EXPECT_EQ(lookup_linear({}, {0.3f, 0.3f}), Vec4(1));
    EXPECT_EQ(lookup_srgb({}, {0.3f, 0.3f}), Vec4(1));
    EXPECT_EQ(lookup_alpha({}, {0.3f, 0.3f}), 1);
}

// Level k of a chain for the 4 × 2 image is of one green value: what a lookup reads tells its level.
class MinificationTest : public TextureTest {
  protected:
    TextureView view(TextureFilter mag, TextureFilter min, MipFilter mip) const {
        TextureView out{pixels_.data(), 4, 2, WrapMode::repeat, WrapMode::repeat, mag, min, mip, {}};
        if (mip != MipFilter::none) out.smaller = levels_;
        return out;
    }
    static float blue(const TextureView& texture, float texels, float share, float u_level) {
        return std::round(lookup_srgb(texture, {0.3f, 0.3f}, {texels / 8, share, u_level}).b * 255);
    }
    static uint8_t srgb(float linear) { return static_cast<uint8_t>(std::lround(255 * srgb_from_linear(linear))); }

    // Blue is 0 in the image; its linear values here are about 100 and 200 of 255.
    std::vector<ImageRgba8> levels_{ImageRgba8(2, 1, Rgba8(0, 0, srgb(100 / 255.0f), 255)),
                                    ImageRgba8(1, 1, Rgba8(0, 0, srgb(200 / 255.0f), 255))};
};

TEST_F(MinificationTest, TheLevelFollowsTheShareOfTheFootprint) {
    const TextureView texture = view(TextureFilter::linear, TextureFilter::linear, MipFilter::linear);
    EXPECT_EQ(blue(texture, 0, 1, 0.9f), 0) << "a point";
    EXPECT_EQ(blue(texture, 0.5f, 1, 0.9f), 0) << "magnified";
    EXPECT_NEAR(blue(texture, 4, 1, 0.5f), 100, 1);
    EXPECT_NEAR(blue(texture, 16, 1, 0.5f), 200, 1);
    EXPECT_NEAR(blue(texture, 1e9f, 1, 0.5f), 200, 1) << "there is no further level";
    EXPECT_NEAR(blue(texture, 16, 0.25f, 0.5f), 100, 1) << "the fourth part of sixteen texels";
    EXPECT_EQ(blue(texture, 16, 1.0f / 64, 0.99f), 0) << "less than a texel is left: the image itself";
    // Half-way between levels, in octaves, each is read half of the time.
    EXPECT_EQ(blue(texture, 2, 1, 0.49f), 0);
    EXPECT_NEAR(blue(texture, 2, 1, 0.51f), 100, 1);
}

TEST_F(MinificationTest, AllSixFilters) {
    for (const TextureFilter min : {TextureFilter::nearest, TextureFilter::linear}) {
        const TextureFilter mag = min == TextureFilter::linear ? TextureFilter::nearest : TextureFilter::linear;
        const TextureView none = view(mag, min, MipFilter::none);
        const TextureView nearest = view(mag, min, MipFilter::nearest);
        const TextureView linear = view(mag, min, MipFilter::linear);
        EXPECT_EQ(blue(none, 16, 1, 0.5f), 0);
        EXPECT_EQ(blue(nearest, 1.9f, 1, 0.9f), 0) << "the nearer level, whatever the random number";
        EXPECT_NEAR(blue(nearest, 2.1f, 1, 0.1f), 100, 1);
        EXPECT_NEAR(blue(linear, 2.1f, 1, 0.9f), 100, 1);
        EXPECT_EQ(blue(linear, 2.1f, 1, 0.1f), 0);
        // Half-way between two texels of red 0 and 51: a mean, or one of them.
        for (const float texels : {0.5f, 3.0f}) {
            const TextureFilter filter = texels < 1 ? mag : min;
            const float red = lookup_srgb(none, {1.01f / 4, 0.25f}, {texels / 8, 1, 0}).r;
            const float whole = linear_from_srgb(0.2f);
            EXPECT_NEAR(red / whole, filter == TextureFilter::linear ? 0.51f : 1, 1e-3f) << texels;
        }
    }
}

}  // namespace
}  // namespace candela
