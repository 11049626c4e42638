// SPDX-License-Identifier: MIT
#include "app/progress_bar.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

namespace candela {

namespace {

size_t terminal_columns() {
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

ProgressBar::ProgressBar(bool quiet, bool forced)
    : terminal_(isatty(STDERR_FILENO) != 0), visible_(!quiet && (terminal_ || forced)) {}

void ProgressBar::show(const std::string& step, double fraction, const std::string& detail) {
    if (!visible_) return;
    const auto now = std::chrono::steady_clock::now();
    const double interval = terminal_ ? 0.1 : 2.0;
    if (step == last_step_ && std::chrono::duration<double>(now - last_draw_).count() < interval) return;
    last_step_ = step;
    last_draw_ = now;
    fraction = std::clamp(fraction, 0.0, 1.0);
    if (!terminal_) {
        fmt::print(stderr, "{} {:3.0f} % {}\n", step, 100 * fraction, detail);
        return;
    }
    // The bar takes what the words leave of the line, and goes first where there is little room.
    const size_t columns = terminal_columns() - 1;
    const std::string words = fmt::format("{:3.0f} % {}", 100 * fraction, detail);
    std::string line = step + " ";
    const size_t room = columns > line.size() + words.size() + 4 ? columns - line.size() - words.size() - 4 : 0;
    if (room >= 8) {
        const size_t width = std::min<size_t>(room, 40);
        const auto filled = static_cast<size_t>(fraction * static_cast<double>(width));
        line += "[" + std::string(filled, '#') + std::string(width - filled, '.') + "] ";
    }
    line += words;
    fmt::print(stderr, "\r\033[K{}", line.substr(0, columns));
    std::fflush(stderr);
    drawn_ = true;
}

void ProgressBar::clear() {
    if (drawn_) fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
    drawn_ = false;
}

}  // namespace candela
