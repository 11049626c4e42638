// SPDX-License-Identifier: MIT
// Threads that do one job together and are parked in between.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace candela {

class WorkerPool {
  public:
    explicit WorkerPool(unsigned threads);
    ~WorkerPool();
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    unsigned size() const { return static_cast<unsigned>(threads_.size()); }
    // Calls work(worker) once on every thread and returns when all have come back. work must not throw.
    void run(const std::function<void(unsigned)>& work);

  private:
    void loop(unsigned worker);

    std::vector<std::thread> threads_;
    const std::function<void(unsigned)>* work_ = nullptr;
    std::atomic<uint32_t> job_{0};
    std::atomic<uint32_t> busy_{0};
    std::atomic<bool> quit_{false};
};

}  // namespace candela
