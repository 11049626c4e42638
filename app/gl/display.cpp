// SPDX-License-Identifier: MIT
#include "app/gl/display.h"

#include <fmt/format.h>

#include "shaders/shaders.h"

namespace candela {

FitRectangle fit_rectangle(Vec2u picture, Vec2u framebuffer) {
    FitRectangle out;
    if (picture.x == 0 || picture.y == 0) return out;
    const double scale =
        std::min(static_cast<double>(framebuffer.x) / picture.x, static_cast<double>(framebuffer.y) / picture.y);
    out.width = std::max(1, static_cast<int>(std::lround(picture.x * scale)));
    out.height = std::max(1, static_cast<int>(std::lround(picture.y * scale)));
    out.x = (static_cast<int>(framebuffer.x) - out.width) / 2;
    out.y = (static_cast<int>(framebuffer.y) - out.height) / 2;
    return out;
}

Display::Display(const GlContext& context)
    : context_(context), program_(context.gl(), {shaders::display_vert}, {shaders::tone_glsl, shaders::display_frag}) {
    const GlFunctions& gl = context_.gl();
    gl.GenVertexArrays(1, &vertex_array_);
    gl.GenTextures(1, &texture_);
    gl.BindTexture(GL_TEXTURE_2D, texture_);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
}

Display::~Display() {
    context_.gl().DeleteTextures(1, &texture_);
    context_.gl().DeleteVertexArrays(1, &vertex_array_);
}

bool Display::upload(const Frame& frame) {
    const Vec2u extent(frame.image.width(), frame.image.height());
    if (extent == extent_ && frame.serial == serial_) return false;
    const GlFunctions& gl = context_.gl();
    gl.BindTexture(GL_TEXTURE_2D, texture_);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    if (extent == extent_) {
        gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, frame.image.width(), frame.image.height(), GL_RGBA, GL_FLOAT,
                         frame.image.data());
    } else {
        GLint largest = 0;
        gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
        if (frame.image.width() > largest || frame.image.height() > largest) {
            throw GlError(fmt::format(
                "the OpenGL driver shows at most {0}x{0} pixels; ask for a smaller --resolution, or use candela render",
                largest));
        }
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, frame.image.width(), frame.image.height(), 0, GL_RGBA, GL_FLOAT,
                      frame.image.data());
    }
    extent_ = extent;
    serial_ = frame.serial;
    return true;
}

void Display::draw(const DisplaySettings& settings) {
    const GlFunctions& gl = context_.gl();
    const Vec2u framebuffer = context_.framebuffer_extent();
    gl.Disable(GL_BLEND);
    gl.Disable(GL_SCISSOR_TEST);
    gl.Viewport(0, 0, static_cast<GLsizei>(framebuffer.x), static_cast<GLsizei>(framebuffer.y));
    gl.ClearColor(0.11f, 0.11f, 0.12f, 1.0f);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    if (extent_.x == 0) return;

    // A frame of the framebuffer's size is copied pixel by pixel; one of before a resize is stretched until the next.
    const FitRectangle fit = fit_rectangle(extent_, framebuffer);
    const bool exact = fit.width == static_cast<int>(extent_.x) && fit.height == static_cast<int>(extent_.y);
    gl.Viewport(fit.x, fit.y, fit.width, fit.height);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, texture_);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, exact ? GL_NEAREST : GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, exact ? GL_NEAREST : GL_LINEAR);
    program_.use();
    gl.Uniform1i(program_.uniform("frame"), 0);
    gl.Uniform1i(program_.uniform("curve"), static_cast<int>(settings.tone.curve));
    gl.Uniform1f(program_.uniform("radiance_scale"), std::exp2(settings.tone.exposure_ev));
    gl.Uniform1i(program_.uniform("show_checkerboard"), settings.checkerboard ? 1 : 0);
    gl.BindVertexArray(vertex_array_);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.BindVertexArray(0);
}

}  // namespace candela
