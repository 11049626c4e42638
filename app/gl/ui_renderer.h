// SPDX-License-Identifier: MIT
// Draws Dear ImGui's panels with our own function table: its packaged OpenGL backend cannot run on OSMesa.
#pragma once

#include "app/gl/gl_context.h"
#include "app/gl/gl_program.h"

struct ImDrawData;

namespace candela {

class UiRenderer {
  public:
    // Needs the context to be current, here and in every call, and ImGui's context. Throws GlError.
    explicit UiRenderer(const GlContext& context);
    ~UiRenderer();
    UiRenderer(const UiRenderer&) = delete;
    UiRenderer& operator=(const UiRenderer&) = delete;

    // Hands the font atlas to OpenGL; again after the fonts have changed.
    void upload_fonts();
    // Draws over what is there.
    void draw(const ImDrawData& data);

  private:
    const GlContext& context_;
    GlProgram program_;
    GLuint atlas_ = 0, vertex_array_ = 0, vertices_ = 0, indices_ = 0;
};

}  // namespace candela
