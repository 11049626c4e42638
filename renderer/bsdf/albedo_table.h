// SPDX-License-Identifier: MIT
// Directional albedo of the GGX lobe with Schlick's Fresnel, tabulated: E(f0, f90) = f0·scale + f90·bias, exactly
// linear.
#pragma once

#include "renderer/math/math.h"

namespace candela {

struct SpecularAlbedo {
    float scale = 0;
    float bias = 0;
    // The albedo of a lobe that reflects all light: what single scattering leaves of 1.
    float total() const { return scale + bias; }
};

// Bilinear in a table over cosine and perceptual roughness; within 2e-3 of the integral (tested).
SpecularAlbedo specular_albedo(float cos_theta, float alpha) noexcept;
// The same for a lobe that is wider along x: alpha.x >= alpha.y. Its table is made at the first call.
SpecularAlbedo specular_albedo(const Vec3& wo, const Vec2& alpha) noexcept;

// Cosine-weighted means over the hemisphere, 2∫ x cosθ d(cosθ), of the interpolated table: of scale and bias, and of
// both divided by their sum.
struct MeanSpecularAlbedo {
    SpecularAlbedo single;
    SpecularAlbedo compensated;
};
MeanSpecularAlbedo mean_specular_albedo(float alpha) noexcept;

}  // namespace candela
