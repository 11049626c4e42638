// SPDX-License-Identifier: MIT
// Playing the file's animations: which pose is wanted, when the next one is made, and what follows it.
#include <algorithm>

#include "app/pose_choice.h"
#include "app/viewer/viewer.h"
#include "renderer/scene/animation.h"

namespace candela {

namespace {

// A hand that was off for longer than this, as while a scene loads, does not make the animation jump.
constexpr double longest_tick_s = 0.25;

}  // namespace

const Animation* Viewer::animation() const {
    if (!model_.has_scene() || !model_.playback.animation) return nullptr;
    return model_.job.rest->animations[*model_.playback.animation].get();
}

// What the timeline asks for: while it plays one pose for each frame of the animation.
double Viewer::wanted_pose_s() const {
    const Animation& now = *animation();
    const double time_s = model_.playback.time_s;
    return model_.playback.playing ? frame_at(time_s, frame_step_s(now), static_cast<double>(now.duration_s)) : time_s;
}

bool Viewer::pose_is_wanted() const {
    if (animation() == nullptr) return false;
    return shown_pose_.animation != model_.playback.animation || shown_pose_.time_s != wanted_pose_s();
}

// At least its first picture, unless there comes none.
bool Viewer::pose_was_seen() const {
    if (model_.status.paused || !model_.status.error.empty()) return true;
    return pose_epoch_ != 0 && model_.frame_epoch >= pose_epoch_;
}

void Viewer::tick() {
    const double now = now_s();
    const double dt_s = std::clamp(now - last_tick_s_, 0.0, longest_tick_s);
    last_tick_s_ = now;
    fly_for(dt_s);
    if (!model_.playback.playing || animation() == nullptr) return;
    model_.playback.time_s = advance(model_.playback.time_s, dt_s, static_cast<double>(animation()->duration_s));
}

// The pose that is wanted now is made off the main thread; those that were wanted meanwhile are left out.
void Viewer::start_pose() {
    making_pose_ = {model_.playback.animation, wanted_pose_s(), false};
    load_is_ = LoadKind::pose;
    loader_.start([options = model_.options, job = model_.job, pose = making_pose_](
                      const SceneLoader::Progress&, const SceneLoader::ShowPreview&, const std::atomic<bool>* cancel) {
        LoadedScene out{options, job};
        show_pose(out.job, options, *pose.animation, pose.time_s, cancel);
        return out;
    });
}

void Viewer::take_pose(const RenderJob& posed) {
    model_.job.world = posed.world;
    shown_pose_ = making_pose_;
    pose_epoch_ = 0;
    dirty_ = true;
    follow_file_camera();
}

// Someone who looks through a camera of the file is carried along, with the lens as it was set.
void Viewer::follow_file_camera() {
    const std::vector<CameraInstance>& cameras = model_.job.world->scene->cameras;
    if (!followed_camera_ || *followed_camera_ >= cameras.size()) return;
    const Mat4 world_from_camera = cameras[*followed_camera_].camera.world_from_camera;
    OrbitView view = model_.view;
    if (view.camera.world_from_camera == world_from_camera) return;
    view.pivot = Vec3(world_from_camera * glm::inverse(view.camera.world_from_camera) * Vec4(view.pivot, 1.0f));
    view.camera.world_from_camera = world_from_camera;
    const std::optional<uint32_t> followed = followed_camera_;
    const std::optional<double> edited_s = edited_s_;
    set_view(view);
    edited_s_ = edited_s;
    followed_camera_ = followed;
}

void Viewer::start_playback() {
    model_.playback = {};
    shown_pose_ = {};
    pose_epoch_ = 0;
    if (const std::optional<uint32_t> chosen = choose_animation(model_.options, *model_.job.rest)) {
        const auto duration_s = static_cast<double>(model_.job.rest->animations[*chosen]->duration_s);
        model_.playback.animation = chosen;
        model_.playback.time_s = std::clamp(model_.options.at_seconds.value_or(0.0), 0.0, duration_s);
        shown_pose_ = model_.playback;
    }
}

bool Viewer::has_animation() {
    if (model_.has_scene() && !model_.job.rest->animations.empty()) return true;
    if (model_.has_scene()) notify("the file has no animations");
    return false;
}

void Viewer::toggle_play() {
    if (!has_animation()) return;
    if (!model_.playback.animation) model_.playback.animation = 0;
    model_.playback.playing = !model_.playback.playing;
    last_tick_s_ = now_s();
    if (model_.playback.playing) {
        session_->resume();
    } else {
        const Animation& now = *animation();
        seek(frame_at(model_.playback.time_s, frame_step_s(now), static_cast<double>(now.duration_s)));
    }
}

void Viewer::step_animation(int frames) {
    if (!has_animation()) return;
    model_.playback.playing = false;
    if (!model_.playback.animation) model_.playback.animation = 0;
    seek(step_frames(model_.playback.time_s, frames, frame_step_s(*animation()),
                     static_cast<double>(animation()->duration_s)));
}

void Viewer::choose_animation_shown(uint32_t index) {
    model_.playback.animation = index;
    seek(0);
}

// So that a reload comes back to it.
void Viewer::seek(double time_s) {
    model_.playback.time_s = time_s;
    model_.options.animation = std::to_string(*model_.playback.animation);
    model_.options.at_seconds = time_s;
    redraws_ = 2;
}

}  // namespace candela
