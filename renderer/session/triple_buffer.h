// SPDX-License-Identifier: MIT
// One writer, one reader, no waiting: the reader always gets the newest whole value.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace candela {

template <typename T>
class TripleBuffer {
  public:
    // Writer: the slot to fill, then publish it.
    T& back() { return slots_[back_]; }
    void publish() { back_ = middle_.exchange(back_ | fresh, std::memory_order_acq_rel) & index_mask; }

    // Reader: the newest published value, or null before the first. Valid until the next call.
    const T* latest() {
        if ((middle_.load(std::memory_order_relaxed) & fresh) != 0) {
            front_ = middle_.exchange(front_, std::memory_order_acq_rel) & index_mask;
            any_ = true;
        }
        return any_ ? &slots_[front_] : nullptr;
    }

  private:
    static constexpr uint32_t fresh = 4, index_mask = 3;
    std::array<T, 3> slots_{};
    std::atomic<uint32_t> middle_{1};
    uint32_t back_ = 0;
    uint32_t front_ = 2;
    bool any_ = false;
};

}  // namespace candela
