// SPDX-License-Identifier: MIT
// Seconds as a person reads them.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace candela {

// "0:07", "1:02:03"
inline std::string clock_text(double seconds) {
    const int64_t whole = std::llround(seconds);
    return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                        : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace candela
