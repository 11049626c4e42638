// SPDX-License-Identifier: MIT
#include "renderer/image/mip_chain.h"

#include "renderer/image/tone.h"

namespace candela {
namespace {

float linear(uint8_t srgb) {
    return linear_from_srgb(static_cast<float>(srgb) / 255.0f);
}

TEST(MipChain, EveryLevelIsHalfAsLarge) {
    const std::vector<ImageRgba8> chain = make_mip_chain(ImageRgba8(20, 6), MipColors::plain);
    ASSERT_EQ(chain.size(), 4u);
    EXPECT_EQ(chain[0].width(), 10);
    EXPECT_EQ(chain[0].height(), 3);
    EXPECT_EQ(chain[2].width(), 2);
    EXPECT_EQ(chain[2].height(), 1);
    EXPECT_EQ(chain[3].width(), 1);
    EXPECT_TRUE(make_mip_chain(ImageRgba8(1, 1), MipColors::plain).empty());
}

TEST(MipChain, ConstantColoursStay) {
    for (const MipColors colors : {MipColors::plain, MipColors::alpha_weighted}) {
        for (int value = 0; value < 256; ++value) {
            const Rgba8 color(value, 255 - value, value / 2, value);
            for (const ImageRgba8& level : make_mip_chain(ImageRgba8(7, 4, color), colors)) {
                EXPECT_TRUE(std::all_of(level.pixels().begin(), level.pixels().end(), [&](const Rgba8& p) {
                    return p == color;
                })) << value;
            }
        }
    }
}

// The mean light of every level is the image's, also where texels are shared between neighbours.
TEST(MipChain, LightIsAveragedNotItsCode) {
    for (const Vec2i& size : {Vec2i(16, 16), Vec2i(15, 9), Vec2i(1, 33)}) {
        ImageRgba8 image(size.x, size.y);
        double mean = 0, mean_alpha = 0;
        for (size_t i = 0; i < image.size(); ++i) {
            const auto value = static_cast<uint8_t>(i * i * 37 % 256);
            image.pixels()[i] = Rgba8(value, 0, 0, value);
            mean += static_cast<double>(linear(value)) / static_cast<double>(image.size());
            mean_alpha += value / 255.0 / static_cast<double>(image.size());
        }
        // Every level rounds to half a code; of light, a code is worth at most 2.28 times as much as of alpha.
        constexpr double half_code = 0.5 / 255;
        double rounding = 1e-6;
        for (const ImageRgba8& level : make_mip_chain(image, MipColors::plain)) {
            rounding += half_code;
            // Odd sizes cover all texels alike only once.
            if (level.width() * 2 < size.x - 1) break;
            double here = 0, alpha = 0;
            for (const Rgba8& p : level.pixels()) {
                here += static_cast<double>(linear(p.r)) / static_cast<double>(level.size());
                alpha += p.a / 255.0 / static_cast<double>(level.size());
            }
            EXPECT_NEAR(here, mean, 2.28 * rounding) << size.x << " x " << size.y;
            EXPECT_NEAR(alpha, mean_alpha, rounding);
        }
    }
}

TEST(MipChain, WhatAlphaHidesDoesNotBleedOut) {
    ImageRgba8 image(2, 1);
    image(0, 0) = Rgba8(200, 100, 50, 255);
    image(1, 0) = Rgba8(0, 255, 0, 0);
    EXPECT_EQ(make_mip_chain(image, MipColors::alpha_weighted).at(0)(0, 0), Rgba8(200, 100, 50, 128));
    const Rgba8 plain = make_mip_chain(image, MipColors::plain).at(0)(0, 0);
    EXPECT_NEAR(linear(plain.r), 0.5f * linear(200), 3e-3f);
    // Nothing opaque at all: the plain mean.
    image(0, 0).a = 0;
    EXPECT_EQ(make_mip_chain(image, MipColors::alpha_weighted).at(0)(0, 0), Rgba8(plain.r, plain.g, plain.b, 0));
}

}  // namespace
}  // namespace candela
