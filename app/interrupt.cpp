// SPDX-License-Identifier: MIT
#include "app/interrupt.h"

#include <csignal>

namespace candela {

namespace {

std::atomic<bool> interrupt_flag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

void handle(int signal) {
    interrupt_flag.store(true);
    std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard() {
    interrupt_flag.store(false);
    std::signal(SIGINT, handle);
    std::signal(SIGTERM, handle);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool InterruptGuard::interrupted() {
    return interrupt_flag.load();
}

const std::atomic<bool>* InterruptGuard::flag() {
    return &interrupt_flag;
}

}  // namespace candela
