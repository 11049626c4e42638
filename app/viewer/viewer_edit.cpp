// SPDX-License-Identifier: MIT
// Edits of the scene, and their undoing.
#include <utility>

#include "app/viewer/viewer.h"

namespace candela {

namespace {

constexpr double step_pause_s = 0.7;

}  // namespace

Editable editable_of(const ViewerModel& model) {
    Editable out{.materials = model.materials,
                 .lights = model.punctual_lights,
                 .view = model.view,
                 .scene = true,
                 .tone = model.display.tone,
                 .settings = model.options.integrator,
                 .light_weights = model.lights.weights,
                 .environment = {model.options.hdri, model.options.sky, model.options.hdri_rotation_degrees,
                                 model.options.hdri_intensity, model.job.environment},
                 .variant = {},
                 .active_scene = 0,
                 .world = model.job.world};
    if (model.has_scene()) {
        out.variant = model.job.world->scene->active_variant;
        out.active_scene = model.job.world->scene->active_scene;
    }
    return out;
}

bool Viewer::environment_is_made() const {
    return !environment_dirty_ && !(loader_.busy() && load_is_ == LoadKind::environment);
}

// What there is now, but for the view.
Editable Viewer::editable_with(const OrbitView& view) const {
    Editable out = editable_of(model_);
    out.view = view;
    out.scene = false;
    if (!environment_is_made()) out.world = nullptr;
    return out;
}

// Steps of one kind that follow each other soon are one.
void Viewer::add_step(Editable before, StepKind kind) {
    if (!model_.has_scene()) return;
    const double now = now_s();
    const bool goes_on =
        kind != StepKind::single && kind == last_step_ && now - last_step_s_ < step_pause_s && history_.can_undo();
    last_step_ = kind;
    last_step_s_ = now;
    if (!goes_on) history_.add(std::move(before));
}

// What the panels edit are copies of the scene's own.
void Viewer::adopt_scene() {
    const Scene& scene = model_.job.rest != nullptr ? *model_.job.rest : *model_.job.world->scene;
    model_.materials = scene.materials;
    model_.punctual_lights = scene.lights;
    scene_dirty_ = false;
}

void Viewer::forget_edits() {
    history_.clear();
    adopt_scene();
}

void Viewer::undo_edit(bool redo) {
    if (!model_.has_scene() || (redo ? !history_.can_redo() : !history_.can_undo())) {
        notify(redo ? "nothing was undone" : "there is nothing to undo");
        return;
    }
    last_step_ = StepKind::single;
    Editable now = editable_with(model_.view);
    restore(redo ? history_.redo(std::move(now)) : history_.undo(std::move(now)));
}

void Viewer::restore(Editable there) {
    redraws_ = 2;
    const Scene& scene = *model_.job.world->scene;
    // Another scene of the file is loaded first.
    if (there.active_scene != scene.active_scene && there.active_scene < scene.scene_names.size()) {
        RenderOptions options = model_.options;
        options.scene = model_.job.scene_path;
        options.scene_index = there.active_scene;
        start_load(options, false, false, std::move(there));
        return;
    }
    model_.display.tone = there.tone;
    if (there.settings != model_.options.integrator) {
        model_.options.integrator = there.settings;
        edit();
    }
    if (there.light_weights != model_.lights.weights && there.light_weights.size() == model_.lights.weights.size()) {
        model_.lights.weights = there.light_weights;
        weigh_lights();
    }
    if (there.variant != scene.active_variant && there.variant.value_or(0) < scene.variant_names.size())
        wanted_variant_ = there.variant;
    restore_environment(there);
    if (there.scene) {
        model_.materials = std::move(there.materials);
        model_.punctual_lights = std::move(there.lights);
        scene_dirty_ = true;
    }
    set_view(there.view);
}

void Viewer::restore_environment(const Editable& there) {
    if (there.environment == editable_of(model_).environment) return;
    if (loader_.busy() && load_is_ == LoadKind::environment) {
        loader_.cancel();
        model_.loading = false;
    }
    dropped_environment_.clear();
    model_.options.hdri = there.environment.hdri;
    model_.options.sky = there.environment.sky;
    model_.options.hdri_rotation_degrees = there.environment.rotation_degrees;
    model_.options.hdri_intensity = there.environment.intensity;
    model_.job.environment = there.environment.read;
    // The world that showed it, if nothing but the environment has changed since.
    environment_dirty_ = loader_.busy() || there.world == nullptr || there.world->scene != model_.job.world->scene;
    if (environment_dirty_) return;
    model_.job.world = there.world;
    edit();
}

// The scene's geometry stays; what emits, and which rays meet what, is compiled anew beside the window.
void Viewer::start_scene_edit() {
    scene_dirty_ = false;
    load_is_ = LoadKind::edit;
    loader_.start(
        [options = model_.options, job = model_.job, materials = model_.materials, lights = model_.punctual_lights](
            const SceneLoader::Progress&, const SceneLoader::ShowPreview&, const std::atomic<bool>* cancel) {
            LoadedScene out{options, job};
            edit_scene(out.job, materials, lights, cancel);
            return out;
        });
}

void Viewer::take_edit(const RenderJob& edited) {
    model_.job.world = edited.world;
    model_.job.rest = edited.rest;
    edit();
}

}  // namespace candela
