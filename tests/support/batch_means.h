// SPDX-License-Identifier: MIT
// Mean and standard error from independent batches.
#pragma once

#include "renderer/math/running_mean.h"

namespace candela::test {

using BatchMeans = RunningMean;

inline bool within_standard_errors(const BatchMeans& means, double exact, double how_many) {
    return std::abs(means.mean() - exact) <= how_many * means.standard_error();
}

}  // namespace candela::test
