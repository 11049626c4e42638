// SPDX-License-Identifier: MIT
// Owns the loading thread: one task at a time, whose result the viewer fetches when it is ready.
#pragma once

#include <mutex>
#include <thread>

#include "app/exit_status.h"
#include "app/render_job.h"

namespace candela {

struct LoadedScene {
    RenderOptions options;
    RenderJob job;
};

class SceneLoader {
  public:
    using Progress = std::function<void(const char* step, double fraction)>;
    // What there is of the scene before all of it is there.
    using ShowPreview = std::function<void(LoadedScene)>;
    // Runs on the loading thread; throws CommandError.
    using Task = std::function<LoadedScene(const Progress&, const ShowPreview&, const std::atomic<bool>* cancel)>;

    SceneLoader() = default;
    ~SceneLoader();  // cancels and joins
    SceneLoader(const SceneLoader&) = delete;
    SceneLoader& operator=(const SceneLoader&) = delete;

    // Cancels what runs, whose result is dropped, and starts the task.
    void start(Task task);
    void cancel();
    bool busy() const { return busy_; }

    struct State {
        std::string step;
        double fraction = 0;
    };
    State state() const;

    struct Result {
        std::optional<LoadedScene> scene;
        std::string error;  // why there is none: one line
        ExitStatus status = ExitStatus::done;
    };
    // The result of the task, once; nothing while it runs.
    std::optional<Result> take();
    // What the task shows before its end, once; nothing when the result is there already.
    std::optional<LoadedScene> take_preview();

  private:
    void join();

    std::thread thread_;
    std::atomic<bool> cancel_{false}, ready_{false};
    bool busy_ = false;
    Result result_;  // the loading thread's until ready_
    mutable std::mutex state_mutex_;
    State state_;
    std::optional<LoadedScene> preview_;
};

}  // namespace candela
