// SPDX-License-Identifier: MIT
// Exposure and tone curves from linear Rec. 709 radiance to 8-bit sRGB. shaders/ holds the same curves in GLSL; a test
// keeps the two equal.
#pragma once

#include <string_view>

#include "renderer/image/image.h"

namespace candela {

// linear: clip · neutral: Khronos PBR Neutral · aces: Hill's fit of the ACES RRT+ODT as three.js has it (its
// 1/0.6 pre-exposure included) · agx: Blender's AgX base look, as three.js approximates it.
enum class ToneCurve : uint8_t { linear, neutral, aces, agx };

struct ToneSettings {
    float exposure_ev = 0.0f;  // radiance is multiplied by 2^exposure_ev
    ToneCurve curve = ToneCurve::neutral;

    bool operator==(const ToneSettings&) const = default;
};

std::string_view name_of(ToneCurve curve);

float srgb_from_linear(float linear);
float linear_from_srgb(float srgb);

// Exposure, curve, clip to [0,1], sRGB transfer: display values in [0,1].
Vec3 display_from_linear(const Vec3& radiance, const ToneSettings& settings);

// Alpha is carried through unchanged (premultiplied radiance is un-premultiplied before the curve).
ImageRgba8 tone_map(const ImageRgba32f& image, const ToneSettings& settings);

}  // namespace candela
