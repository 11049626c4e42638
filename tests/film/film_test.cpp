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
    Film film({20, 20});
    for (uint32_t y = 0; y < 20; y += 8) {
        for (uint32_t x = 0; x < 20; x += 8)
            film.add({x, y}, 0, Vec3(static_cast<float>(x)), 1);
    }
    Frame frame;
    frame.image = ImageRgba32f(20, 20);
    resolve_rows(film, 0, 20, frame);
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 20; ++x)
            ASSERT_EQ(frame.image(x, y).x, static_cast<float>(x / 8 * 8));
    }
}

TEST(Film, EstimatedErrorIsTheTrueOne) {
    // Independent noise of known spread: the estimate must be the standard error of the mean.
    std::mt19937 engine(5);
    std::normal_distribution<float> noise(1.0f, 0.2f);
    for (const uint32_t spp : {4u, 64u}) {
        Film film({200, 200});
        for (uint32_t y = 0; y < 200; ++y) {
            for (uint32_t x = 0; x < 200; ++x) {
                for (uint32_t i = 0; i < spp; ++i)
                    film.add({x, y}, i, Vec3(noise(engine)), 1);
            }
        }
        const double expected = 0.2 / std::sqrt(static_cast<double>(spp)) / 1.1;
        EXPECT_NEAR(measure(film).relative_error, expected, 0.02 * expected);
        double squares = 0;
        for (const float e : standard_error_map(film))
            squares += static_cast<double>(e) * static_cast<double>(e);
        EXPECT_NEAR(std::sqrt(squares / 40000), 0.2 / std::sqrt(static_cast<double>(spp)), 0.003);
    }
    EXPECT_TRUE(std::isnan(measure(Film({4, 4})).relative_error));
}

}  // namespace
}  // namespace candela
