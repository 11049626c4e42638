// SPDX-License-Identifier: MIT
#include "app/gl/ui_renderer.h"

#include <imgui.h>

#include <bit>

#include "shaders/shaders.h"

namespace candela {

namespace {

// ImGui carries texture names through a pointer.
ImTextureID texture_id(GLuint name) {
    return std::bit_cast<ImTextureID>(uintptr_t{name});
}
GLuint texture_name(ImTextureID id) {
    return static_cast<GLuint>(std::bit_cast<uintptr_t>(id));
}

const void* byte_offset(size_t bytes) {
    return std::bit_cast<const void*>(bytes);
}

}  // namespace

UiRenderer::UiRenderer(const GlContext& context)
    : context_(context), program_(context.gl(), {shaders::ui_vert}, {shaders::ui_frag}) {
    const GlFunctions& gl = context_.gl();
    gl.GenTextures(1, &atlas_);
    gl.GenVertexArrays(1, &vertex_array_);
    gl.GenBuffers(1, &vertices_);
    gl.GenBuffers(1, &indices_);

    // The layout of ImDrawVert: position, uv, colour.
    gl.BindVertexArray(vertex_array_);
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices_);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
    const GLsizei stride = sizeof(ImDrawVert);
    gl.EnableVertexAttribArray(0);
    gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, byte_offset(offsetof(ImDrawVert, pos)));
    gl.EnableVertexAttribArray(1);
    gl.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, byte_offset(offsetof(ImDrawVert, uv)));
    gl.EnableVertexAttribArray(2);
    gl.VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, byte_offset(offsetof(ImDrawVert, col)));
    gl.BindVertexArray(0);
    upload_fonts();
}

UiRenderer::~UiRenderer() {
    const GlFunctions& gl = context_.gl();
    gl.DeleteTextures(1, &atlas_);
    gl.DeleteVertexArrays(1, &vertex_array_);
    gl.DeleteBuffers(1, &vertices_);
    gl.DeleteBuffers(1, &indices_);
}

void UiRenderer::upload_fonts() {
    const GlFunctions& gl = context_.gl();
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    fonts.GetTexDataAsRGBA32(&pixels, &width, &height);
    gl.BindTexture(GL_TEXTURE_2D, atlas_);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    fonts.SetTexID(texture_id(atlas_));
}

void UiRenderer::draw(const ImDrawData& data) {
    const GlFunctions& gl = context_.gl();
    const ImVec2 scale = data.FramebufferScale;
    const float width = data.DisplaySize.x * scale.x, height = data.DisplaySize.y * scale.y;
    if (width <= 0 || height <= 0) return;

    // Blend over the picture, y down.
    gl.Enable(GL_BLEND);
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Viewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
    const float w = 2.0f / data.DisplaySize.x, h = -2.0f / data.DisplaySize.y;
    const float clip_from_point[16] = {
        w, 0, 0, 0, 0, h, 0, 0, 0, 0, 1, 0, -1 - data.DisplayPos.x * w, 1 - data.DisplayPos.y * h, 0, 1};
    program_.use();
    gl.UniformMatrix4fv(program_.uniform("clip_from_point"), 1, GL_FALSE, clip_from_point);
    gl.Uniform1i(program_.uniform("atlas"), 0);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindVertexArray(vertex_array_);

    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        gl.BindBuffer(GL_ARRAY_BUFFER, vertices_);
        gl.BufferData(GL_ARRAY_BUFFER, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data, GL_STREAM_DRAW);
        gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data, GL_STREAM_DRAW);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.UserCallback != nullptr) {
                if (command.UserCallback != ImDrawCallback_ResetRenderState) command.UserCallback(&list, &command);
                continue;
            }

            // The clip rectangle in pixels, whose y runs upwards.
            const float left = std::max((command.ClipRect.x - data.DisplayPos.x) * scale.x, 0.0f);
            const float top = std::max((command.ClipRect.y - data.DisplayPos.y) * scale.y, 0.0f);
            const float right = std::min((command.ClipRect.z - data.DisplayPos.x) * scale.x, width);
            const float bottom = std::min((command.ClipRect.w - data.DisplayPos.y) * scale.y, height);
            if (right <= left || bottom <= top) continue;
            gl.Scissor(static_cast<GLint>(left), static_cast<GLint>(height - bottom),
                       static_cast<GLsizei>(right - left), static_cast<GLsizei>(bottom - top));
            gl.BindTexture(GL_TEXTURE_2D, texture_name(command.GetTexID()));
            gl.DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount),
                                      sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                                      byte_offset(command.IdxOffset * sizeof(ImDrawIdx)),
                                      static_cast<GLint>(command.VtxOffset));
        }
    }
    gl.BindVertexArray(0);
    gl.Disable(GL_SCISSOR_TEST);
    gl.Disable(GL_BLEND);
}

}  // namespace candela
