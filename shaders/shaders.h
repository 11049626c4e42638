// SPDX-License-Identifier: MIT
// The GLSL files of this folder as text. None has a #version line: whoever compiles them puts "#version 330 core"
// first.
#pragma once

namespace candela::shaders {

extern const char* const display_vert;
extern const char* const display_frag;  // needs heat_glsl and tone_glsl before it
extern const char* const heat_glsl;
extern const char* const tone_glsl;
extern const char* const ui_vert;
extern const char* const ui_frag;

}  // namespace candela::shaders
