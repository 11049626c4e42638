// SPDX-License-Identifier: MIT
// Flying, views as text, and what the viewer asks of its window.
#include <fmt/format.h>

#include <utility>

#include "app/viewer/view_text.h"
#include "app/viewer/viewer.h"

namespace candela {

ViewerRequests Viewer::take_requests() {
    return std::exchange(requests_, {});
}

void Viewer::give_keyboard(bool to_panels) {
    if (ui_ == nullptr || model_.panels_have_keyboard == to_panels) return;
    model_.panels_have_keyboard = model_.focuses_panels = to_panels;
    if (to_panels) model_.show_panels = true;
    ui_->give_keyboard(to_panels);
}

// Keys that move through the panels, while those have the keyboard.
bool Viewer::is_for_panels(const KeyPressed& event) {
    if (ui_ == nullptr) return false;
    if (ui_->wants_keyboard()) return true;
    if (!model_.panels_have_keyboard || event.modifiers.ctrl || event.modifiers.alt) return false;
    switch (event.key) {
        case Key::up:
        case Key::down:
        case Key::left:
        case Key::right:
        case Key::space:
        case Key::enter:
            return true;
        case Key::escape:
            // What is open is closed first.
            if (!ui_->is_editing()) give_keyboard(false);
            return true;
        default:
            return false;
    }
}

void Viewer::toggle_flight() {
    if (!model_.has_scene()) return;
    end_flight();
    flight_.toggle();
    model_.flying = flight_.on();
    if (flight_.on()) notify("flying: W A S D, Q and E, Shift faster, the wheel's speed; F or Escape ends it");
}

// Keys move the view from when they go down to when they come up, whatever the loop did in between.
bool Viewer::fly_by(const KeyPressed& event) {
    if (!flight_.on()) return false;
    tick();
    const bool moved = flight_.moves();
    if (!moved) view_before_flight_ = model_.view;
    const bool heard = flight_.handle(event);
    if (moved && !flight_.moves()) remember_flight();
    return heard;
}

void Viewer::remember_flight() {
    if (model_.view != view_before_flight_) add_step(editable_with(view_before_flight_));
}

void Viewer::end_flight() {
    if (flight_.moves()) remember_flight();
}

void Viewer::fly_for(double dt_s) {
    if (!flight_.moves() || !model_.has_scene()) return;
    const Bounds3& bounds = model_.job.world->bounds;
    const float size = glm::length(bounds.upper - bounds.lower);
    set_view(flight_.advance(model_.view, dt_s, size > 0 && std::isfinite(size) ? size : 1.0f));
}

void Viewer::copy_view() {
    if (!model_.has_scene()) return;
    requests_.copied = text_of({model_.view, model_.display.tone});
    notify("the view is in the clipboard, as options of the command line");
}

void Viewer::paste_view(const std::string& text) {
    if (!model_.has_scene()) return;
    std::string problem;
    const std::optional<Bookmark> pasted = view_from_text(text, {model_.view, model_.display.tone}, problem);
    if (!pasted) {
        notify(problem, true);
        return;
    }
    if (model_.notice_is_error) model_.notice.clear();
    add_step(editable_with(model_.view));
    model_.display.tone = pasted->tone;
    set_view(pasted->view);
    redraws_ = 2;
}

// Of the scene as it is shown, from the view as it is now.
void Viewer::write_sequence(const SequenceSettings& settings) {
    if (!model_.has_scene() || writer_.busy() || before_preview_) return;
    if (!viewer_options_.touches_files) {
        notify("the pictures would be written now");
        return;
    }
    FrameWriter::Order order{settings, model_.job, model_.options, model_.view.pivot, 0, 0, {}, {}};
    const bool animated = settings.kind == SequenceKind::animation;
    if (animated && !has_animation()) return;
    order.options.tone = model_.display.tone;
    if (model_.lights.on) order.light_weights = model_.lights.values();
    double duration_s = 0;
    if (animated) {
        order.animation = model_.playback.animation.value_or(0);
        duration_s = static_cast<double>(model_.job.rest->animations[order.animation]->duration_s);
        // Who looks through a camera of the file goes with it; any other view stays.
        order.options.eye = model_.view.camera.position();
        if (followed_camera_) {
            order.options.eye.reset();
            order.options.camera = std::to_string(*followed_camera_);
        }
    }
    order.count = picture_count(order.settings, duration_s);
    order.path = free_sequence_path(model_.job.scene_path, order.settings.kind);
    writer_.start(std::move(order));
}

void Viewer::update_sequence() {
    if (const std::optional<FrameWriter::Outcome> outcome = writer_.take()) notify(outcome->words, outcome->failed);
    std::optional<std::pair<uint32_t, uint32_t>> writing;
    if (writer_.busy()) writing = {writer_.written(), writer_.count()};
    if (writing == model_.writing) return;
    model_.writing = writing;
    redraws_ = std::max(redraws_, 2);
}

}  // namespace candela
