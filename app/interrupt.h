// SPDX-License-Identifier: MIT
// Ctrl+C: the first one asks to stop, the second ends the process at once.
#pragma once

#include <atomic>

namespace candela {

// While it lives, SIGINT and SIGTERM set a flag instead of ending the process.
class InterruptGuard {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    static bool interrupted();
    static const std::atomic<bool>* flag();
};

}  // namespace candela
