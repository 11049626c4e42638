// SPDX-License-Identifier: MIT
// Dear ImGui's context: fonts, theme, input and drawing. What the panels say is panels.h's.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/gl/ui_renderer.h"
#include "app/viewer/input.h"
#include "app/viewer/theme.h"

struct ImGuiContext;

namespace candela {

class Ui {
  public:
    // Needs the OpenGL context to be current, here and in draw. Throws GlError.
    Ui(const GlContext& context, const UiStyle& style);
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    // From the next frame on.
    void set_style(const UiStyle& style);
    void handle(const InputEvent& event);
    // The pointer is on a panel, or a text field has the keyboard: the event is not for the picture.
    bool wants_mouse() const;
    bool wants_keyboard() const;
    // A text field has it: what is pasted is for that.
    bool wants_text() const;
    // Panels have the keyboard, or give it back: arrows go from field to field, Space and Enter act on them.
    void give_keyboard(bool to_panels) { navigates_ = to_panels; }
    // Something of a panel is open or being changed: Escape is for that.
    bool is_editing() const;
    // What a text field put into the clipboard since the last call.
    std::optional<std::string> take_copied() { return std::exchange(copied_, std::nullopt); }
    // Between the two come the panels.
    void begin_frame(double now_s);
    void end_frame_and_draw();

  private:
    void build_fonts();

    ImGuiContext* imgui_;
    std::unique_ptr<UiRenderer> renderer_;
    WindowResized size_;
    UiStyle style_;
    float built_scale_ = 0, built_pixels_per_point_ = 1;  // of the fonts
    double last_frame_s_ = 0;
    bool mouse_down_[3] = {}, mouse_pressed_since_frame_[3] = {};
    std::array<bool, 512> key_down_{}, key_pressed_since_frame_{};
    bool navigates_ = false;
    std::string pasted_;
    std::optional<std::string> copied_;
};

}  // namespace candela
