// SPDX-License-Identifier: MIT
#include "renderer/film/convergence.h"

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

constexpr double spacing = 1.04;      // of points, in samples
constexpr double fitted_factor = 16;  // of samples, from the first point of the line to the last
constexpr double shortest_factor = 2.8;

}  // namespace

void ErrorHistory::add(const ErrorPoint& point) {
    if (!(point.relative_error > 0)) return;
    const size_t n = points_.size();
    const bool same = n >= 1 && points_[n - 1].spp >= point.spp;
    const bool near = n >= 2 && points_[n - 1].spp < spacing * points_[n - 2].spp;
    if (same || near) {
        points_.back() = point;
    } else {
        points_.push_back(point);
    }
}

double ErrorTrend::error_at(double spp) const {
    return error_now * std::pow(spp / last_spp, -slope);
}

std::optional<ErrorTrend> fit_trend(const ErrorHistory& history) {
    const std::vector<ErrorPoint>& points = history.points();
    if (points.size() < 3) return std::nullopt;
    const ErrorPoint& last = points.back();
    const auto first = std::find_if(points.begin(), points.end(),
                                    [&](const ErrorPoint& p) { return fitted_factor * p.spp >= last.spp; });
    if (last.spp < shortest_factor * first->spp) return std::nullopt;

    // Least squares over equal shares of log samples: each point weighs as much as the gap that it closes.
    double weight = 0, x_sum = 0, y_sum = 0, xx_sum = 0, xy_sum = 0;
    for (auto p = first; p != points.end(); ++p) {
        const double before = p == first ? p->spp : (p - 1)->spp;
        const double after = p + 1 == points.end() ? p->spp : (p + 1)->spp;
        const double w = std::log(after / before);
        const double x = std::log(static_cast<double>(p->spp) / last.spp), y = std::log(p->relative_error);
        weight += w;
        x_sum += w * x;
        y_sum += w * y;
        xx_sum += w * x * x;
        xy_sum += w * x * y;
    }
    const double spread = xx_sum - x_sum * x_sum / weight;
    if (!(spread > 0)) return std::nullopt;
    ErrorTrend out;
    out.slope = -(xy_sum - x_sum * y_sum / weight) / spread;
    out.error_now = std::exp((y_sum + out.slope * x_sum) / weight);
    out.first_spp = first->spp;
    out.last_spp = last.spp;
    out.last_seconds = last.seconds;
    return out;
}

std::optional<double> seconds_until(const ErrorTrend& trend, double relative_error) {
    if (trend.error_now <= relative_error) return 0.0;
    // A line that hardly falls promises nothing.
    constexpr double flattest = 0.1;
    if (trend.slope < flattest || !(relative_error > 0)) return std::nullopt;
    const double factor = std::pow(trend.error_now / relative_error, 1 / trend.slope);
    return trend.last_seconds * (factor - 1);
}

}  // namespace candela
