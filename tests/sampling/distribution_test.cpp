// SPDX-License-Identifier: MIT
#include "renderer/sampling/distribution.h"

namespace candela {
namespace {

TEST(AliasTable, ChoosesInProportionAndRemaps) {
    const std::vector<float> weights = {1, 0, 3, 4, 0, 2};
    const AliasTable table(weights);
    std::vector<double> counts(weights.size(), 0), u_sums(weights.size(), 0);
    constexpr int n = 100000;
    for (int i = 0; i < n; ++i) {
        const AliasTable::Choice c = table.sample((static_cast<float>(i) + 0.5f) / n);
        counts[c.index] += 1;
        u_sums[c.index] += static_cast<double>(c.u_remapped);
        ASSERT_TRUE(c.u_remapped >= 0 && c.u_remapped < 1);
    }
    for (size_t i = 0; i < weights.size(); ++i) {
        EXPECT_NEAR(counts[i] / n, static_cast<double>(weights[i]) / 10, 1e-4);
        EXPECT_NEAR(table.probability(static_cast<uint32_t>(i)), weights[i] / 10, 1e-6);
        if (weights[i] > 0) {
            EXPECT_NEAR(u_sums[i] / counts[i], 0.5, 0.01);
        }
    }
}

TEST(AliasTable, AllZeroIsUniform) {
    const std::vector<float> weights(4, 0.0f);
    EXPECT_NEAR(AliasTable(weights).probability(2), 0.25f, 1e-6f);
}

TEST(Distribution2D, SamplesAgreeWithThePdfAndSkipEmptyCells) {
    const std::vector<float> weights = {0, 1, 0, 0, 0, 0, 2, 0, 5};
    const Distribution2D distribution(weights, 3, 3);
    std::vector<double> counts(9, 0);
    constexpr int n = 300;
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            float pdf = 0;
            const Vec2 p = distribution.sample((Vec2(x, y) + 0.5f) / static_cast<float>(n), pdf);
            ASSERT_NEAR(pdf, distribution.pdf(p), 1e-4f * pdf);
            counts[static_cast<size_t>(p.y * 3) * 3 + static_cast<size_t>(p.x * 3)] += 1.0 / (n * n);
        }
    }
    for (size_t i = 0; i < 9; ++i)
        EXPECT_NEAR(counts[i], static_cast<double>(weights[i]) / 8, 0.01) << i;
}

}  // namespace
}  // namespace candela
