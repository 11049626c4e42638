// SPDX-License-Identifier: MIT
// Pearson's chi² test of counts against expectations.
#pragma once

#include <cmath>
#include <vector>

namespace candela::test {

// Standard score of the chi² statistic (Wilson and Hilferty 1931): about normal; large means that the counts do not
// follow the expectation. Cells that expect fewer than five are pooled.
inline double chi_squared_score(const std::vector<double>& counts, const std::vector<double>& expected) {
    double statistic = 0, pooled_count = 0, pooled_expected = 0;
    int cells = 0;
    const auto add = [&](double count, double expect) {
        statistic += (count - expect) * (count - expect) / expect;
        ++cells;
    };
    for (size_t i = 0; i < counts.size(); ++i) {
        if (expected[i] >= 5) {
            add(counts[i], expected[i]);
            continue;
        }
        pooled_count += counts[i];
        pooled_expected += expected[i];
    }
    if (pooled_expected >= 5) add(pooled_count, pooled_expected);
    if (pooled_expected < 5 && pooled_count > 50) return 1e9;
    const double dof = std::max(cells - 1, 1);
    const double spread = 2.0 / (9.0 * dof);
    return (std::cbrt(statistic / dof) - (1.0 - spread)) / std::sqrt(spread);
}

}  // namespace candela::test
