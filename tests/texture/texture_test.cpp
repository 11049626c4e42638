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
        return {pixels_.data(), 4, 2, wrap, wrap, filter};
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

}  // namespace
}  // namespace candela
