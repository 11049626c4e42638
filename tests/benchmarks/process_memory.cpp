// SPDX-License-Identifier: MIT
#include "tests/benchmarks/process_memory.h"

#include <fstream>
#include <string>

namespace candela::bench {

namespace {

// proc(5): a line "VmHWM:  1234 kB".
double status_bytes(const std::string& key) {
    std::ifstream file("/proc/self/status");
    for (std::string word; file >> word;) {
        double kilobytes = 0;
        if (word == key && file >> kilobytes) return 1024 * kilobytes;
    }
    return 0;
}

}  // namespace

double resident_bytes() {
    return status_bytes("VmRSS:");
}

double peak_bytes() {
    return status_bytes("VmHWM:");
}

void forget_peak() {
    std::ofstream("/proc/self/clear_refs") << 5;
}

}  // namespace candela::bench
