// SPDX-License-Identifier: MIT
// Choosing a light and a point on it: against the pdfs that it states and the solid angles that lights cover.
#include "renderer/lights/lights.h"

#include <random>

#include "tests/support/batch_means.h"
#include "tests/support/chi_squared.h"

namespace candela {
namespace {

class Uniform {
  public:
    float operator()() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }

  private:
    std::mt19937 engine_{17};
};

EmissiveTriangle make_triangle(const Vec3& p0, const Vec3& p1, const Vec3& p2, float radiance = 1,
                               bool two_sided = true) {
    EmissiveTriangle out;
    out.p0 = p0;
    out.edge1 = p1 - p0;
    out.edge2 = p2 - p0;
    out.mean_radiance = radiance;
    out.two_sided = two_sided;
    return out;
}

Lights make_lights(std::vector<EmissiveTriangle> triangles, std::vector<PlacedLight> punctual = {}) {
    Lights out;
    out.triangles = std::move(triangles);
    out.punctual = std::move(punctual);
    finish_lights(out, {{-5, -5, -5}, {5, 5, 5}});
    return out;
}

// Van Oosterom and Strackee 1983.
double solid_angle(const EmissiveTriangle& t, const Vec3& from) {
    const glm::dvec3 a = glm::normalize(glm::dvec3(t.p0 - from)), b = glm::normalize(glm::dvec3(t.p0 + t.edge1 - from)),
                     c = glm::normalize(glm::dvec3(t.p0 + t.edge2 - from));
    return 2 *
           std::abs(std::atan2(glm::dot(a, glm::cross(b, c)), 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a)));
}

// Draws directions to one triangle and counts them in cells of its barycentric square; what a cell should get is the
// integral of the stated pdf over the cell's solid angle.
double triangle_score(const EmissiveTriangle& triangle, const Vec3& from) {
    const Lights lights = make_lights({triangle});
    constexpr int grid = 12, fine = 24, count = 200000;
    Uniform uniform;
    std::vector<double> counts(grid * grid, 0), expected(grid * grid, 0);
    for (int i = 0; i < count; ++i) {
        const float pick = uniform(), a = uniform();
        const LightSample s = sample_light(lights, {from}, LightCoverage::complete, pick, {a, uniform()});
        EXPECT_GT(s.pdf, 0);
        EXPECT_NEAR(triangle_light_pdf(lights, 0, {from}, LightCoverage::complete, s.wi, s.distance) / s.pdf, 1, 5e-3f);
        const Vec3 point = triangle.p0 + s.u * triangle.edge1 + s.v * triangle.edge2;
        EXPECT_LT(glm::distance(point, from + s.distance * s.wi), 1e-3f * s.distance);
        const auto cell = [](float x) { return static_cast<size_t>(std::clamp(x, 0.0f, one_minus_epsilon) * grid); };
        counts[cell(s.v) * grid + cell(s.u)] += 1;
    }
    const Vec3 normal = glm::cross(triangle.edge1, triangle.edge2);
    const double cell_area = static_cast<double>(glm::length(normal)) / (grid * fine * grid * fine);
    for (int y = 0; y < grid * fine; ++y) {
        for (int x = 0; x < grid * fine; ++x) {
            const Vec2 uv = (Vec2(x, y) + 0.5f) / static_cast<float>(grid * fine);
            if (uv.x + uv.y >= 1) continue;
            // dω = dA |cos θ| / r².
            const Vec3 to = triangle.p0 + uv.x * triangle.edge1 + uv.y * triangle.edge2 - from;
            const float distance = glm::length(to);
            const double d_omega =
                cell_area *
                static_cast<double>(std::abs(glm::dot(glm::normalize(normal), to / distance)) / (distance * distance));
            expected[static_cast<size_t>(y / fine * grid + x / fine)] +=
                static_cast<double>(
                    triangle_light_pdf(lights, 0, {from}, LightCoverage::complete, to / distance, distance)) *
                d_omega * count;
        }
    }
    // The staircase along the hypotenuse costs accuracy there: compare the sum, then the cells inside.
    std::vector<double> inner_counts, inner_expected;
    for (int y = 0; y < grid; ++y) {
        for (int x = 0; x + y < grid - 1; ++x) {
            inner_counts.push_back(counts[static_cast<size_t>(y * grid + x)]);
            inner_expected.push_back(expected[static_cast<size_t>(y * grid + x)]);
        }
    }
    return test::chi_squared_score(inner_counts, inner_expected);
}

