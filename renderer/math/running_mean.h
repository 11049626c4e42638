// SPDX-License-Identifier: MIT
// Mean and standard error of independent estimates.
#pragma once

#include <cmath>
#include <cstddef>

namespace candela {

// Collects estimates that are independent of each other; their scatter gives the standard error whatever happens within
// one.
class RunningMean {
  public:
    // Welford 1962.
    void add(double estimate) {
        ++count_;
        const double delta = estimate - mean_;
        mean_ += delta / static_cast<double>(count_);
        squares_ += delta * (estimate - mean_);
    }
    size_t count() const { return count_; }
    double mean() const { return mean_; }
    double standard_error() const {
        const auto n = static_cast<double>(count_);
        return count_ < 2 ? HUGE_VAL : std::sqrt(squares_ / (n - 1) / n);
    }

  private:
    size_t count_ = 0;
    double mean_ = 0;
    double squares_ = 0;
};

}  // namespace candela
