// SPDX-License-Identifier: MIT
// The colours of a thin film (KHR_materials_iridescence), after Belcour and Barla 2017, "A Practical Extension to
// Microfacet Theory for the Modeling of Varying Iridescence".
#pragma once

#include "renderer/math/math.h"

namespace candela {

// Linear RGB reflectance of a film of index film_ior and thickness_nm between a medium of index outside_ior and a base
// of reflectance base_f0 at normal incidence, seen at cos_theta. In [0,1].
Vec3 thin_film_reflectance(float outside_ior, float film_ior, float cos_theta, float thickness_nm,
                           const Vec3& base_f0) noexcept;

// The f0 with which Schlick's curve with f90 = 1 passes through a reflectance at cos_theta, held in [0,1].
Vec3 schlick_f0(const Vec3& reflectance, float cos_theta) noexcept;

}  // namespace candela
