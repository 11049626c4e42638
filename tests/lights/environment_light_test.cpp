// SPDX-License-Identifier: MIT
// The environment: where its pixels lie, and that it is sampled by what it shines.
#include "renderer/lights/environment_light.h"

#include <random>

#include "tests/support/batch_means.h"
#include "tests/support/chi_squared.h"

namespace candela {
namespace {

// Uneven everywhere, with one bright pixel.
Environment uneven_environment() {
    Environment out;
    out.radiance = ImageRgb32f(32, 16);
    std::mt19937 engine(3);
    for (Vec3& pixel : out.radiance.pixels())
        pixel = Vec3(0.02f + 0.98f * static_cast<float>(engine() >> 8) * 0x1p-24f);
    out.radiance(20, 5) = Vec3(300, 200, 100);
    out.rotation_radians = 0.7f;
    out.intensity = 2.5f;
    return out;
}

Environment constant(const Vec3& radiance) {
    Environment out;
    out.radiance = ImageRgb32f(1, 1, radiance);
    return out;
}

// (φ, cosθ) of a direction on the unit square, on which solid angle is uniform with density 4π.
Vec2 square_of(const Vec3& w) {
    return {std::atan2(w.z, w.x) / (2 * pi) + 0.5f, 0.5f + 0.5f * w.y};
}
Vec3 direction_of(const Vec2& s) {
    const float y = 2 * s.y - 1, phi = 2 * pi * (s.x - 0.5f), r = std::sqrt(std::max(0.0f, 1 - y * y));
    return {r * std::cos(phi), y, r * std::sin(phi)};
}

double chi_squared_of(const EnvironmentLight& light, bool complete) {
    constexpr int grid = 24, fine = 40, count = 300000;
    std::mt19937 engine(11);
    const auto uniform = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24f; };
    std::vector<double> counts(grid * grid, 0), expected(grid * grid, 0);
    int disagreeing = 0;
    for (int i = 0; i < count; ++i) {
        Vec3 wi(0);
        const float u = uniform();
        const float pdf = light.sample({u, uniform()}, complete, wi);
        EXPECT_NEAR(glm::length(wi), 1, 1e-4f);
        disagreeing += std::abs(pdf / light.pdf(wi, complete) - 1) < 1e-2f ? 0 : 1;
        const Vec2 at = glm::clamp(square_of(wi), Vec2(0), Vec2(one_minus_epsilon)) * static_cast<float>(grid);
        counts[static_cast<size_t>(at.y) * grid + static_cast<size_t>(at.x)] += 1;
    }
    // Close to a pixel's edge or to a pole, a rounded direction may belong to the neighbour.
    EXPECT_LT(disagreeing, count / 10000);
    double total = 0;
    for (int y = 0; y < grid * fine; ++y) {
        for (int x = 0; x < grid * fine; ++x) {
            const Vec2 at = (Vec2(x, y) + 0.5f) / static_cast<float>(grid * fine);
            const double mass = static_cast<double>(light.pdf(direction_of(at), complete)) * 4 *
                                static_cast<double>(pi) / (grid * fine * grid * fine);
            total += mass;
            expected[static_cast<size_t>(y / fine * grid + x / fine)] += mass * count;
        }
    }
    EXPECT_NEAR(total, 1, 5e-3) << "the pdf does not integrate to one";
    return test::chi_squared_score(counts, expected);
}

TEST(EnvironmentLight, SamplesFollowTheirPdf) {
    for (const bool complete : {false, true})
        EXPECT_LT(chi_squared_of(EnvironmentLight(uneven_environment()), complete), 4) << complete;
}

TEST(EnvironmentLight, SamplesOfAConstantSkyFollowTheirPdf) {
    EXPECT_LT(chi_squared_of(EnvironmentLight(constant(Vec3(1))), true), 4);
}

TEST(EnvironmentLight, BesideDirectionsOnlyWhatStandsOutIsSampled) {
    // A constant sky has nothing of that.
    const EnvironmentLight even(constant(Vec3(1)));
    Vec3 wi(0);
    EXPECT_EQ(even.sample({0.3f, 0.7f}, false, wi), 0.0f);
    EXPECT_EQ(even.pdf({0, 1, 0}, false), 0.0f);
    EXPECT_EQ(even.mean_excess(), 0.0f);

    // One bright quarter of the sphere in a grey one: all samples go there.
    Environment environment;
    environment.radiance = ImageRgb32f(64, 32, Vec3(1));
    for (int y = 0; y < 32; ++y) {
        for (int x = 32; x < 48; ++x)
            environment.radiance(x, y) = Vec3(5);
    }
    const EnvironmentLight light(environment);
    EXPECT_NEAR(light.mean_luminance(), 2.0f, 0.02f);
    EXPECT_NEAR(light.mean_excess(), 0.75f, 0.05f);
    std::mt19937 engine(7);
    const auto uniform = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24f; };
    for (int i = 0; i < 1000; ++i) {
        const float u = uniform();
        ASSERT_GT(light.sample({u, uniform()}, false, wi), 0.0f);
        ASSERT_GT(luminance(light.radiance(wi)), light.mean_luminance());
    }
    // The dark part is left to directions alone, unless light samples must cover all.
    EXPECT_EQ(light.pdf(glm::normalize(Vec3(-1, 0.3f, -1)), false), 0.0f);
    EXPECT_NEAR(light.pdf(glm::normalize(Vec3(-1, 0.3f, -1)), true), 0.5f / (4 * pi), 1e-4f);
}

