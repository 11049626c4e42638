// SPDX-License-Identifier: MIT
// Wavelengths of light for paths through dispersive glass: one is drawn for a path, and its colour makes up for all
// others on average.
#pragma once

#include "renderer/math/math.h"

namespace candela {

struct WavelengthSample {
    float wavelength_nm = 0;
    // Linear sRGB response of the wavelength over its pdf. The mean over all wavelengths is (1,1,1): light that nothing
    // disperses keeps its colour. Components may be negative, for spectral colours lie outside of sRGB.
    Vec3 weight{1};
};

// u uniform in [0,1). Drawn ∝ about the response's magnitude, between 380 and 780 nm.
WavelengthSample sample_wavelength(float u) noexcept;
float wavelength_pdf(float wavelength_nm) noexcept;  // per nm
// Linear sRGB response of a wavelength per nm: the CIE 1931 colour matching functions by Wyman et al. 2013 ("Simple
// Analytic Approximations to the CIE XYZ Color Matching Functions", equation 4), scaled so that each component
// integrates to 1.
Vec3 wavelength_response(float wavelength_nm) noexcept;

// Index of refraction at a wavelength: KHR_materials_dispersion's form of Cauchy's equation, from the index at the
// helium d line (587.6 nm) and dispersion = 20 / Abbe number. At least 1.
inline float dispersed_ior(float ior, float dispersion, float wavelength_nm) {
    return std::max(1.0f,
                    ior + (ior - 1.0f) * dispersion / 20.0f * (523655.0f / (wavelength_nm * wavelength_nm) - 1.5168f));
}

}  // namespace candela