TEST(Lights, DirectionsToATriangleFollowTheirPdf) {
    const EmissiveTriangle triangle = make_triangle({-1, 2, -0.5f}, {1.5f, 2.2f, 0}, {0, 1.5f, 1});
    EXPECT_LT(triangle_score(triangle, {0, 0, 0}), 4);        // middling
    EXPECT_LT(triangle_score(triangle, {0.2f, 1.7f, 0}), 4);  // very near: most of a hemisphere
    EXPECT_LT(triangle_score(triangle, {40, -60, 30}), 4);    // small and far: sampled by area
    EXPECT_LT(triangle_score(make_triangle({-3, 1, 0}, {3, 1, 0}, {3, 1, 0.02f}), {0, 0, 0}), 4);  // a sliver
}

TEST(Lights, ThePdfOfATriangleIsOneOverItsSolidAngle) {
    const EmissiveTriangle triangle = make_triangle({-1, 2, -0.5f}, {1.5f, 2.2f, 0}, {0, 1.5f, 1});
    const Lights lights = make_lights({triangle});
    Uniform uniform;
    test::BatchMeans inverse_pdf;
    for (int i = 0; i < 20000; ++i) {
        const float a = uniform();
        inverse_pdf.add(1.0 /
                        static_cast<double>(
                            sample_light(lights, {Vec3(0)}, LightCoverage::complete, uniform(), {a, uniform()}).pdf));
    }
    EXPECT_NEAR(inverse_pdf.mean(), solid_angle(triangle, Vec3(0)), 4 * inverse_pdf.standard_error() + 1e-4);
}

TEST(Lights, AOneSidedEmitterIsNotSampledFromBehind) {
    // Its front is where edge1 × edge2 points: down.
    const EmissiveTriangle triangle = make_triangle({-1, 2, -1}, {1, 2, -1}, {0, 2, 1}, 1, false);
    const Vec3 normal = glm::cross(triangle.edge1, triangle.edge2);
    ASSERT_LT(normal.y, 0);
    const Lights lights = make_lights({triangle});
    EXPECT_GT(sample_light(lights, {Vec3(0, 0, 0)}, LightCoverage::complete, 0.5f, {0.3f, 0.4f}).pdf, 0);
    EXPECT_EQ(sample_light(lights, {Vec3(0, 4, 0)}, LightCoverage::complete, 0.5f, {0.3f, 0.4f}).pdf, 0);
    EXPECT_GT(triangle_light_pdf(lights, 0, {Vec3(0, 0, 0)}, LightCoverage::complete, {0, 1, 0}, 2), 0);
    EXPECT_EQ(triangle_light_pdf(lights, 0, {Vec3(0, 4, 0)}, LightCoverage::complete, {0, -1, 0}, 2), 0);
}

TEST(Lights, LightsAreChosenByPower) {
    // Equal triangles, radiance 1 and 3.
    const Lights lights = make_lights(
        {make_triangle({-1, 2, 0}, {0, 2, 0}, {0, 2, 1}, 1), make_triangle({1, 2, 0}, {2, 2, 0}, {2, 2, 1}, 3)});
    Uniform uniform;
    int second = 0;
    constexpr int count = 40000;
    for (int i = 0; i < count; ++i) {
        const float pick = uniform(), a = uniform();
        second +=
            sample_light(lights, {Vec3(0.5f, 0, 0)}, LightCoverage::complete, pick, {a, uniform()}).wi.x > 0 ? 1 : 0;
    }
    EXPECT_NEAR(second / static_cast<double>(count), 0.75, 4 * std::sqrt(0.75 * 0.25 / count));
}

// Σ over everything there is of ∫ dω = E[1/pdf].
TEST(Lights, AMixtureCoversTheWholeSolidAngle) {
    Lights lights = make_lights({make_triangle({-1, 2, -0.5f}, {1.5f, 2.2f, 0}, {0, 1.5f, 1}, 5),
                                 make_triangle({-2, -1, 0}, {-2, 1, 0}, {-2, 0, 1}, 2)});
    Environment sky;
    sky.radiance = ImageRgb32f(1, 1, Vec3(1));
    lights.environment = std::make_shared<const EnvironmentLight>(sky);
    finish_lights(lights, {{-5, -5, -5}, {5, 5, 5}});
    EXPECT_GT(lights.environment_probability[0], 0);
    EXPECT_LT(lights.environment_probability[0], 1);
    const double exact = 4 * static_cast<double>(pi) + solid_angle(lights.triangles[0], Vec3(0)) +
                         solid_angle(lights.triangles[1], Vec3(0));
    Uniform uniform;
    test::BatchMeans means;
    for (int i = 0; i < 100000; ++i) {
        const float pick = uniform(), a = uniform();
        const LightSample s = sample_light(lights, {Vec3(0)}, LightCoverage::complete, pick, {a, uniform()});
        means.add(s.pdf > 0 ? 1.0 / static_cast<double>(s.pdf) : 0.0);
        if (std::isinf(s.distance)) {
            EXPECT_NEAR(environment_light_pdf(lights, LightCoverage::complete, s.wi) / s.pdf, 1, 1e-3f);
        }
    }
    EXPECT_TRUE(test::within_standard_errors(means, exact, 4))
        << means.mean() << " ± " << means.standard_error() << " is not " << exact;
}

