// SPDX-License-Identifier: MIT
// Draws a frame: linear radiance as a float texture, exposure and tone curve in the shader. The same for the window and
// for off-screen pictures.
#pragma once

#include "app/gl/gl_context.h"
#include "app/gl/gl_program.h"
#include "renderer/film/frame.h"
#include "renderer/image/tone.h"

namespace candela {

struct DisplaySettings {
    ToneSettings tone;
    bool checkerboard = true;  // under pixels that are not opaque; else their alpha goes to the framebuffer
};

// A picture of that extent as large as it fits in the middle of the framebuffer; pixels, from the bottom left.
struct FitRectangle {
    int x = 0, y = 0, width = 0, height = 0;
};
FitRectangle fit_rectangle(Vec2u picture, Vec2u framebuffer);

class Display {
  public:
    // Needs the context to be current, here and in every call. Throws GlError.
    explicit Display(const GlContext& context);
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    // Uploads the frame unless its serial is that of the one uploaded last; returns whether it did. Throws GlError
    // where it exceeds the driver's texture size.
    bool upload(const Frame& frame);
    // Forgets the frame uploaded last.
    void clear() { extent_ = Vec2u(0); }
    // Clears the framebuffer and draws the frame uploaded last, if any, into its fit_rectangle.
    void draw(const DisplaySettings& settings);

  private:
    const GlContext& context_;
    GlProgram program_;
    GLuint texture_ = 0, vertex_array_ = 0;
    Vec2u extent_{0};
    uint64_t serial_ = 0;
};

}  // namespace candela
