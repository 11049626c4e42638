// SPDX-License-Identifier: MIT
// Exposure and tone curves, line for line those of renderer/image/tone.cpp; a test keeps the two equal.

// Khronos PBR Neutral Tone Mapper, specification 1.0.
vec3 neutral(vec3 color) {
    const float start_compression = 0.8 - 0.04;
    const float desaturation = 0.15;
    float x = min(color.r, min(color.g, color.b));
    float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
    color -= offset;
    float peak = max(color.r, max(color.g, color.b));
    if (peak < start_compression) return color;
    float d = 1.0 - start_compression;
    float new_peak = 1.0 - d * d / (peak + d - start_compression);
    color *= new_peak / peak;
    float g = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    return mix(color, vec3(new_peak), g);
}

// Stephen Hill's fit of the ACES reference rendering and output transforms, as three.js has it.
vec3 aces(vec3 color) {
    const mat3 input_matrix = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 output_matrix =
        mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    color = input_matrix * (color / 0.6);
    vec3 a = color * (color + 0.0245786) - 0.000090537;
    vec3 b = color * (0.983729 * color + 0.4329510) + 0.238081;
    return output_matrix * (a / b);
}

// AgX as three.js has it.
vec3 agx(vec3 color) {
    const mat3 rec2020_from_srgb = mat3(0.6274, 0.0691, 0.0164, 0.3293, 0.9195, 0.0880, 0.0433, 0.0113, 0.8956);
    const mat3 srgb_from_rec2020 = mat3(1.6605, -0.1246, -0.0182, -0.5876, 1.1329, -0.1006, -0.0728, -0.0083, 1.1187);
    const mat3 inset = mat3(0.856627153315983, 0.137318972929847, 0.11189821299995, 0.0951212405381588,
                            0.761241990602591, 0.0767994186031903, 0.0482516061458583, 0.101439036467562,
                            0.811302368396859);
    const mat3 outset = mat3(1.1271005818144368, -0.1413297634984383, -0.14132976349843826, -0.11060664309660323,
                             1.157823702216272, -0.11060664309660294, -0.016493938717834573, -0.016493938717834257,
                             1.2519364065950405);
    const float min_ev = -12.47393;
    const float max_ev = 4.026069;
    color = inset * (rec2020_from_srgb * color);
    color = max(color, vec3(1e-10));
    color = clamp((log2(color) - min_ev) / (max_ev - min_ev), 0.0, 1.0);
    vec3 x2 = color * color;
    vec3 x4 = x2 * x2;
    color = 15.5 * x4 * x2 - 40.14 * x4 * color + 31.96 * x4 - 6.868 * x2 * color + 0.4298 * x2 + 0.1191 * color -
            0.00232;
    color = pow(max(outset * color, vec3(0.0)), vec3(2.2));
    return srgb_from_rec2020 * color;
}

float srgb_from_linear(float linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

vec3 display_from_linear(vec3 radiance, int curve, float radiance_scale) {
    vec3 color = max(radiance, vec3(0.0)) * radiance_scale;
    if (curve == 1) color = neutral(color);
    if (curve == 2) color = aces(color);
    if (curve == 3) color = agx(color);
    color = clamp(color, 0.0, 1.0);
    return vec3(srgb_from_linear(color.r), srgb_from_linear(color.g), srgb_from_linear(color.b));
}
