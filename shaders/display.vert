// SPDX-License-Identifier: MIT
// One triangle that covers the viewport. uv is (0,0) at the top left, as pictures have it.

out vec2 uv;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    uv = vec2(corner.x, -corner.y) * 0.5 + 0.5;
    gl_Position = vec4(corner, 0.0, 1.0);
}
