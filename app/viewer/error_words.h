// SPDX-License-Identifier: MIT
// The stated error as a person reads it.
#pragma once

#include <optional>
#include <string>

#include "renderer/film/frame.h"

namespace candela {

// "0.82 %", "12 %": two digits that count.
std::string percent_text(double fraction);
// "40 s", "12 min", "3.5 h": about so long.
std::string about_text(double seconds);

// What the picture is on its way to: what was asked for, else the next of …, 10 %, 5 %, 2 %, 1 %, … below.
double next_target(double relative_error, std::optional<double> asked);

// Empty while nothing is known.
struct ErrorWords {
    std::string sentence;  // "mean error ±0.82 %, 95 % of pixels within ±2.1 %, about 40 s to ±0.5 %"
    std::string brief;     // "error ±0.82 %, 95 % within ±2.1 %"
};
ErrorWords error_words(const FilmStatistics& film, const ErrorHistory& history, std::optional<double> asked,
                       bool runs);  // runs: false leaves the time out

}  // namespace candela
