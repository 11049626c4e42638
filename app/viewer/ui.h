// SPDX-License-Identifier: MIT
// Dear ImGui's context: fonts, theme, input and drawing. What the panels say is panels.h's.
#pragma once

#include <memory>

#include "app/gl/ui_renderer.h"
#include "app/viewer/input.h"

struct ImGuiContext;

namespace candela {

class Ui {
  public:
    // Needs the OpenGL context to be current, here and in draw. Throws GlError.
    explicit Ui(const GlContext& context);
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    void handle(const InputEvent& event);
    // The pointer is on a panel, or a text field has the keyboard: the event is not for the picture.
    bool wants_mouse() const;
    bool wants_keyboard() const;
    // Between the two come the panels.
    void begin_frame(double now_s);
    void end_frame_and_draw();

  private:
    void build_fonts();

    ImGuiContext* imgui_;
    std::unique_ptr<UiRenderer> renderer_;
    WindowResized size_;
    float built_scale_ = 0;
    double last_frame_s_ = 0;
    bool mouse_down_[3] = {}, mouse_pressed_since_frame_[3] = {};
};

}  // namespace candela