TEST(Lights, APointLightFollowsTheInverseSquareLaw) {
    PlacedLight point;
    point.position = {0, 3, 0};
    point.intensity = Vec3(18, 9, 0);
    const Lights lights = make_lights({}, {point});
    const LightSample s = sample_light(lights, {Vec3(0, 0, 0)}, LightCoverage::complete, 0.3f, {0.1f, 0.2f});
    EXPECT_TRUE(s.is_delta);
    EXPECT_FLOAT_EQ(s.pdf, 1);
    EXPECT_FLOAT_EQ(s.distance, 3);
    EXPECT_LT(glm::distance(s.weight, Vec3(2, 1, 0)), 1e-5f);
    EXPECT_LT(glm::distance(s.wi, Vec3(0, 1, 0)), 1e-6f);
}

TEST(Lights, TheMeanOverTheChoiceIsTheSumOfAllPunctualLights) {
    PlacedLight bright;
    bright.position = {0, 3, 0};
    bright.intensity = Vec3(18);
    PlacedLight dim = bright;
    dim.position = {0, 0, 2};
    dim.intensity = Vec3(4);
    PlacedLight sun;
    sun.kind = LightKind::directional;
    sun.intensity = Vec3(0.25f);
    const Lights lights = make_lights({}, {bright, dim, sun});
    Uniform uniform;
    test::BatchMeans means;
    for (int i = 0; i < 40000; ++i)
        means.add(static_cast<double>(
            sample_light(lights, {Vec3(0)}, LightCoverage::complete, uniform(), {0.5f, 0.5f}).weight.g));
    EXPECT_TRUE(test::within_standard_errors(means, 18.0 / 9 + 4.0 / 4 + 0.25, 4))
        << means.mean() << " ± " << means.standard_error();
    EXPECT_LT(means.standard_error(), 0.02);
}

TEST(Lights, ASpotFallsOffBetweenItsCones) {
    // KHR_lights_punctual: t = (cos θ − cos outer) / (cos inner − cos outer), squared.
    PlacedLight spot;
    spot.kind = LightKind::spot;
    spot.position = {0, 1, 0};
    spot.direction = {0, -1, 0};
    spot.cos_inner = std::cos(0.3f);
    spot.cos_outer = std::cos(0.6f);
    const Lights lights = make_lights({}, {spot});
    const auto at = [&](float angle) {
        const LightSample s =
            sample_light(lights, {Vec3(std::tan(angle), 0, 0)}, LightCoverage::complete, 0.5f, {0.5f, 0.5f});
        return s.pdf > 0 ? s.weight.r * s.distance * s.distance : 0.0f;
    };
    EXPECT_NEAR(at(0), 1, 1e-4f);
    EXPECT_NEAR(at(0.29f), 1, 1e-3f);
    const float t = (std::cos(0.45f) - std::cos(0.6f)) / (std::cos(0.3f) - std::cos(0.6f));
    EXPECT_NEAR(at(0.45f), t * t, 1e-3f);
    EXPECT_EQ(at(0.61f), 0);
}

TEST(Lights, ADirectionalLightIsTheSameEverywhere) {
    PlacedLight sun;
    sun.kind = LightKind::directional;
    sun.direction = glm::normalize(Vec3(1, -2, 0));
    sun.intensity = Vec3(7);
    const Lights lights = make_lights({}, {sun});
    for (const Vec3& from : {Vec3(0), Vec3(4, -2, 1)}) {
        const LightSample s = sample_light(lights, {from}, LightCoverage::complete, 0.5f, {0.5f, 0.5f});
        EXPECT_LT(glm::distance(s.wi, -sun.direction), 1e-6f);
        EXPECT_LT(glm::distance(s.weight, Vec3(7)), 1e-5f);
        EXPECT_TRUE(std::isinf(s.distance));
        EXPECT_TRUE(s.is_delta);
    }
}

TEST(Lights, NoLightIsNoSample) {
    EXPECT_EQ(sample_light(make_lights({}), {}, LightCoverage::complete, 0.5f, {0.5f, 0.5f}).pdf, 0);
}

}  // namespace
}  // namespace candela
