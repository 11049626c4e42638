// SPDX-License-Identifier: MIT
// Work beside the window: one task at a time, on a thread of its own, whose result the viewer fetches when it is ready.
#pragma once

#include <atomic>
#include <functional>
#include <new>
#include <optional>
#include <thread>
#include <utility>

namespace candela {

template <typename Result>
class BackgroundTask {
  public:
    // Returns soon once *cancel is set. Nothing: it was cancelled, or came to nothing.
    using Work = std::function<std::optional<Result>(const std::atomic<bool>* cancel)>;

    BackgroundTask() = default;
    ~BackgroundTask() { stop(); }
    BackgroundTask(const BackgroundTask&) = delete;
    BackgroundTask& operator=(const BackgroundTask&) = delete;

    // Drops what runs, and starts.
    void start(Work work) {
        stop();
        cancel_ = false;
        ready_ = false;
        busy_ = true;
        thread_ = std::thread([this, run = std::move(work)] {
            try {
                result_ = run(&cancel_);
            } catch (const std::bad_alloc&) {
                // What there is no memory for comes to nothing.
            }
            ready_.store(true, std::memory_order_release);
        });
    }
    // Ends what runs, and waits for it.
    void stop() {
        cancel_ = true;
        if (thread_.joinable()) thread_.join();
        busy_ = false;
        result_.reset();
    }
    // What runs may end; its result is nothing.
    void cancel() { cancel_ = true; }
    bool busy() const { return busy_; }
    // Whether take() will end the task.
    bool ready() const { return busy_ && ready_.load(std::memory_order_acquire); }
    // The result, once; nothing while the task runs, or where it came to nothing.
    std::optional<Result> take() {
        if (!ready()) return std::nullopt;
        thread_.join();
        busy_ = false;
        return std::exchange(result_, std::nullopt);
    }

  private:
    std::thread thread_;
    std::atomic<bool> cancel_{false}, ready_{false};
    bool busy_ = false;
    std::optional<Result> result_;  // the task's until ready_
};

}  // namespace candela
