// SPDX-License-Identifier: MIT
// An X server of our own without a screen, programs that run on it, and what their windows show.
#pragma once

#include <sys/types.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/image/image.h"

namespace candela::test {

// A child process; killed and collected with its owner.
class Process {
  public:
    // environment: "NAME=value" on top of ours. Standard error goes to error_file, when named.
    Process(const std::vector<std::string>& arguments, const std::vector<std::string>& environment,
            const std::string& error_file = "");
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    pid_t pid() const { return pid_; }
    // The exit status (128 + signal where one ended it), or nothing if it still runs after the timeout.
    std::optional<int> wait_for_exit(double timeout_s);
    // User and system time so far.
    double cpu_seconds() const;

  private:
    pid_t pid_ = -1;
    std::optional<int> status_;
};

class VirtualDisplay {
  public:
    // Throws std::runtime_error where Xvfb cannot be started.
    VirtualDisplay(int width, int height);

    // ":93"
    const std::string& name() const { return name_; }
    // What a window shows, without the alpha. Throws std::runtime_error once the window is gone.
    ImageRgba8 capture(unsigned long window) const;
    // Runs xdotool; returns the first line that it prints.
    std::string xdotool(const std::string& arguments) const;
    // Drops the file in the middle of the window, as a file manager would (XDND version 5); false where it is refused.
    bool drop(unsigned long window, const std::string& path) const;

  private:
    std::string name_;
    std::unique_ptr<Process> server_;
};

}  // namespace candela::test
