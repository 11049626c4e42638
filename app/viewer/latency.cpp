// SPDX-License-Identifier: MIT
#include "app/viewer/latency.h"

#include <algorithm>
#include <vector>

namespace candela {

namespace {

constexpr size_t most_latencies = 64;

}  // namespace

void LatencyMeter::submitted(uint64_t epoch, double input_s) {
    waiting_.push_back({epoch, input_s});
}

void LatencyMeter::shown(uint64_t epoch, double now_s) {
    if (waiting_.empty() || waiting_.front().epoch > epoch) return;
    latencies_s_.push_back(now_s - waiting_.front().input_s);
    if (latencies_s_.size() > most_latencies) latencies_s_.pop_front();
    while (!waiting_.empty() && waiting_.front().epoch <= epoch)
        waiting_.pop_front();
}

LatencyMeter::Summary LatencyMeter::summary() const {
    Summary out;
    out.count = latencies_s_.size();
    if (out.count == 0) return out;
    std::vector<double> sorted(latencies_s_.begin(), latencies_s_.end());
    std::sort(sorted.begin(), sorted.end());
    out.last_s = latencies_s_.back();
    out.median_s = sorted[sorted.size() / 2];
    out.worst_s = sorted.back();
    return out;
}

}  // namespace candela
