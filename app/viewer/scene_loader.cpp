// SPDX-License-Identifier: MIT
#include "app/viewer/scene_loader.h"

#include <utility>

namespace candela {

SceneLoader::~SceneLoader() {
    join();
}

void SceneLoader::join() {
    cancel_ = true;
    if (thread_.joinable()) thread_.join();
    busy_ = false;
}

void SceneLoader::cancel() {
    join();
    ready_ = false;
    const std::lock_guard lock(state_mutex_);
    preview_.reset();
}

void SceneLoader::start(Task task) {
    join();
    cancel_ = false;
    ready_ = false;
    result_ = {};
    {
        const std::lock_guard lock(state_mutex_);
        state_ = {};
        preview_.reset();
    }
    busy_ = true;
    thread_ = std::thread([this, run = std::move(task)] {
        const Progress progress = [this](const char* step, double fraction) {
            const std::lock_guard lock(state_mutex_);
            state_ = {step, fraction};
        };
        const ShowPreview show_preview = [this](LoadedScene preview) {
            const std::lock_guard lock(state_mutex_);
            preview_ = std::move(preview);
        };
        try {
            result_.scene = run(progress, show_preview, &cancel_);
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

std::optional<LoadedScene> SceneLoader::take_preview() {
    if (!busy_ || ready_.load(std::memory_order_acquire)) return std::nullopt;
    const std::lock_guard lock(state_mutex_);
    return std::exchange(preview_, std::nullopt);
}

std::optional<SceneLoader::Result> SceneLoader::take() {
    if (!busy_ || !ready_.load(std::memory_order_acquire)) return std::nullopt;
    thread_.join();
    busy_ = false;
    preview_.reset();
    return std::move(result_);
}

}  // namespace candela
