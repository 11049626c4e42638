// SPDX-License-Identifier: MIT
// How long a person waits from an input to the first picture that follows it. Times in seconds of any one clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

namespace candela {

class LatencyMeter {
  public:
    struct Summary {
        double last_s = 0, median_s = 0, worst_s = 0;
        size_t count = 0;  // of pictures that the figures are of, the latest 64
    };

    // An input of that moment was submitted as that epoch.
    void submitted(uint64_t epoch, double input_s);
    // A picture with samples of that epoch is before the person's eyes: of all inputs that it answers the oldest
    // counts.
    void shown(uint64_t epoch, double now_s);
    // Some input is not answered by pictures of that epoch.
    bool waits(uint64_t epoch) const { return !waiting_.empty() && waiting_.back().epoch > epoch; }
    Summary summary() const;

  private:
    struct Input {
        uint64_t epoch = 0;
        double input_s = 0;
    };
    std::deque<Input> waiting_;
    std::deque<double> latencies_s_;
};

}  // namespace candela
