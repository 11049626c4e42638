// SPDX-License-Identifier: MIT
#include "renderer/denoise/denoise.h"

#include <tbb/task_arena.h>

#include <random>

#include "renderer/image/compare.h"
#include "renderer/integrator/guide_rays.h"
#include "renderer/io/load_gltf.h"
#include "renderer/session/render_session.h"

namespace candela {
namespace {

constexpr int width = 90, height = 70;

// Where each pixel's light and guides come from.
struct Subject {
    ImageRgb32f irradiance{width, height, Vec3(1)}, albedo{width, height, Vec3(0.5f)},
        normal{width, height, Vec3(0, 0, 1)};

    ImageRgba32f truth() const {
        ImageRgba32f out(width, height);
        for (size_t i = 0; i < out.size(); ++i)
            out.pixels()[i] = Vec4(irradiance.pixels()[i] * albedo.pixels()[i], 1);
        return out;
    }
    Guides guides() const {
        Guides out({width, height});
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x)
                out.add(x, y, {albedo(x, y), normal(x, y), 2});
        }
        out.passes = 1;
        return out;
    }
    // Exponential noise: the deviation of a sample is its mean.
    Film film(uint32_t spp, bool noisy = true) const {
        Film out({width, height});
        std::mt19937 random(7);
        std::exponential_distribution<float> noise(1);
        for (uint32_t i = 0; i < spp; ++i) {
            for (int y = 0; y < height; ++y) {
                for (int x = 0; x < width; ++x)
                    out.add({x, y}, i, irradiance(x, y) * albedo(x, y) * (noisy ? noise(random) : 1.0f), 1);
            }
        }
        return out;
    }
};

ImageRgba32f picture_of(const Film& film) {
    Frame frame;
    frame.image = ImageRgba32f(width, height);
    resolve_rows(film, 0, height, frame);
    return frame.image;
}

double rel_mse(const ImageRgba32f& a, const ImageRgba32f& b) {
    return compare_images(a, b).rel_mse;
}

// A light that falls off, a checkered floor of two colours, and a wall with another normal that lies in shadow.
Subject checkered_room() {
    Subject out;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool wall = y < height / 3;
            out.irradiance(x, y) = wall ? Vec3(0.2f, 0.3f, 0.25f) : Vec3(3.0f / (1.0f + 0.05f * static_cast<float>(x)));
            out.normal(x, y) = wall ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
            if (!wall) out.albedo(x, y) = (x / 3 + y / 3) % 2 == 0 ? Vec3(0.8f, 0.7f, 0.1f) : Vec3(0.1f, 0.2f, 0.4f);
        }
    }
    return out;
}

TEST(Denoise, NoiseFallsAndTexturesAndEdgesStay) {
    const Subject subject = checkered_room();
    const Film film = subject.film(16);
    const ImageRgba32f denoised = denoise(film, subject.guides());
    const double before = rel_mse(picture_of(film), subject.truth()), after = rel_mse(denoised, subject.truth());
    EXPECT_LT(after, before / 20) << before;
    // At the edge between wall and floor the two do not mix.
    const ImageRgba32f truth = subject.truth();
    float error = 0;
    for (int x = 0; x < width; ++x) {
        for (int y = height / 3 - 1; y <= height / 3; ++y)
            error += std::abs(denoised(x, y).g / truth(x, y).g - 1) / (2 * width);
    }
    EXPECT_LT(error, 0.07f);
}

TEST(Denoise, APictureWithoutNoiseStays) {
    const Subject subject = checkered_room();
    const ImageRgba32f denoised = denoise(subject.film(4, false), subject.guides());
    EXPECT_LT(rel_mse(denoised, subject.truth()), 2e-5);
}

// Light through a blind: no guide knows of it, the colours alone do.
TEST(Denoise, WhatLightDrawsStays) {
    Subject subject;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
            subject.irradiance(x, y) = Vec3(x / 10 % 2 == 0 ? 4.0f : 0.2f);
    }
    const Film film = subject.film(64);
    const ImageRgba32f denoised = denoise(film, subject.guides());
    EXPECT_LT(rel_mse(denoised, subject.truth()), 0.2 * rel_mse(picture_of(film), subject.truth()));
    // Two pixels from an edge.
    for (int y = 0; y < height; ++y) {
        ASSERT_GT(denoised(27, y).g, 1.5f) << y;
        ASSERT_LT(denoised(32, y).g, 0.4f) << y;
    }
}

