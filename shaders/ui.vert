// SPDX-License-Identifier: MIT
// Panels: positions in display points, (0,0) at the top left.

uniform mat4 clip_from_point;

layout(location = 0) in vec2 point;
layout(location = 1) in vec2 point_uv;
layout(location = 2) in vec4 point_color;
out vec2 uv;
out vec4 color;

void main() {
    uv = point_uv;
    color = point_color;
    gl_Position = clip_from_point * vec4(point, 0.0, 1.0);
}
