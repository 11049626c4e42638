// SPDX-License-Identifier: MIT
#include "app/gl/gl_context.h"

namespace candela {

ImageRgba8 read_back(const GlContext& context) {
    const GlFunctions& gl = context.gl();
    const int width = static_cast<int>(context.framebuffer_extent().x);
    const int height = static_cast<int>(context.framebuffer_extent().y);
    ImageRgba8 out(width, height);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, out.data());

    // OpenGL's rows come from the bottom.
    for (int y = 0; y < height / 2; ++y)
        std::swap_ranges(&out(0, y), &out(0, y) + width, &out(0, height - 1 - y));
    return out;
}

}  // namespace candela
