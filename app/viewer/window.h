// SPDX-License-Identifier: MIT
// The GLFW window: an OpenGL context and a source of input events. The only includer of GLFW.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/gl/gl_context.h"
#include "app/viewer/input.h"

namespace candela {

class Window : public GlContext {
  public:
    // Opens and makes current, on the main thread only, one at a time. extent in the units of the screen; scaled: as
    // many more as its scale says. Throws GlError where there is no display or no OpenGL 3.3.
    Window(Vec2u extent, const std::string& title, bool scaled);
    ~Window() override;

    const GlFunctions& gl() const override { return gl_; }
    Vec2u framebuffer_extent() const override;

    // Waits at most that long for input, and returns what has come since the last call.
    std::vector<InputEvent> wait_for_events(double timeout_s);
    void swap_buffers();
    void set_title(const std::string& title);
    void set_clipboard(const std::string& text);
    // In the units of the screen, without its frame.
    Vec2u extent() const;

  private:
    struct Handle;
    std::unique_ptr<Handle> handle_;
    GlFunctions gl_;
};

}  // namespace candela
