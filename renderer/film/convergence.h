// SPDX-License-Identifier: MIT
// How a picture's stated error fell so far, and when it will reach a target.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace candela {

struct ErrorPoint {
    uint32_t spp = 0;
    double seconds = 0;  // of rendering
    double relative_error = 0;
    double relative_error_95 = 0;
};

// Points at least 4 % apart in samples, so that they stay few however long the render lasts; the last one may be
// nearer.
class ErrorHistory {
  public:
    void clear() { points_.clear(); }
    // Samples only grow. Does nothing while the error is unknown or 0.
    void add(const ErrorPoint& point);
    const std::vector<ErrorPoint>& points() const { return points_; }

  private:
    std::vector<ErrorPoint> points_;
};

// error ∝ samples^-slope: 0.5 for independent samples, up to 1 and more where the samples are well spread.
struct ErrorTrend {
    double slope = 0;
    double error_now = 0;  // on the line, at the last point
    uint32_t first_spp = 0, last_spp = 0;
    double last_seconds = 0;

    double error_at(double spp) const;
};

// The straight line in log-log through the last four octaves of samples; none where they span less than one and a half.
std::optional<ErrorTrend> fit_trend(const ErrorHistory& history);

// Seconds of rendering that are still missing, at the pace so far; none where the error does not fall. 0: it is there.
std::optional<double> seconds_until(const ErrorTrend& trend, double relative_error);

}  // namespace candela
