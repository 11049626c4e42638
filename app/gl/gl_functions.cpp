// SPDX-License-Identifier: MIT
#include "app/gl/gl_functions.h"

#include <fmt/format.h>

namespace candela {

GlFunctions load_gl_functions(const std::function<void*(const char*)>& get_proc_address) {
    GlFunctions gl;
#define CANDELA_GL_LOAD(type, name)                                 \
    gl.name = reinterpret_cast<type>(get_proc_address("gl" #name)); \
    if (gl.name == nullptr) throw GlError("the OpenGL driver has no gl" #name "; candela needs OpenGL 3.3");
    CANDELA_GL_FUNCTIONS(CANDELA_GL_LOAD)
#undef CANDELA_GL_LOAD

    GLint major = 0, minor = 0;
    gl.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl.GetIntegerv(GL_MINOR_VERSION, &minor);
    if (major * 10 + minor < 33) {
        throw GlError(
            fmt::format("the OpenGL driver offers {}.{}; candela needs 3.3: try LIBGL_ALWAYS_SOFTWARE=1, or "
                        "candela render, which needs no display",
                        major, minor));
    }
    return gl;
}

}  // namespace candela
