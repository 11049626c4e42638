// SPDX-License-Identifier: MIT
// Directional albedo of a rough refracting interface: what single scattering between facets leaves of the light,
// reflected and refracted together, for a lossless interface.
#pragma once

namespace candela {

// cos_theta in [0,1]; alpha the GGX width; eta the index beyond over the index on the light's side, from 1/3 to 3 (held
// beyond). The scaling of radiance by 1/eta² is left out. Trilinear in a table.
float interface_albedo(float cos_theta, float alpha, float eta) noexcept;

}  // namespace candela
