// SPDX-License-Identifier: MIT
// What share of measured values lies below.
#pragma once

#include <algorithm>
#include <vector>

namespace candela::bench {

// share 0.5: the median; 1: the largest. Of no values: 0.
inline double percentile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1, static_cast<size_t>(share * static_cast<double>(values.size())))];
}

}  // namespace candela::bench
