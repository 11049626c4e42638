// SPDX-License-Identifier: MIT
// An OpenGL context without a display: Mesa draws into our memory.
#pragma once

#include <memory>

#include "app/gl/gl_context.h"

namespace candela {

class OsmesaContext : public GlContext {
  public:
    // Current on this thread from here on until destroyed. Throws GlError where Mesa offers no 3.3 core context or the
    // extent is beyond what it can draw.
    explicit OsmesaContext(Vec2u extent);
    ~OsmesaContext() override;

    // The content is undefined afterwards. Throws GlError.
    void resize(Vec2u extent);

    const GlFunctions& gl() const override { return gl_; }
    Vec2u framebuffer_extent() const override { return extent_; }

  private:
    struct Handle;
    std::unique_ptr<Handle> handle_;
    ImageRgba8 buffer_;
    Vec2u extent_{0};
    GlFunctions gl_;
};

}  // namespace candela
