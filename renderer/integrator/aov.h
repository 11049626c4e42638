// SPDX-License-Identifier: MIT
// Auxiliary pictures of the first surface that a camera ray meets.
#pragma once

#include <string>
#include <vector>

#include "renderer/integrator/integrator.h"

namespace candela {

struct FirstHit {
    bool hit = false;
    Vec3 albedo{0}, normal{0}, position{0};
    float depth = infinity;  // distance along the ray
    Vec2 uv{0};
    uint32_t material = invalid_index, instance = invalid_index;
};

// The first surface through the centre of a pixel (film_uv in [0,1]²), pinhole.
FirstHit trace_first_hit(const World& world, const View& view, const Vec2& film_uv) noexcept;

}  // namespace candela
