// SPDX-License-Identifier: MIT
// Panels: vertex colour times the coverage of glyphs and shapes in the font atlas.

uniform sampler2D atlas;

in vec2 uv;
in vec4 color;
out vec4 pixel;

void main() {
    pixel = color * texture(atlas, uv);
}
