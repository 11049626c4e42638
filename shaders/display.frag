// SPDX-License-Identifier: MIT
// From linear premultiplied radiance to what the screen shows.

uniform sampler2D frame;
uniform int curve;               // the order of candela::ToneCurve
uniform float radiance_scale;    // 2^exposure_ev
uniform bool show_checkerboard;  // under pixels that are not opaque; else alpha is handed on

in vec2 uv;
out vec4 pixel;

void main() {
    // Undo the premultiplication, apply exposure and curve.
    vec4 premultiplied = texture(frame, uv);
    vec3 straight = premultiplied.a > 0.0 ? premultiplied.rgb / premultiplied.a : vec3(0.0);
    vec3 color = display_from_linear(straight, curve, radiance_scale);
    if (!show_checkerboard) {
        pixel = vec4(color, premultiplied.a);
        return;
    }

    // Lay it over grey squares of eight pixels.
    ivec2 square = ivec2(gl_FragCoord.xy) / 8;
    float grey = ((square.x + square.y) & 1) == 0 ? 0.40 : 0.48;
    pixel = vec4(mix(vec3(grey), color, clamp(premultiplied.a, 0.0, 1.0)), 1.0);
}
