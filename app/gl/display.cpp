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
    : context_(context),
      program_(context.gl(), {shaders::display_vert}, {shaders::tone_glsl, shaders::heat_glsl, shaders::display_frag}) {
    const GlFunctions& gl = context_.gl();
    gl.GenVertexArrays(1, &vertex_array_);
    for (GLuint* texture : {&texture_, &maps_texture_, &other_texture_, &differences_texture_}) {
        gl.GenTextures(1, texture);
        gl.BindTexture(GL_TEXTURE_2D, *texture);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    }
}

Display::~Display() {
    for (const GLuint texture : {texture_, maps_texture_, other_texture_, differences_texture_})
        context_.gl().DeleteTextures(1, &texture);
    context_.gl().DeleteVertexArrays(1, &vertex_array_);
}

Vec2u Display::upload_image(const ImageRgba32f& image, GLuint texture, Vec2u extent) const {
    const GlFunctions& gl = context_.gl();
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    if (extent == Vec2u(image.width(), image.height())) {
        gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width(), image.height(), GL_RGBA, GL_FLOAT, image.data());
        return extent;
    }
    GLint largest = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (image.width() > largest || image.height() > largest) {
        throw GlError(fmt::format(
            "the OpenGL driver shows at most {0}x{0} pixels; ask for a smaller --resolution, or use candela render",
            largest));
    }
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, image.width(), image.height(), 0, GL_RGBA, GL_FLOAT, image.data());
    return {image.width(), image.height()};
}

bool Display::upload(const Frame& frame, const StandIn& stand_in) {
    const ImageRgba32f& image = stand_in.image != nullptr ? *stand_in.image : frame.shown();
    const uint64_t stand_in_serial = stand_in.image != nullptr ? stand_in.serial : 0;
    if (Vec2u(image.width(), image.height()) == extent_ && frame.serial == serial_ &&
        stand_in_serial == stand_in_serial_) {
        return false;
    }
    extent_ = upload_image(image, texture_, extent_);
    stand_in_serial_ = stand_in_serial;
    has_maps_ = !frame.maps.empty();
    if (has_maps_) maps_extent_ = upload_image(frame.maps, maps_texture_, maps_extent_);
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
    const auto bind = [&](GLenum unit, GLuint texture, GLint filter) {
        gl.ActiveTexture(unit);
        gl.BindTexture(GL_TEXTURE_2D, texture);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    };
    const DisplayedMap map = settings.map.value_or(DisplayedMap{});
    const bool map_shown = settings.map.has_value() && (map.metric ? differences_extent_.x > 0 : has_maps_);
    const bool other_shown = settings.other.has_value() && other_extent_.x > 0;
    if (map_shown) bind(GL_TEXTURE1, map.metric ? differences_texture_ : maps_texture_, GL_NEAREST);
    if (other_shown) bind(GL_TEXTURE2, other_texture_, exact && other_extent_ == extent_ ? GL_NEAREST : GL_LINEAR);
    bind(GL_TEXTURE0, texture_, exact ? GL_NEAREST : GL_LINEAR);
    program_.use();
    const int channel = map.metric ? static_cast<int>(*map.metric) : static_cast<int>(map.map);
    gl.Uniform1i(program_.uniform("other"), 2);
    gl.Uniform1i(program_.uniform("other_shown"), other_shown ? 1 : 0);
    gl.Uniform1i(program_.uniform("map_of_differences"), map.metric == ReferenceMetric::signed_difference ? 1 : 0);
    gl.Uniform1i(program_.uniform("maps"), 1);
    gl.Uniform1i(program_.uniform("map_channel"), map_shown ? channel : -1);
    gl.Uniform1f(program_.uniform("map_low"), map.scale.low);
    gl.Uniform1f(program_.uniform("map_high"), map.scale.high);
    gl.Uniform1i(program_.uniform("map_logarithmic"), map.scale.logarithmic ? 1 : 0);
    gl.Uniform1f(program_.uniform("wipe"), other_shown ? *settings.other : map.wipe);
    gl.Uniform1i(program_.uniform("frame"), 0);
    gl.Uniform1i(program_.uniform("curve"), static_cast<int>(settings.tone.curve));
    gl.Uniform1f(program_.uniform("radiance_scale"), std::exp2(settings.tone.exposure_ev));
    gl.Uniform1i(program_.uniform("show_checkerboard"), settings.checkerboard ? 1 : 0);
    gl.BindVertexArray(vertex_array_);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.BindVertexArray(0);
}

}  // namespace candela
