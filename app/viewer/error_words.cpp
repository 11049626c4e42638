// SPDX-License-Identifier: MIT
#include "app/viewer/error_words.h"

#include <fmt/format.h>

#include <cmath>

namespace candela {

namespace {

// Rounded to two digits, without an exponent.
std::string two_digits(double value) {
    if (!(value > 0)) return "0";
    const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(value * 1.0049999))));
    const double scale = std::pow(10, 1 - std::floor(std::log10(value)));
    return fmt::format("{:.{}f}", value >= 100 ? std::round(value * scale) / scale : value, std::min(decimals, 6));
}

}  // namespace

std::string percent_text(double fraction) {
    return two_digits(100 * fraction) + " %";
}

std::string about_text(double seconds) {
    if (seconds < 1) return "1 s";
    if (seconds < 99.5) return two_digits(std::round(seconds)) + " s";
    if (seconds < 99.5 * 60) return two_digits(std::round(seconds / 60)) + " min";
    if (seconds < 99.5 * 3600) return two_digits(seconds / 3600) + " h";
    return two_digits(std::round(seconds / 86400)) + " days";
}

double next_target(double relative_error, std::optional<double> asked) {
    if (asked && *asked < relative_error) return *asked;
    double target = 1;
    constexpr double steps[] = {0.5, 0.4, 0.5};
    for (int i = 0; target > 0.95 * relative_error && i < 40; ++i)
        target *= steps[i % 3];
    return target;
}

ErrorWords error_words(const FilmStatistics& film, const ErrorHistory& history, std::optional<double> asked,
                       bool runs) {
    ErrorWords out;
    if (!(film.relative_error > 0)) return out;
    const std::string mean = percent_text(film.relative_error), bound = percent_text(film.relative_error_95);
    out.brief = fmt::format("error ±{}, 95 % within ±{}", mean, bound);
    out.sentence = fmt::format("mean error ±{}, 95 % of pixels within ±{}", mean, bound);
    if (!runs) return out;
    if (const std::optional<ErrorTrend> trend = fit_trend(history)) {
        const double target = next_target(film.relative_error, asked);
        const std::optional<double> seconds = seconds_until(*trend, target);
        if (seconds && *seconds < 1e9)
            out.sentence += fmt::format(", about {} to ±{:.3g} %", about_text(*seconds), 100 * target);
    }
    return out;
}

}  // namespace candela
