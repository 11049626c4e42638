// SPDX-License-Identifier: MIT
// Edits of the scene, and their undoing.
#include <utility>

#include "app/viewer/viewer.h"

namespace candela {

Editable Viewer::editable() const {
    return {model_.materials, model_.punctual_lights, model_.view};
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
    if (redo ? !history_.can_redo() : !history_.can_undo()) {
        notify(redo ? "nothing was undone" : "there is nothing to undo");
        return;
    }
    Editable there = redo ? history_.redo(editable()) : history_.undo(editable());
    if (there.scene) {
        model_.materials = std::move(there.materials);
        model_.punctual_lights = std::move(there.lights);
        scene_dirty_ = true;
    }
    set_view(there.view);
    redraws_ = 2;
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
