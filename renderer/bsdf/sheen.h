// SPDX-License-Identifier: MIT
// The sheen of cloth (KHR_materials_sheen): Charlie's distribution of fibres (Estevez and Kulla 2017) with Ashikhmin's
// visibility, which the extension names. alpha is the square of the sheen roughness.
#pragma once

#include "renderer/math/math.h"

namespace candela {

inline constexpr float min_sheen_alpha = 0.01f;

// f·cos of a white sheen, both directions above the surface.
float eval_sheen(const Vec3& wo, const Vec3& wi, float alpha) noexcept;
// Its integral over wi: the directional albedo, in [0,1], from a table.
float sheen_albedo(float cos_theta, float alpha) noexcept;
// Directions are drawn uniformly over the hemisphere: fibres scatter widely.
Vec3 sample_sheen(const Vec2& u) noexcept;
float sheen_pdf() noexcept;

}  // namespace candela
