// SPDX-License-Identifier: MIT
#include <random>

#include "renderer/film/film.h"

namespace candela {
namespace {

TEST(Film, NonFiniteSamplesAreCountedNotAdded) {
    Film film({2, 1});
    film.add({0, 0}, 0, Vec3(1), 1);
    film.add({0, 0}, 1, Vec3(NAN, 1, 1), 1);
    film.add({0, 0}, 2, Vec3(INFINITY), 1);
    EXPECT_EQ(film.at({0, 0}).count, 1u);
    EXPECT_EQ(measure(film).non_finite, 2u);
}

TEST(Film, CoarseLatticesFillTheFrame) {
    for (const uint32_t stride : {2u, 8u, 64u}) {
        Film film({150, 70});
        for (uint32_t y = 0; y < 70; y += stride) {
            for (uint32_t x = 0; x < 150; x += stride)
                film.add({x, y}, 0, Vec3(static_cast<float>(x)), 1);
        }
        Frame frame;
        frame.image = ImageRgba32f(150, 70);
        resolve_rows(film, 0, 70, frame);
        for (int y = 0; y < 70; ++y) {
            for (int x = 0; x < 150; ++x)
                ASSERT_EQ(frame.image(x, y).x, static_cast<float>(static_cast<uint32_t>(x) / stride * stride));
        }
    }
}

// Adds the same samples to every pixel that draw(index) gives.
template <typename Draw>
Film film_of(Vec2u extent, uint32_t spp, Draw&& draw) {
    Film film(extent);
    for (uint32_t y = 0; y < extent.y; ++y) {
        for (uint32_t x = 0; x < extent.x; ++x) {
            for (uint32_t i = 0; i < spp; ++i)
                film.add({x, y}, i, Vec3(draw(i)), 1, {3, 2});
        }
    }
    return film;
}

struct TrueErrors {
    double mean = 0, within_stated = 0;
};
TrueErrors true_errors(const Film& film, double truth, double stated_95) {
    TrueErrors out;
    for (const FilmPixel& pixel : film.pixels()) {
        const double value = static_cast<double>(pixel.radiance_sum.x) / pixel.count;
        const double error = std::abs(value - truth) / (1.1 * truth);
        out.mean += error / static_cast<double>(film.pixels().size());
        out.within_stated += (error <= stated_95 ? 1.0 : 0.0) / static_cast<double>(film.pixels().size());
    }
    return out;
}

TEST(StatedError, OfIndependentNoiseIsTheTrueOne) {
    std::mt19937 engine(5);
    std::normal_distribution<float> noise(1.0f, 0.2f);
    for (const uint32_t spp : {4u, 64u}) {
        const Film film = film_of({200, 200}, spp, [&](uint32_t) { return noise(engine); });
        const FilmStatistics stated = measure(film);
        const double standard_error = 0.2 / std::sqrt(static_cast<double>(spp));
        EXPECT_NEAR(stated.relative_error, std::sqrt(2 / 3.14159265) * standard_error / 1.1, 0.02 * standard_error);
        EXPECT_NEAR(stated.relative_error_95, 1.96 * standard_error / 1.1, 0.04 * standard_error);
        double squares = 0;
        for (const float e : standard_error_map(film))
            squares += static_cast<double>(e) * static_cast<double>(e);
        EXPECT_NEAR(std::sqrt(squares / 40000), standard_error, 0.02 * standard_error);
    }
    EXPECT_TRUE(std::isnan(measure(Film({4, 4})).relative_error));
    EXPECT_TRUE(std::isnan(measure(Film({4, 4})).relative_error_95));
}

// Each replicate takes one sample from each of its strata: its mean is far better than its samples' spread lets expect.
TEST(StatedError, OfStratifiedSamplesIsTheTrueOne) {
    std::mt19937 engine(6);
    std::uniform_real_distribution<float> unit(0, 1);
    constexpr uint32_t strata = 16;
    const Film film = film_of({100, 100}, 2 * strata, [&](uint32_t i) {
        return (static_cast<float>(i / 2) + unit(engine)) / static_cast<float>(strata);
    });
    const FilmStatistics stated = measure(film);
    const TrueErrors errors = true_errors(film, 0.5, stated.relative_error_95);
    EXPECT_LT(errors.mean, 0.012) << "independent samples would be at 0.074";
    EXPECT_NEAR(stated.relative_error / errors.mean, 1, 0.03);
    EXPECT_NEAR(errors.within_stated, 0.95, 0.01);
}

// One sample in two hundred is two hundred times as bright: few pixels have seen one.
TEST(StatedError, RareBrightSamplesAreNotHiddenByTheirOwnBrightness) {
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> unit(0, 1);
    const Film film = film_of({200, 200}, 8, [&](uint32_t) { return 1.0f + (unit(engine) < 0.005f ? 200.0f : 0.0f); });
    // Truth is 2. A pixel without a bright sample is at 1, one with one of them at 26.
    double mean = 0;
    for (const FilmPixel& pixel : film.pixels())
        mean += std::abs(static_cast<double>(pixel.radiance_sum.x) / pixel.count - 2) / 2.2 / 40000;
    const double stated = measure(film).relative_error;
    EXPECT_LT(stated, mean * 1.15);
    EXPECT_GT(stated, mean * 0.40) << "half is what differences of skewed noise must lose";
}

// A lamp of one pixel among dark ones is a hundred times as bright, and its samples agree within a few per cent.
TEST(StatedError, LampsOfOnePixelAreNoFireflies) {
    Film film({50, 50});
    for (uint32_t y = 0; y < 50; ++y) {
        for (uint32_t x = 0; x < 50; ++x) {
            const float value = x % 5 == 2 && y % 5 == 2 ? 100.0f : 1.0f;
            for (uint32_t i = 0; i < 2; ++i)
                film.add({x, y}, i, Vec3(i == 0 ? 1.02f * value : 0.98f * value), 1);
        }
    }
    // The mean is 4.96: dark pixels are at 0.02 / 1.496, lamps at 2 / 100.496, or twice that.
    const double dark = 0.02 / 1.496, lamp = 2 / 100.496;
    EXPECT_LT(measure(film).relative_error, 0.96 * dark + 0.04 * 2.1 * lamp);
    EXPECT_GT(measure(film).relative_error, 0.96 * dark + 0.04 * 0.9 * lamp);
}

TEST(StatedError, IsTheSameHoweverTheRowsAreSharedOut) {
    std::mt19937 engine(8);
    std::exponential_distribution<float> noise(1.0f);
    const Film film = film_of({37, 53}, 6, [&](uint32_t) { return noise(engine); });
    const FilmStatistics whole = measure(film);
    const FilmStatistics parts = measure(film, [](uint32_t height, const RowWork& work) {
        for (uint32_t end = height; end > 0; end -= std::min(end, 7u))
            work(end - std::min(end, 7u), end);
    });
    EXPECT_EQ(whole.relative_error, parts.relative_error);
    EXPECT_EQ(whole.relative_error_95, parts.relative_error_95);
    EXPECT_EQ(whole.mean_luminance, parts.mean_luminance);
}

TEST(Maps, TheErrorsMeanIsThatOfThePictureAndCostsAreCounted) {
    std::mt19937 engine(9);
    std::exponential_distribution<float> noise(1.0f);
    Film film = film_of({64, 48}, 8, [&](uint32_t) { return noise(engine); });
    film.add({5, 6}, 8, Vec3(1), 1, {11, 6});
    Frame frame;
    frame.maps = ImageRgba32f(64, 48);
    const FilmStatistics stated = measure(film);
    for (uint32_t row = 0; row < 48; row += 16)
        map_rows(film, stated.mean_luminance, row, row + 16, frame);
    double sum = 0;
    for (const Vec4& pixel : frame.maps.pixels())
        sum += static_cast<double>(pixel[static_cast<int>(PixelMap::error)]);
    EXPECT_NEAR(sum / (64 * 48), stated.relative_error, 0.03 * stated.relative_error);
    EXPECT_EQ(frame.maps(4, 6), Vec4(frame.maps(4, 6).x, 8, 5, 3));
    const Vec4 costly = frame.maps(5, 6);
    EXPECT_EQ(costly[static_cast<int>(PixelMap::samples)], 9);
    EXPECT_FLOAT_EQ(costly[static_cast<int>(PixelMap::rays)], (8 * 5 + 17) / 9.0f);
    EXPECT_FLOAT_EQ(costly[static_cast<int>(PixelMap::bounces)], (8 * 3 + 11) / 9.0f);

    // Of the first sample nothing is known yet.
    const Film young = film_of({8, 8}, 1, [&](uint32_t) { return noise(engine); });
    frame.maps = ImageRgba32f(8, 8);
    map_rows(young, 1, 0, 8, frame);
    EXPECT_LT(frame.maps(3, 3).x, 0);
}

TEST(Film, LightGroupsAreWeighedAndTheTotalStays) {
    Film film(Vec2u(2, 1), 2);
    const Vec3 parts[] = {Vec3(1, 2, 3), Vec3(0.5f, 0, 1)}, other[] = {Vec3(3, 0, 1), Vec3(0)};
    film.add({1, 0}, 0, parts[0] + parts[1], 1, {}, parts);
    film.add({1, 0}, 1, other[0], 1, {}, other);
    const Vec3 broken[] = {Vec3(std::numeric_limits<float>::infinity(), 0, 0), Vec3(7)};
    film.add({1, 0}, 2, broken[0], 1, {}, broken);
    EXPECT_EQ(film.light_groups(), 2u);
    EXPECT_EQ(film.bytes(), 2 * sizeof(FilmPixel) + 4 * sizeof(Vec3));
    const FilmPixel& pixel = film.at({1, 0});
    EXPECT_EQ(film.mean(pixel, {}), Vec4(2.25f, 1, 2.5f, 1));
    const Vec3 weights[] = {Vec3(2), Vec3(0, 1, 4)};
    EXPECT_EQ(film.mean(pixel, weights), Vec4(4, 2, 6, 1));
    EXPECT_EQ(film.mean(film.at({0, 0}), weights), Vec4(0)) << "no sample yet";
    EXPECT_EQ(film.mean(pixel, std::span(weights).first(1)), Vec4(2.25f, 1, 2.5f, 1)) << "weights of other groups";

    const Film reweighted = film.reweighted(weights);
    EXPECT_EQ(reweighted.at({1, 0}).radiance_sum, Vec3(8, 4, 12));
    EXPECT_EQ(reweighted.at({1, 0}).count, 2u);
    film.clear();
    EXPECT_EQ(film.mean(film.at({1, 0}), weights), Vec4(0));
}

}  // namespace
}  // namespace candela
