// SPDX-License-Identifier: MIT
// A linked shader program, freed with its owner.
#pragma once

#include <initializer_list>

#include "app/gl/gl_functions.h"

namespace candela {

class GlProgram {
  public:
    // Each stage's sources are put together behind "#version 330 core". Throws GlError with the driver's first line.
    GlProgram(const GlFunctions& gl, std::initializer_list<const char*> vertex,
              std::initializer_list<const char*> fragment);
    ~GlProgram();
    GlProgram(const GlProgram&) = delete;
    GlProgram& operator=(const GlProgram&) = delete;

    void use() const { gl_.UseProgram(id_); }
    // -1, which uniform calls ignore, for a name that the program does not use.
    GLint uniform(const char* name) const { return gl_.GetUniformLocation(id_, name); }

  private:
    const GlFunctions& gl_;
    GLuint id_ = 0;
};

}  // namespace candela
