// SPDX-License-Identifier: MIT
// Loops on all cores.
#pragma once

#include <atomic>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

namespace candela {

// Calls work(i) for 0 … count - 1, about `grain` of them at a time. What was written before the loop is seen in it, and
// what is written in it after: TBB sees to that too, but where no sanitizer can tell.
template <typename Work>
void parallel_for_each(size_t count, size_t grain, const Work& work) {
    std::atomic<size_t> done{0};
    done.store(0, std::memory_order_release);
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, grain), [&](const tbb::blocked_range<size_t>& range) {
        (void)done.load(std::memory_order_acquire);
        for (size_t i = range.begin(); i != range.end(); ++i)
            work(i);
        done.fetch_add(range.size(), std::memory_order_acq_rel);
    });
    (void)done.load(std::memory_order_acquire);
}

// Both, at the same time where a core is free. The same holds of what is seen.
template <typename First, typename Second>
void parallel_pair(const First& first, const Second& second) {
    std::atomic<int> done{0};
    done.store(0, std::memory_order_release);
    const auto seen = [&](const auto& work) {
        return [&] {
            (void)done.load(std::memory_order_acquire);
            work();
            done.fetch_add(1, std::memory_order_acq_rel);
        };
    };
    tbb::parallel_invoke(seen(first), seen(second));
    (void)done.load(std::memory_order_acquire);
}

}  // namespace candela
