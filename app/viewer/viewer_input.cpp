// SPDX-License-Identifier: MIT
// What each input does to the view and the picture.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/viewer/viewer.h"
#include "renderer/integrator/aov.h"

namespace candela {

namespace {

constexpr double double_click_s = 0.4;
constexpr double never = -1;
constexpr float double_click_points = 6;
constexpr double scroll_pause_s = 0.7;
constexpr float dolly_per_step = 0.88f;
constexpr float exposure_step_ev = 0.25f;
constexpr float click_points = 2;  // a button that comes up as near was clicked
constexpr float wipe_step = 0.05f;

bool is_digit(Key key) {
    return key >= Key::digit_0 && key <= Key::digit_9;
}

size_t digit_of(Key key) {
    return static_cast<size_t>(key) - static_cast<size_t>(Key::digit_0);
}

}  // namespace

void Viewer::handle(const InputEvent& event) {
    if (ui_ != nullptr) ui_->handle(event);
    const bool panel_had_mouse = ui_ != nullptr && ui_->wants_mouse();
    if (const auto* moved = std::get_if<MouseMoved>(&event)) {
        handle_mouse_move(moved->point);
        // A pointer over the picture changes nothing to draw.
        if (panel_had_mouse || model_.show_panels) redraws_ = std::max(redraws_, 1);
        return;
    }
    redraws_ = 2;
    if (const auto* press = std::get_if<MousePressed>(&event)) {
        if (!press->pressed || !panel_had_mouse) handle_mouse_press(*press);
    } else if (const auto* scroll = std::get_if<Scrolled>(&event)) {
        if (!panel_had_mouse) handle_scroll(scroll->steps.y);
    } else if (const auto* key = std::get_if<KeyPressed>(&event)) {
        const bool panel_has_keyboard = key->pressed && is_for_panels(*key);
        // What ends a movement is always heard.
        const bool flies = (!key->pressed || !panel_has_keyboard) && fly_by(*key);
        if (key->key == Key::shift && (!key->pressed || !flies)) hold_reference(key->pressed);
        if (key->pressed && !flies && !panel_has_keyboard) handle_key(*key);
    } else if (const auto* paste = std::get_if<TextPasted>(&event)) {
        if (ui_ == nullptr || !ui_->wants_text()) paste_view(paste->text);
    } else if (std::get_if<SceneFileChanged>(&event) != nullptr) {
        reload();
    } else if (const auto* drop = std::get_if<FilesDropped>(&event)) {
        handle_drop(*drop);
    } else if (const auto* size = std::get_if<WindowResized>(&event)) {
        handle_resize(*size);
    } else if (std::get_if<CloseRequested>(&event) != nullptr) {
        close_ = true;
    }
}

Vec2 Viewer::film_uv_of(const Vec2& point) const {
    return point / glm::max(size_.points, Vec2(1));
}

std::optional<Vec3> Viewer::pick(const Vec2& film_uv) const {
    if (!model_.has_scene()) return std::nullopt;
    const FirstHit hit =
        trace_first_hit(*model_.job.world, {model_.view.camera, glm::max(size_.pixels, Vec2u(1))}, film_uv);
    if (!hit.hit) return std::nullopt;
    return hit.position;
}

void Viewer::set_view(const OrbitView& view) {
    const Mat4& pose = view.camera.world_from_camera;
    for (int column = 0; column < 4; ++column) {
        if (!is_finite(Vec3(pose[column]))) return;
    }
    if (view == model_.view) return;
    model_.view = view;
    followed_camera_.reset();
    edit();
}

void Viewer::handle_mouse_press(const MousePressed& event) {
    if (!event.pressed) {
        // A button that went down over a panel is none of the picture's.
        if (event.button != drag_button_ || !std::exchange(is_pressed_, false)) return;
        const bool stayed = glm::distance(press_, cursor_) < click_points;
        const bool clicked = (drag_ == DragMode::orbit || drag_ == DragMode::look) && stayed;
        // Strokes that follow each other from the same place are no double-click.
        if (!stayed) last_click_s_ = never;
        drag_ = DragMode::none;
        if (model_.view != view_before_drag_) add_step(editable_with(view_before_drag_));
        if (before_turn_ && before_turn_->environment.rotation_degrees != model_.options.hdri_rotation_degrees)
            add_step(std::move(*before_turn_));
        before_turn_.reset();
        if (clicked) inspect_at(cursor_);
        return;
    }
    give_keyboard(false);
    if (!model_.has_scene() || drag_ != DragMode::none) return;
    drag_button_ = event.button;
    is_pressed_ = true;
    press_ = cursor_;
    view_before_drag_ = model_.view;
    const Modifiers& modifiers = event.modifiers;
    if (event.button == MouseButton::left && wipe_is_at_cursor()) {
        drag_ = DragMode::wipe;
    } else if (event.button == MouseButton::middle) {
        drag_ = DragMode::pan;
    } else if (event.button == MouseButton::right) {
        drag_ = modifiers.shift ? DragMode::environment : DragMode::dolly;
        if (drag_ == DragMode::environment && model_.job.environment == nullptr) {
            notify("there is no environment to turn; drop an .hdr or .exr file");
        }
        if (drag_ == DragMode::environment) before_turn_ = editable_with(model_.view);
        const Vec2 uv = film_uv_of(cursor_);
        drag_anchor_ = pick(uv).value_or(point_at_pivot_distance(model_.view, aspect(), uv));
    } else if (modifiers.ctrl && modifiers.shift) {
        set_focus_at_cursor();
    } else {
        // A second click soon after, at the same place, re-centres.
        const double now = now_s();
        const bool twice =
            now - last_click_s_ < double_click_s && glm::distance(cursor_, last_click_) < double_click_points;
        last_click_s_ = twice ? never : now;
        last_click_ = cursor_;
        if (twice) {
            if (const std::optional<Vec3> point = pick(film_uv_of(cursor_))) set_view(recentre(model_.view, *point));
            return;
        }
        drag_ = flight_.on() ? DragMode::look : modifiers.shift ? DragMode::pan : DragMode::orbit;
    }
}

void Viewer::handle_mouse_move(const Vec2& point) {
    const Vec2 drag = (point - cursor_) / std::max(size_.points.y, 1.0f);
    cursor_ = point;
    switch (drag_) {
        case DragMode::none:
            break;
        case DragMode::orbit:
            set_view(orbit(model_.view, drag));
            break;
        case DragMode::look:
            set_view(look_around(model_.view, drag));
            break;
        case DragMode::pan:
            set_view(pan(model_.view, drag));
            break;
        case DragMode::dolly:
            set_view(dolly(model_.view, drag_anchor_, std::exp2(3 * drag.y), aspect()));
            break;
        case DragMode::wipe:
            model_.map.wipe =
                std::clamp((point.x - model_.picture_left) / std::max(model_.picture_width, 1.0f), 0.0f, 1.0f);
            update_map();
            break;
        case DragMode::environment:
            if (model_.job.environment == nullptr) break;
            model_.options.hdri_rotation_degrees =
                std::remainder(model_.options.hdri_rotation_degrees + 180 * drag.x, 360.0f);
            environment_dirty_ = true;
            break;
    }
}

void Viewer::handle_scroll(float steps) {
    if (!model_.has_scene() || steps == 0) return;
    if (flight_.on()) {
        flight_.change_speed(steps);
        const Bounds3& bounds = model_.job.world->bounds;
        notify(fmt::format("{:.3g} m a second", flight_.speed(glm::length(bounds.upper - bounds.lower))));
        return;
    }
    const Vec2 uv = film_uv_of(cursor_);
    const Vec3 anchor = pick(uv).value_or(point_at_pivot_distance(model_.view, aspect(), uv));
    // Steps that follow each other are undone as one.
    const OrbitView before = model_.view;
    set_view(dolly(model_.view, anchor, std::pow(dolly_per_step, steps), aspect()));
    const double now = now_s();
    const bool goes_on = before == scrolled_view_ && now - last_scroll_s_ < scroll_pause_s;
    if (!goes_on && model_.view != before) add_step(editable_with(before));
    last_scroll_s_ = now;
    scrolled_view_ = model_.view;
}

void Viewer::handle_key(const KeyPressed& event) {
    const Modifiers& modifiers = event.modifiers;
    if (modifiers.ctrl) {
        if (event.key == Key::q) close_ = true;
        if (event.key == Key::s) save_next(modifiers.shift);
        if (event.key == Key::z) undo_edit(modifiers.shift);
        if (event.key == Key::c) copy_view();
        if (event.key == Key::o) ask_for_file(modifiers.shift ? DialogPurpose::reference : DialogPurpose::scene);
        if (is_digit(event.key)) store_bookmark(digit_of(event.key));
        return;
    }
    if (modifiers.alt) {
        if (event.key == Key::left || event.key == Key::right) step_view(event.key == Key::left ? -1 : 1);
        return;
    }
    if (modifiers.shift && is_digit(event.key)) {
        recall_bookmark(digit_of(event.key));
        return;
    }
    switch (event.key) {
        case Key::home:
        case Key::enter:
            frame_everything();
            return;
        case Key::f5:
            reload();
            return;
        case Key::f:
            toggle_flight();
            return;
        case Key::down:
            give_keyboard(true);
            return;
        case Key::i:
            inspect_at({size_.points.x / 2, size_.points.y / 2});
            return;
        case Key::f12:
            save_next(modifiers.shift);
            return;
        case Key::d:
            toggle_denoise();
            return;
        case Key::b:
            toggle_comparison();
            return;
        case Key::m:
            step_metric();
            return;
        case Key::tab:
            model_.show_panels = !model_.show_panels;
            give_keyboard(false);
            return;
        case Key::escape:
            model_.show_help = false;
            if (flight_.on()) toggle_flight();
            if (model_.inspection) end_inspection();
            if (model_.notice_is_error) model_.notice.clear();
            return;
        case Key::left:
            open_neighbour(-1);
            return;
        case Key::right:
            open_neighbour(1);
            return;
        case Key::e:
            change_exposure(modifiers.shift ? -exposure_step_ev : exposure_step_ev);
            return;
        case Key::h:
            model_.show_help = !model_.show_help;
            return;
        case Key::z:
            model_.show_statistics = !model_.show_statistics;
            return;
        case Key::t:
            add_step(editable_with(model_.view));
            model_.display.tone.curve = static_cast<ToneCurve>((static_cast<int>(model_.display.tone.curve) + 1) % 4);
            notify(fmt::format("tone curve {}", name_of(model_.display.tone.curve)));
            return;
        case Key::space:
            toggle_play();
            return;
        case Key::left_bracket:
        case Key::right_bracket:
            step_animation(event.key == Key::left_bracket ? -1 : 1);
            return;
        case Key::p:
            toggle_pause();
            return;
        case Key::v: {
            MapView view = model_.map;
            view.shown = modifiers.shift || !view.shown || view.metric;
            const bool was_shown = model_.map.shown && !view.metric;
            view.metric.reset();
            if (modifiers.shift && was_shown) view.map = static_cast<PixelMap>((static_cast<int>(view.map) + 1) % 4);
            show_map(view);
            return;
        }
        case Key::comma:
        case Key::period: {
            MapView view = model_.map;
            view.wipe = std::clamp(view.wipe + (event.key == Key::comma ? -wipe_step : wipe_step), 0.0f, 1.0f);
            show_map(view);
            return;
        }
        case Key::j:
            toggle_background();
            return;
        default:
            if (!modifiers.shift) handle_view_key(event.key);
    }
}

void Viewer::handle_view_key(Key key) {
    if (!model_.has_scene()) return;
    const OrbitView before = model_.view;
    switch (key) {
        case Key::digit_1:
            set_view(look_from(model_.view, AxisView::front));
            break;
        case Key::digit_3:
            set_view(look_from(model_.view, AxisView::right));
            break;
        case Key::digit_7:
            set_view(look_from(model_.view, AxisView::top));
            break;
        case Key::digit_9:
            set_view(look_from(model_.view, AxisView::isometric));
            break;
        case Key::digit_5:
            set_view(toggle_orthographic(model_.view));
            break;
        case Key::c: {
            const size_t count = model_.job.world->scene->cameras.size();
            if (count == 0) {
                notify("the file has no cameras");
            } else {
                show_file_camera(next_camera_ % static_cast<uint32_t>(count));
            }
            break;
        }
        default:
            break;
    }
    if (model_.view != before) add_step(editable_with(before));
}

void Viewer::show_file_camera(uint32_t index) {
    const CameraInstance& instance = model_.job.world->scene->cameras[index];
    OrbitView view = view_of(instance.camera, model_.job.world->bounds);
    set_view(view);
    if (const std::optional<Vec3> middle = pick(Vec2(0.5f))) {
        view.pivot = *middle;
        set_view(view);
    }
    next_camera_ = index + 1;
    followed_camera_ = index;
    notify(instance.name.empty() ? fmt::format("camera {}", index) : "camera " + instance.name);
}

void Viewer::frame_everything() {
    if (!model_.has_scene()) return;
    const OrbitView before = model_.view;
    set_view(frame_all(model_.view, model_.job.world->bounds, aspect()));
    if (model_.view != before) add_step(editable_with(before));
}

void Viewer::change_exposure(float ev) {
    float& exposure = model_.display.tone.exposure_ev;
    const float changed = std::clamp(exposure + ev, -20.0f, 20.0f);
    if (changed == exposure) return;
    add_step(editable_with(model_.view), StepKind::exposure);
    exposure = changed;
}

void Viewer::toggle_pause() {
    for (RenderSession* session : {session_.get(), other_session_.get()}) {
        if (session == nullptr) continue;
        if (model_.status.paused) {
            session->resume();
        } else {
            session->pause();
        }
    }
}

// The environment as background, or plain grey behind what it lights.
void Viewer::toggle_background() {
    add_step(editable_with(model_.view));
    IntegratorSettings& settings = model_.options.integrator;
    if (settings.background == BackgroundKind::environment) {
        settings.background = BackgroundKind::color;
        settings.background_color = Vec3(0.05f);
    } else {
        settings.background = BackgroundKind::environment;
    }
    edit();
}

void Viewer::set_focus_at_cursor() {
    const std::optional<Vec3> point = pick(film_uv_of(cursor_));
    if (!point) return;
    OrbitView view = model_.view;
    const float distance = glm::dot(*point - view.camera.position(), view.camera.forward());
    if (!(distance > 0)) return;
    view.camera.focus_distance_m = distance;
    set_view(view);
    notify(fmt::format("focus at {:.3g} m{}", distance,
                       view.camera.aperture_diameter_m > 0 ? "" : ": shows with an aperture (Tab)"));
}

void Viewer::handle_resize(const WindowResized& event) {
    const bool changed = event.pixels != size_.pixels;
    size_ = event;
    if (changed) edit();
}

}  // namespace candela
