// SPDX-License-Identifier: MIT
#include "app/gl/gl_program.h"

#include <string>
#include <vector>

namespace candela {

namespace {

GLuint compile(const GlFunctions& gl, GLenum stage, std::initializer_list<const char*> sources) {
    std::vector<const char*> texts{"#version 330 core\n"};
    texts.insert(texts.end(), sources.begin(), sources.end());
    const GLuint shader = gl.CreateShader(stage);
    gl.ShaderSource(shader, static_cast<GLsizei>(texts.size()), texts.data(), nullptr);
    gl.CompileShader(shader);
    GLint compiled = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled != 0) return shader;

    char log[512] = "";
    gl.GetShaderInfoLog(shader, sizeof(log), nullptr, log);
    gl.DeleteShader(shader);
    throw GlError(std::string("the OpenGL driver refuses a shader of candela: ") +
                  std::string(log).substr(0, std::string(log).find('\n')));
}

}  // namespace

GlProgram::GlProgram(const GlFunctions& gl, std::initializer_list<const char*> vertex,
                     std::initializer_list<const char*> fragment)
    : gl_(gl) {
    const GLuint vertex_shader = compile(gl, GL_VERTEX_SHADER, vertex);
    GLuint fragment_shader = 0;
    try {
        fragment_shader = compile(gl, GL_FRAGMENT_SHADER, fragment);
    } catch (const GlError&) {
        gl.DeleteShader(vertex_shader);
        throw;
    }
    id_ = gl.CreateProgram();
    gl.AttachShader(id_, vertex_shader);
    gl.AttachShader(id_, fragment_shader);
    gl.LinkProgram(id_);
    gl.DeleteShader(vertex_shader);
    gl.DeleteShader(fragment_shader);
    GLint linked = 0;
    gl.GetProgramiv(id_, GL_LINK_STATUS, &linked);
    if (linked == 0) {
        gl.DeleteProgram(id_);
        throw GlError("the OpenGL driver cannot link a shader program of candela");
    }
}

GlProgram::~GlProgram() {
    gl_.DeleteProgram(id_);
}

}  // namespace candela
