// SPDX-License-Identifier: MIT
#include "app/viewer/scene_loader.h"

namespace candela {

SceneLoader::~SceneLoader() {
    join();
}

void SceneLoader::join() {
    cancel_ = true;
    if (thread_.joinable()) thread_.join();
    busy_ = false;
}

void SceneLoader::start(Task task) {
    join();
    cancel_ = false;
    ready_ = false;
    result_ = {};
    {
        const std::lock_guard lock(state_mutex_);
        state_ = {};
    }
    busy_ = true;
    thread_ = std::thread([this, run = std::move(task)] {
        const Progress progress = [this](const char* step, double fraction) {
            const std::lock_guard lock(state_mutex_);
            state_ = {step, fraction};
        };
        try {
            result_.scene = run(progress, &cancel_);
        } catch (const CommandError& error) {
            result_.error = error.what();
            result_.status = error.status();
        } catch (const std::bad_alloc&) {
            result_.error = "there is not enough memory for this scene";
            result_.status = ExitStatus::internal_error;
        } catch (const std::exception& error) {
            result_.error = error.what();
            result_.status = ExitStatus::internal_error;
        }
        ready_.store(true, std::memory_order_release);
    });
}

SceneLoader::State SceneLoader::state() const {
    const std::lock_guard lock(state_mutex_);
    return state_;
}

std::optional<SceneLoader::Result> SceneLoader::take() {
    if (!busy_ || !ready_.load(std::memory_order_acquire)) return std::nullopt;
    thread_.join();
    busy_ = false;
    return std::move(result_);
}

}  // namespace candela
