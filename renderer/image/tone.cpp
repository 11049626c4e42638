// SPDX-License-Identifier: MIT
// shaders/tone.glsl holds the same curves line for line.
#include "renderer/image/tone.h"

namespace candela {

namespace {

// Khronos PBR Neutral Tone Mapper, specification 1.0.
Vec3 neutral(Vec3 color) {
    const float start_compression = 0.8f - 0.04f;
    const float desaturation = 0.15f;
    const float x = std::min(color.r, std::min(color.g, color.b));
    const float offset = x < 0.08f ? x - 6.25f * x * x : 0.04f;
    color -= offset;
    const float peak = max_component(color);
    if (peak < start_compression) return color;
    const float d = 1.0f - start_compression;
    const float new_peak = 1.0f - d * d / (peak + d - start_compression);
    color *= new_peak / peak;
    const float g = 1.0f - 1.0f / (desaturation * (peak - new_peak) + 1.0f);
    return glm::mix(color, Vec3(new_peak), g);
}

// Stephen Hill's fit of the ACES reference rendering and output transforms, as three.js has it (ACESFilmicToneMapping).
Vec3 aces(Vec3 color) {
    const Mat3 input(0.59719f, 0.07600f, 0.02840f, 0.35458f, 0.90834f, 0.13383f, 0.04823f, 0.01566f, 0.83777f);
    const Mat3 output(1.60475f, -0.10208f, -0.00327f, -0.53108f, 1.10813f, -0.07276f, -0.07367f, -0.00605f, 1.07602f);
    color = input * (color / 0.6f);
    const Vec3 a = color * (color + 0.0245786f) - 0.000090537f;
    const Vec3 b = color * (0.983729f * color + 0.4329510f) + 0.238081f;
    return output * (a / b);
}

// AgX as three.js has it (AgXToneMapping): Troy Sobotka's transform with Benjamin Wrensch's polynomial for the
// contrast.
Vec3 agx(Vec3 color) {
    const Mat3 rec2020_from_srgb(0.6274f, 0.0691f, 0.0164f, 0.3293f, 0.9195f, 0.0880f, 0.0433f, 0.0113f, 0.8956f);
    const Mat3 srgb_from_rec2020(1.6605f, -0.1246f, -0.0182f, -0.5876f, 1.1329f, -0.1006f, -0.0728f, -0.0083f, 1.1187f);
    const Mat3 inset(0.856627153315983f, 0.137318972929847f, 0.11189821299995f, 0.0951212405381588f, 0.761241990602591f,
                     0.0767994186031903f, 0.0482516061458583f, 0.101439036467562f, 0.811302368396859f);
    const Mat3 outset(1.1271005818144368f, -0.1413297634984383f, -0.14132976349843826f, -0.11060664309660323f,
                      1.157823702216272f, -0.11060664309660294f, -0.016493938717834573f, -0.016493938717834257f,
                      1.2519364065950405f);
    const float min_ev = -12.47393f;
    const float max_ev = 4.026069f;
    color = inset * (rec2020_from_srgb * color);
    color = glm::max(color, Vec3(1e-10f));
    color = glm::clamp((glm::log2(color) - min_ev) / (max_ev - min_ev), 0.0f, 1.0f);
    const Vec3 x2 = color * color;
    const Vec3 x4 = x2 * x2;
    color = 15.5f * x4 * x2 - 40.14f * x4 * color + 31.96f * x4 - 6.868f * x2 * color + 0.4298f * x2 + 0.1191f * color -
            0.00232f;
    color = glm::pow(glm::max(outset * color, Vec3(0)), Vec3(2.2f));
    return srgb_from_rec2020 * color;
}

uint8_t quantise(float value) {
    return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

}  // namespace

std::string_view name_of(ToneCurve curve) {
    switch (curve) {
        case ToneCurve::linear:
            return "linear";
        case ToneCurve::neutral:
            return "neutral";
        case ToneCurve::aces:
            return "aces";
        case ToneCurve::agx:
            return "agx";
    }
    return "";
}

float srgb_from_linear(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float linear_from_srgb(float srgb) {
    return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

Vec3 display_from_linear(const Vec3& radiance, const ToneSettings& settings) {
    Vec3 color = glm::max(radiance, Vec3(0)) * std::exp2(settings.exposure_ev);
    switch (settings.curve) {
        case ToneCurve::linear:
            break;
        case ToneCurve::neutral:
            color = neutral(color);
            break;
        case ToneCurve::aces:
            color = aces(color);
            break;
        case ToneCurve::agx:
            color = agx(color);
            break;
    }
    color = glm::clamp(color, 0.0f, 1.0f);
    return {srgb_from_linear(color.r), srgb_from_linear(color.g), srgb_from_linear(color.b)};
}

ImageRgba8 tone_map(const ImageRgba32f& image, const ToneSettings& settings) {
    ImageRgba8 out(image.width(), image.height());
    for (size_t i = 0; i < image.size(); ++i) {
        const Vec4& p = image.pixels()[i];
        const Vec3 straight = p.a > 0.0f ? Vec3(p) / p.a : Vec3(0);
        const Vec3 display = display_from_linear(straight, settings);
        out.pixels()[i] = Rgba8(quantise(display.r), quantise(display.g), quantise(display.b), quantise(p.a));
    }
    return out;
}

}  // namespace candela
