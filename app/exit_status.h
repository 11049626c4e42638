// SPDX-License-Identifier: MIT
// The exit codes of the contract, and the error that carries one up to main.
#pragma once

#include <stdexcept>
#include <string>

namespace candela {

enum class ExitStatus : int {
    done = 0,
    check_failed = 1,
    wrong_usage = 2,
    unreadable_scene = 3,
    unwritable_output = 4,
    internal_error = 5,
    interrupted = 130
};

// what() is the one line that the person sees: the file, the place in it, what is wrong, what would help.
class CommandError : public std::runtime_error {
  public:
    CommandError(ExitStatus status, const std::string& line) : std::runtime_error(line), status_(status) {}
    ExitStatus status() const { return status_; }

  private:
    ExitStatus status_;
};

}  // namespace candela
