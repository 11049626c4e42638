// SPDX-License-Identifier: MIT
// How far scenes that build at the same time have come. Private to this room.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>

namespace candela {

// Adds up the progress of all scenes, in triangles, and passes on whole percents in order.
class BuildProgress {
  public:
    BuildProgress(uint64_t total, const std::function<void(float)>& report, const std::atomic<bool>* cancel)
        : total_(std::max<uint64_t>(total, 1)), report_(report), cancel_(cancel) {}

    bool cancelled() const { return cancel_ != nullptr && cancel_->load(std::memory_order_relaxed); }

    void add(uint64_t triangles) {
        if (!report_) return;
        const uint64_t done = done_.fetch_add(triangles, std::memory_order_relaxed) + triangles;
        const auto percent = static_cast<int>(std::min<uint64_t>(100 * done / total_, 100));
        int last = last_percent_.load(std::memory_order_relaxed);
        while (percent > last) {
            if (last_percent_.compare_exchange_weak(last, percent, std::memory_order_relaxed)) {
                report_(static_cast<float>(percent) * 0.01f);
                return;
            }
        }
    }

  private:
    uint64_t total_;
    const std::function<void(float)>& report_;
    const std::atomic<bool>* cancel_;
    std::atomic<uint64_t> done_{0};
    std::atomic<int> last_percent_{-1};
};

// The share of one scene. Embree's fractions may step back and come from several threads.
struct SceneProgress {
    BuildProgress& all;
    uint64_t triangles = 0;
    std::atomic<uint64_t> done{0};

    void reach(uint64_t now) {
        uint64_t before = done.load(std::memory_order_relaxed);
        while (now > before) {
            if (done.compare_exchange_weak(before, now, std::memory_order_relaxed)) {
                all.add(now - before);
                return;
            }
        }
    }

    static bool monitor(void* user, double fraction) {
        auto& self = *static_cast<SceneProgress*>(user);
        const double reached = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(self.triangles);
        self.reach(static_cast<uint64_t>(reached));
        return !self.all.cancelled();
    }
};

}  // namespace candela
