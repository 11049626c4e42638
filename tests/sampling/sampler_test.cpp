// SPDX-License-Identifier: MIT
#include "renderer/sampling/sampler.h"
#include "tests/support/chi_squared.h"

namespace candela {
namespace {

TEST(Sampler, EachPairOfEachReplicateIsAZeroTwoNet) {
    // Every elementary interval of area 1/64 holds one of the first 64 points of a replicate.
    for (uint32_t replicate = 0; replicate < replicate_count; ++replicate) {
        for (uint32_t dimension = 0; dimension < 20; dimension += 2) {
            for (uint32_t split = 0; split <= 6; ++split) {
                std::vector<int> cells(64, 0);
                for (uint32_t i = 0; i < 64; ++i) {
                    Sampler sampler(SamplerKind::sobol, Vec2u(5, 9), i * replicate_count + replicate, 3);
                    sampler.start_dimension(dimension);
                    const Vec2 u = sampler.next_2d();
                    const auto x = static_cast<uint32_t>(u.x * static_cast<float>(1u << split));
                    const auto y = static_cast<uint32_t>(u.y * static_cast<float>(64u >> split));
                    ++cells[y * (1u << split) + x];
                }
                for (const int count : cells)
                    ASSERT_EQ(count, 1) << "dimension " << dimension << " split " << split;
            }
        }
    }
}

// Whether the first 2^m points of a replicate, in the two pairs together, are a (t, m, 4)-net in base 2: every
// elementary interval of volume 2^(t - m) holds 2^t of them.
bool are_net(uint32_t first_dimension, uint32_t second_dimension, uint32_t t, uint32_t m) {
    std::vector<std::array<float, 4>> points;
    for (uint32_t i = 0; i < 1u << m; ++i) {
        Sampler sampler(SamplerKind::sobol, Vec2u(5, 9), i * replicate_count, 3);
        sampler.start_dimension(first_dimension);
        const Vec2 a = sampler.next_2d();
        sampler.start_dimension(second_dimension);
        const Vec2 b = sampler.next_2d();
        points.push_back({a.x, a.y, b.x, b.y});
    }
    const uint32_t digits = m - t;
    for (uint32_t a = 0; a <= digits; ++a) {
        for (uint32_t b = 0; a + b <= digits; ++b) {
            for (uint32_t c = 0; a + b + c <= digits; ++c) {
                const std::array<uint32_t, 4> splits{a, b, c, digits - a - b - c};
                std::vector<uint32_t> cells(size_t{1} << digits, 0);
                for (const auto& point : points) {
                    uint32_t cell = 0;
                    for (size_t d = 0; d < 4; ++d) {
                        const auto slab = static_cast<uint32_t>(point[d] * static_cast<float>(1u << splits[d]));
                        cell = (cell << splits[d]) | slab;
                    }
                    ++cells[cell];
                }
                if (std::ranges::any_of(cells, [&](uint32_t held) { return held != 1u << t; })) return false;
            }
        }
    }
    return true;
}

TEST(Sampler, TheFirstPairsAreNetsTogether) {
    constexpr uint32_t pixel = 0, lens = 2, direction = 4, choices = 6, light = 8;
    for (uint32_t m = 2; m <= 6; ++m)
        EXPECT_TRUE(are_net(pixel, direction, m == 5 ? 2 : 1, m)) << m;
    EXPECT_TRUE(are_net(pixel, direction, 2, 8));
    for (const uint32_t dimension : {lens, choices, light})
        EXPECT_TRUE(are_net(pixel, dimension, 4, 8)) << dimension;
    EXPECT_TRUE(are_net(direction, choices, 3, 8));
    // What is shuffled by chance is no such net.
    EXPECT_FALSE(are_net(pixel, 2 * joint_pairs, 3, 8));
}

TEST(Sampler, IsAPureFunctionAndStaysBelowOne) {
    for (const SamplerKind kind : {SamplerKind::sobol, SamplerKind::independent}) {
        for (uint32_t i = 0; i < 10000; ++i) {
            Sampler a(kind, Vec2u(i % 7, i / 7), i, 1), b(kind, Vec2u(i % 7, i / 7), i, 1);
            const Vec2 u = a.next_2d();
            ASSERT_EQ(u, b.next_2d());
            ASSERT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1);
        }
    }
}

TEST(Sampler, ABatchDrawsTheSamePoints) {
    for (const SamplerKind kind : {SamplerKind::sobol, SamplerKind::independent}) {
        PointBatch batch;
        std::vector<Sampler> samplers;
        // Not a whole number of vectors, and each at a dimension of its own.
        for (uint32_t i = 0; i < 61; ++i) {
            samplers.emplace_back(kind, Vec2u(i, 3 * i), 977 * i, 5);
            samplers.back().start_dimension(2 * (i % 9));
            batch.set(i, samplers.back());
        }
        batch.draw(samplers.size(), PointBatch::most_pairs);
        for (size_t i = 0; i < samplers.size(); ++i) {
            for (size_t pair = 0; pair < PointBatch::most_pairs; ++pair)
                ASSERT_EQ(batch.point(i, pair), samplers[i].next_2d());
        }
    }
}

TEST(Sampler, PixelsAndReplicatesAreUncorrelated) {
    for (const SamplerKind kind : {SamplerKind::sobol, SamplerKind::independent}) {
        constexpr int n = 20000;
        double neighbours = 0, replicates = 0;
        for (uint32_t i = 0; i < n; ++i) {
            const auto centred = [&](Vec2u pixel, uint32_t index) {
                return static_cast<double>(Sampler(kind, pixel, index, 0).next_2d().x) - 0.5;
            };
            neighbours += 12 * centred({i, 4}, 6) * centred({i + 1, 4}, 6);
            replicates += 12 * centred({i, 8}, 2) * centred({i, 8}, 3);
        }
        // Each mean of n products has a standard deviation of 1/sqrt(n).
        EXPECT_LT(std::abs(neighbours / n), 4 / std::sqrt(n));
        EXPECT_LT(std::abs(replicates / n), 4 / std::sqrt(n));
    }
}

}  // namespace
}  // namespace candela