TEST(Denoise, ALoneBrightSampleGoes) {
    const Subject subject;
    Film film = subject.film(16);
    film.add({40, 30}, 16, Vec3(5000), 1);
    const ImageRgba32f denoised = denoise(film, subject.guides());
    for (int y = 20; y < 40; ++y) {
        for (int x = 30; x < 50; ++x)
            ASSERT_NEAR(denoised(x, y).g, 0.5f, 0.15f) << x << "," << y;
    }
}

TEST(Denoise, ALampAsSmallAsAPixelStays) {
    Subject subject;
    subject.irradiance(40, 30) = Vec3(300);
    const ImageRgba32f denoised = denoise(subject.film(64), subject.guides());
    EXPECT_GT(denoised(40, 30).g, 80) << "of 150";
    EXPECT_NEAR(denoised(42, 30).g, 0.5f, 0.2f);
}

TEST(Denoise, IsTheSameOnOneThreadAndOnMany) {
    const Subject subject = checkered_room();
    const Film film = subject.film(6);
    ImageRgba32f one, many;
    tbb::task_arena(1).execute([&] { one = denoise(film, subject.guides()); });
    tbb::task_arena(2).execute([&] { many = denoise(film, subject.guides()); });
    EXPECT_EQ(one.pixels(), many.pixels());
}

TEST(Denoise, EndsEarlyWhenAsked) {
    const std::atomic<bool> cancel{true};
    const Subject subject;
    EXPECT_TRUE(denoise(subject.film(2), subject.guides(), &cancel).empty());
}

// What was not seen yet, and what is no number, does not spread.
TEST(Denoise, PixelsWithoutSamplesDoNoHarm) {
    const Subject subject;
    Film film = subject.film(8, false), holes({width, height});
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            if (x == 20 && y == 20) continue;
            for (uint32_t i = 0; i < (x == 40 ? 1u : 4u); ++i)
                holes.add({x, y}, i, Vec3(0.5f), 1);
        }
    }
    holes.add({20, 20}, 0, Vec3(std::numeric_limits<float>::quiet_NaN()), 1);
    const ImageRgba32f denoised = denoise(holes, subject.guides());
    for (const Vec4& pixel : denoised.pixels())
        ASSERT_TRUE(std::isfinite(pixel.r) && pixel.r >= 0);
    EXPECT_NEAR(denoised(60, 50).r, 0.5f, 1e-4f);
    EXPECT_NEAR(denoised(41, 50).r, 0.5f, 1e-4f);
}

Film render(const RenderRequest& request) {
    SessionOptions options;
    options.publish_frames = false;
    RenderSession session(options);
    session.submit(request);
    session.wait_until_done();
    return session.snapshot_film();
}

TEST(Denoise, ASmallPictureOfARoomComesNearerToTheTruth) {
    Diagnostics diagnostics;
    RenderRequest request;
    const auto scene = std::make_shared<const Scene>(load_gltf("assets/cornell_box.glb", diagnostics));
    request.world = build_world(scene);
    request.view = {scene->cameras.front().camera, {64, 48}};
    request.max_spp = 16;
    // Windows are large for so small a picture, and the noise of shared paths is alike all over them.
    request.settings.reuse_paths = false;
    const Film film = render(request);
    Guides guides(request.view.extent);
    add_guides(*request.world, request.view, request.settings, 16, guides);
    request.settings.seed = 1;
    request.max_spp = 256;
    const Film many = render(request);
    const auto resolved = [](const Film& of) {
        Frame frame;
        frame.image = ImageRgba32f(64, 48);
        resolve_rows(of, 0, 48, frame);
        return frame.image;
    };
    const ImageRgba32f truth = resolved(many);
    EXPECT_LT(rel_mse(denoise(film, guides), truth), rel_mse(resolved(film), truth) / 2);
}

}  // namespace
}  // namespace candela
