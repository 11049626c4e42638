// SPDX-License-Identifier: MIT
#include "renderer/session/worker_pool.h"

namespace candela {

WorkerPool::WorkerPool(unsigned threads) {
    threads_.reserve(threads);
    for (unsigned i = 0; i < threads; ++i)
        threads_.emplace_back([this, i] { loop(i); });
}

WorkerPool::~WorkerPool() {
    quit_.store(true);
    job_.fetch_add(1);
    job_.notify_all();
    for (std::thread& thread : threads_)
        thread.join();
}

void WorkerPool::run(const std::function<void(unsigned)>& work) {
    work_ = &work;
    busy_.store(size());
    job_.fetch_add(1);
    job_.notify_all();
    for (uint32_t busy = busy_.load(); busy != 0; busy = busy_.load())
        busy_.wait(busy);
}

void WorkerPool::loop(unsigned worker) {
    uint32_t seen = 0;
    for (;;) {
        job_.wait(seen);
        seen = job_.load();
        if (quit_.load()) return;
        (*work_)(worker);
        if (busy_.fetch_sub(1) == 1) busy_.notify_one();
    }
}

}  // namespace candela
