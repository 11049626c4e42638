// SPDX-License-Identifier: MIT
// Where bodies of a refracting medium begin and end along a path.
#pragma once

#include "renderer/integrator/path_state.h"
#include "renderer/sampling/wavelength.h"
#include "renderer/world/shaded_material.h"

namespace candela {

// What a body leaves of light over a distance, by Beer-Lambert's law. A body without end absorbs nothing: its mesh is
// not closed.
inline Vec3 transmittance_of(const World& world, uint32_t medium, float distance_m) {
    if (medium == invalid_index || is_black(world.media[medium].absorption) || !std::isfinite(distance_m)) {
        return Vec3(1);
    }
    return glm::exp(-world.media[medium].absorption * distance_m);
}

// The boundary of a body, as the path meets it.
struct Boundary {
    MediumSet near, far;  // the bodies on wo's side and beyond
    InterfaceIndices indices;
    bool is_hidden = false;  // inside another body of higher rank: not there
};

inline float index_of(const World& world, uint32_t medium, float wavelength_nm) {
    if (medium == invalid_index) return 1.0f;
    const Medium& m = world.media[medium];
    return m.dispersion > 0.0f && wavelength_nm > 0.0f ? dispersed_ior(m.ior, m.dispersion, wavelength_nm) : m.ior;
}

// Sorts out which bodies meet at a surface. A dispersive one commits the path to one wavelength.
[[gnu::always_inline]] inline Boundary meet_boundary(const World& world, uint32_t medium, bool entering,
                                                     float u_wavelength, PathState& path) {
    Boundary out;
    out.near = out.far = path.media;
    if (medium == invalid_index) return out;
    (entering ? out.far : out.near).enter(medium);
    (entering ? out.near : out.far).leave(medium);
    const uint32_t other = path.media.present(world, medium);
    out.is_hidden = other != invalid_index && world.media[other].rank > world.media[medium].rank;
    if (out.is_hidden) return out;

    const bool disperses =
        world.media[medium].dispersion > 0.0f || (other != invalid_index && world.media[other].dispersion > 0.0f);
    if (disperses && path.wavelength_nm == 0.0f) {
        const WavelengthSample sampled = sample_wavelength(u_wavelength);
        path.wavelength_nm = sampled.wavelength_nm;
        path.throughput *= sampled.weight;
    }
    const float own = index_of(world, medium, path.wavelength_nm);
    const float others = index_of(world, other, path.wavelength_nm);
    out.indices = entering ? InterfaceIndices{others, own} : InterfaceIndices{own, others};
    return out;
}

}  // namespace candela
