// SPDX-License-Identifier: MIT
// From linear premultiplied radiance to what the screen shows; to the right of the wipe another picture, or a map of
// numbers as colours.

uniform sampler2D frame;
uniform int curve;               // the order of candela::ToneCurve
uniform float radiance_scale;    // 2^exposure_ev
uniform bool show_checkerboard;  // under pixels that are not opaque; else alpha is handed on

uniform sampler2D maps;
uniform int map_channel;  // the order of candela::PixelMap; -1: none
uniform float map_low, map_high;
uniform bool map_logarithmic;
uniform bool map_of_differences;
uniform sampler2D other;  // a picture as frame is
uniform bool other_shown;
uniform float wipe;  // 0 at the picture's left edge, 1 at its right

in vec2 uv;
out vec4 pixel;

void main() {
    if (map_channel >= 0 && uv.x >= wipe) {
        float value = texture(maps, uv)[map_channel];
        // Grey is what is not known yet.
        if (map_of_differences) {
            pixel = vec4(difference_color(value / map_high), 1.0);
            return;
        }
        vec3 heat = value < 0.0 ? vec3(0.25) : heat_color(heat_position(value, map_low, map_high, map_logarithmic));
        pixel = vec4(heat, 1.0);
        return;
    }

    // Undo the premultiplication, apply exposure and curve.
    vec4 premultiplied = other_shown && uv.x >= wipe ? texture(other, uv) : texture(frame, uv);
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
