// SPDX-License-Identifier: MIT
// The interface of a transparent dielectric: KHR_materials_transmission, with KHR_materials_volume a real boundary that
// refracts, without it a wall so thin that light leaves it in the direction it came.
// Reflection and transmission share one distribution of facets; what is lost between facets is put back by dividing by
// the albedo of the white interface (Turquin 2019), so that a lossless one returns all light.
#pragma once

#include "renderer/bsdf/bsdf.h"

namespace candela {

// f·cos of the interface alone (coat, sheen and the shares of the layers left out), rough ones only; pdf of
// sample_dielectric.
BsdfEval eval_dielectric(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) noexcept;
// u_branch chooses between reflection and transmission. weight is f·cos/pdf of the interface alone.
BsdfSample sample_dielectric(const Bsdf& bsdf, const Vec3& wo, float u_branch, const Vec2& u) noexcept;
// About the share of light that goes on, with its colour: the exact one for smooth interfaces.
Vec3 dielectric_transmittance(const Bsdf& bsdf, float cos_theta) noexcept;
Vec3 dielectric_reflectance(const Bsdf& bsdf, float cos_theta) noexcept;

}  // namespace candela
