// SPDX-License-Identifier: MIT
// Reflectance of interfaces. Cosines are those between the direction and the facet's normal, in [0,1].
#pragma once

#include "renderer/math/math.h"

namespace candela {

// Schlick's weight of f90 in F = f0·(1 − w) + f90·w; Schlick 1994, equation 15.
inline float schlick_weight(float cos_theta) {
    const float m = std::clamp(1.0f - cos_theta, 0.0f, 1.0f);
    const float m2 = m * m;
    return m2 * m2 * m;
}

// Cosine beyond an interface of relative index eta, by Snell's law; 0 at total reflection.
inline float refracted_cosine(float cos_i, float eta) {
    return safe_sqrt(1.0f - (1.0f - cos_i * cos_i) / (eta * eta));
}

// Unpolarised reflectance of a dielectric whose index is eta times that on the light's side; 1 at total reflection.
// Fresnel's equations, as in Walter et al. 2007, equation 22.
inline float fresnel_dielectric(float cos_i, float eta) {
    const float cos_t = refracted_cosine(cos_i, eta);
    if (cos_t == 0.0f && eta < 1.0f) return 1.0f;
    const float s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    const float p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    return 0.5f * (s * s + p * p);
}

// Reflectance at normal incidence.
inline float normal_reflectance(float eta) {
    return sqr((eta - 1.0f) / (eta + 1.0f));
}

}  // namespace candela
