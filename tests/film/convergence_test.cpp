// SPDX-License-Identifier: MIT
#include "renderer/film/convergence.h"

#include <cmath>

namespace candela {
namespace {

// At 4 samples a second.
ErrorHistory history_of(double at_one, double slope, uint32_t spp) {
    ErrorHistory out;
    for (uint32_t n = 2; n <= spp; n += 2) {
        const double error = at_one * std::pow(n, -slope);
        out.add({n, 0.25 * n, error, 2 * error});
    }
    return out;
}

TEST(Convergence, TheTrendIsTheLineThatThePointsLieOn) {
    for (const double slope : {0.3, 0.5, 1.0}) {
        const std::optional<ErrorTrend> trend = fit_trend(history_of(0.4, slope, 1024));
        ASSERT_TRUE(trend);
        EXPECT_NEAR(trend->slope, slope, 1e-6);
        EXPECT_NEAR(trend->error_at(64), 0.4 * std::pow(64, -slope), 1e-6);
        EXPECT_NEAR(trend->first_spp, 64, 4);
    }
}

TEST(Convergence, TimeToATargetIsThatOfTheLine) {
    const std::optional<ErrorTrend> trend = fit_trend(history_of(0.4, 0.5, 400));
    ASSERT_TRUE(trend);
    // 0.02 at 400 samples after 100 s: half of it takes 1600 samples, 300 s more.
    EXPECT_NEAR(*seconds_until(*trend, 0.01), 300, 1);
    EXPECT_EQ(*seconds_until(*trend, 0.02001), 0);
    EXPECT_FALSE(seconds_until(*trend, 0));
    EXPECT_FALSE(seconds_until(*fit_trend(history_of(0.4, 0.01, 400)), 0.01)) << "it does not fall";
}

TEST(Convergence, NothingIsSaidTooEarly) {
    EXPECT_FALSE(fit_trend({}));
    EXPECT_FALSE(fit_trend(history_of(0.4, 0.5, 4)));
    ErrorHistory unknown;
    for (uint32_t n = 2; n < 100; n += 2)
        unknown.add({n, 1.0, std::nan(""), std::nan("")});
    EXPECT_TRUE(unknown.points().empty());
}

TEST(Convergence, LongRendersKeepFewPointsAndTheLastOne) {
    const ErrorHistory history = history_of(1, 0.5, 200000);
    EXPECT_LT(history.points().size(), 400u);
    EXPECT_GT(history.points().size(), 100u);
    EXPECT_EQ(history.points().front().spp, 2u);
    EXPECT_EQ(history.points().back().spp, 200000u);
}

}  // namespace
}  // namespace candela