TEST(EnvironmentLight, SamplingIntegratesTheRadiance) {
    // ∫ L dω by samples, against a fine grid.
    const EnvironmentLight light(uneven_environment());
    std::mt19937 engine(5);
    const auto uniform = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24f; };
    test::BatchMeans means;
    for (int i = 0; i < 100000; ++i) {
        Vec3 wi(0);
        const float u = uniform();
        const float pdf = light.sample({u, uniform()}, true, wi);
        if (pdf > 0) means.add(static_cast<double>(light.radiance(wi).g / pdf));
    }
    double exact = 0;
    constexpr int fine = 1500;
    for (int y = 0; y < fine; ++y) {
        for (int x = 0; x < fine; ++x)
            exact +=
                static_cast<double>(light.radiance(direction_of((Vec2(x, y) + 0.5f) / static_cast<float>(fine))).g);
    }
    exact *= 4 * static_cast<double>(pi) / (fine * fine);
    EXPECT_NEAR(means.mean(), exact, 4 * means.standard_error() + 1e-3 * exact);
    EXPECT_LT(means.standard_error(), 0.01 * exact) << "importance sampling should do better";
}

TEST(EnvironmentLight, DirectionsReadThePixelsOfTheContract) {
    // u = atan2(z,x)/2π + ½ from the left, v = ½ − asin(y)/π from the top: the centre column lies in +X.
    Environment environment;
    environment.radiance = ImageRgb32f(64, 32, Vec3(0));
    const auto set = [&](float u, float v, const Vec3& value) {
        environment.radiance(static_cast<int>(u * 64), static_cast<int>(v * 32)) = value;
        environment.radiance(static_cast<int>(u * 64) - 1, static_cast<int>(v * 32)) = value;
        environment.radiance(static_cast<int>(u * 64), static_cast<int>(v * 32) - 1) = value;
        environment.radiance(static_cast<int>(u * 64) - 1, static_cast<int>(v * 32) - 1) = value;
    };
    set(0.5f, 0.5f, {1, 0, 0});
    set(0.75f, 0.5f, {0, 1, 0});
    const EnvironmentLight light(environment);
    EXPECT_EQ(light.radiance({1, 0, 0}), Vec3(1, 0, 0));
    EXPECT_EQ(light.radiance({0, 0, 1}), Vec3(0, 1, 0));
    EXPECT_EQ(light.radiance({-1, 0, 0}), Vec3(0));

    // A quarter turn counter-clockwise seen from +Y moves what was in +X to −Z.
    environment.rotation_radians = pi / 2;
    const EnvironmentLight turned(environment);
    EXPECT_LT(glm::distance(turned.radiance({0, 0, -1}), Vec3(1, 0, 0)), 1e-3f);
    EXPECT_LT(glm::distance(turned.radiance({1, 0, 0}), Vec3(0, 1, 0)), 1e-3f);
}

TEST(EnvironmentLight, TheSeamIsWrapped) {
    Environment environment;
    environment.radiance = ImageRgb32f(8, 4, Vec3(0));
    for (int y = 0; y < 4; ++y) {
        environment.radiance(0, y) = Vec3(1);
        environment.radiance(7, y) = Vec3(3);
    }
    const Vec3 at_seam = EnvironmentLight(environment).radiance({-1, 0, 0});
    EXPECT_NEAR(at_seam.r, 2, 1e-3f);
}

TEST(EnvironmentLight, MeanLuminanceIsThatOfTheSphere) {
    EXPECT_NEAR(EnvironmentLight(constant(Vec3(0.5f))).mean_luminance(), 0.5f, 1e-5f);
    // White above the horizon: half the sphere, however few rows of pixels the pole takes.
    Environment half;
    half.radiance = ImageRgb32f(16, 64, Vec3(0));
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 16; ++x)
            half.radiance(x, y) = Vec3(1);
    }
    EXPECT_NEAR(EnvironmentLight(half).mean_luminance(), 0.5f, 1e-2f);
}

}  // namespace
}  // namespace candela
