// SPDX-License-Identifier: MIT
// What decides a sample besides World and Camera.
#pragma once

#include "renderer/math/math.h"
#include "renderer/sampling/sampler.h"

namespace candela {

// mis: both techniques, power heuristic. light: next-event estimation alone. bsdf: direction sampling alone (lights
// without extent, which no direction can hit, are still sampled).
enum class Estimator : uint8_t { mis, light, bsdf };
enum class PixelFilter : uint8_t { blackman_harris, box };
enum class BackgroundKind : uint8_t { environment, color, transparent };

struct IntegratorSettings {
    Estimator estimator = Estimator::mis;
    SamplerKind sampler = SamplerKind::sobol;
    PixelFilter filter = PixelFilter::blackman_harris;
    uint32_t max_depth = 0;       // scattering events at most; 1 = direct light only; 0: no limit but Russian roulette
    float clamp_indirect = 0.0f;  // 0: off. Biased
    uint32_t seed = 0;
    BackgroundKind background = BackgroundKind::environment;
    Vec3 background_color{0};
    bool russian_roulette = true;
    bool reuse_paths = true;      // between neighbouring pixels, where a session finds that it pays (path_reuse.h)
    bool filter_textures = true;  // over what a sample stands for (texture.h); false: every lookup at level 0

    // A clamp holds for the light of one path.
    bool may_reuse_paths() const { return reuse_paths && !(clamp_indirect > 0.0f); }
    bool biased() const { return clamp_indirect > 0.0f || max_depth > 0; }
    bool operator==(const IntegratorSettings&) const = default;
};

}  // namespace candela
