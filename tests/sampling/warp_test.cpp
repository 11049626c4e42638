// SPDX-License-Identifier: MIT
#include <random>

#include "renderer/sampling/warp.h"
#include "tests/support/chi_squared.h"

namespace candela {
namespace {

constexpr int grid = 16, count = 200000;

// Draws points, maps each to a cell of a 16 × 16 grid on the unit square, and compares with the mass that each cell
// should have.
template <typename Draw, typename Mass>
double score(Draw draw, Mass mass) {
    std::mt19937 engine(7);
    std::vector<double> counts(grid * grid, 0), expected(grid * grid, 0);
    const auto uniform = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24f; };
    for (int i = 0; i < count; ++i) {
        const float a = uniform();
        const Vec2 at =
            glm::clamp(draw(Vec2(a, uniform())), Vec2(0), Vec2(one_minus_epsilon)) * static_cast<float>(grid);
        counts[static_cast<size_t>(at.y) * grid + static_cast<size_t>(at.x)] += 1;
    }
    constexpr int fine = 32;
    for (int y = 0; y < grid * fine; ++y) {
        for (int x = 0; x < grid * fine; ++x) {
            const Vec2 at = (Vec2(x, y) + 0.5f) / static_cast<float>(grid * fine);
            expected[static_cast<size_t>(y / fine * grid + x / fine)] +=
                static_cast<double>(mass(at)) * count / (grid * fine * grid * fine);
        }
    }
    return test::chi_squared_score(counts, expected);
}

TEST(Warp, DiscIsUniform) {
    EXPECT_LT(score([](Vec2 u) { return 0.5f + 0.5f * sample_disc(u); },
                    [](Vec2 p) { return glm::length(2.0f * p - 1.0f) < 1 ? 4 * disc_pdf() : 0.0f; }),
              4);
}

TEST(Warp, CosineHemisphereFollowsItsPdf) {
    // In (cosθ, φ) the solid angle is uniform.
    EXPECT_LT(score(
                  [](Vec2 u) {
                      const Vec3 w = sample_cosine_hemisphere(u);
                      return Vec2(w.z, std::atan2(w.y, w.x) / (2 * pi) + 0.5f);
                  },
                  [](Vec2 p) { return 2 * pi * cosine_hemisphere_pdf(p.x); }),
              4);
}

TEST(Warp, SphereIsUniform) {
    EXPECT_LT(score(
                  [](Vec2 u) {
                      const Vec3 w = sample_sphere(u);
                      return Vec2(0.5f + 0.5f * w.z, std::atan2(w.y, w.x) / (2 * pi) + 0.5f);
                  },
                  [](Vec2) { return 4 * pi * sphere_pdf(); }),
              4);
}

TEST(Warp, TriangleIsUniform) {
    EXPECT_LT(score([](Vec2 u) { return sample_triangle(u); },
                    [](Vec2 p) { return p.x + p.y < 1 ? 2.0f : (p.x + p.y == 1 ? 1.0f : 0.0f); }),
              4);
}

TEST(Warp, BlackmanHarrisFollowsItsPdf) {
    constexpr float radius = 1.5f;
    EXPECT_LT(
        score([](Vec2 u) { return sample_blackman_harris(u, radius) / (2 * radius) + 0.5f; },
              [](Vec2 p) { return blackman_harris_pdf((p - 0.5f) * (2 * radius), radius) * 4 * radius * radius; }),
        4);
}

}  // namespace
}  // namespace candela
