// SPDX-License-Identifier: MIT
// Where OpenGL draws: a window's or an off-screen picture. All of candela's drawing goes to one of these.
#pragma once

#include "app/gl/gl_functions.h"
#include "renderer/image/image.h"

namespace candela {

class GlContext {
  public:
    virtual ~GlContext() = default;
    GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    virtual const GlFunctions& gl() const = 0;
    // In pixels, which on a HiDPI screen are smaller than the points that the mouse is measured in.
    virtual Vec2u framebuffer_extent() const = 0;
};

// What has been drawn so far, rows from the top.
ImageRgba8 read_back(const GlContext& context);

}  // namespace candela
