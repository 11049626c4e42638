// SPDX-License-Identifier: MIT
// One line on standard error that tells how far a step is.
#pragma once

#include <chrono>
#include <string>

namespace candela {

class ProgressBar {
  public:
    // Shown when standard error is a terminal, or always when forced; never when quiet.
    ProgressBar(bool quiet, bool forced);
    ~ProgressBar() { clear(); }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    // fraction 0..1; detail stands behind the bar. Redraws at most ten times a second.
    void show(const std::string& step, double fraction, const std::string& detail = "");
    void clear();

  private:
    bool terminal_, visible_;
    bool drawn_ = false;
    std::chrono::steady_clock::time_point last_draw_;
    std::string last_step_;
};

}  // namespace candela
