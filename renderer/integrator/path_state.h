// SPDX-License-Identifier: MIT
// One path under way: what the stages hand to each other. Plain data without pointers, so that a driver can hold
// hundreds.
#pragma once

#include "renderer/integrator/integrator.h"

namespace candela {

struct PathState {
    Ray ray;             // the next segment
    Vec3 throughput{1};  // product of the weights so far
    Vec3 radiance{0};    // gathered so far
    float alpha = 1;
    Sampler sampler;
    float bsdf_pdf = 0;      // with which ray.direction was drawn, per solid angle
    float eta_scale = 1;     // product of squared relative indices, taken out of the roulette's decision
    uint32_t depth = 0;      // scattering events so far
    bool from_delta = true;  // no light sample could have found ray.direction: camera rays and delta lobes
    bool alive = true;
};

// What next-event estimation wants to know: does light come through, and how much would it be.
struct ShadowRequest {
    Ray ray;  // up to just before the light
    Vec3 contribution{0};
    bool active = false;
};

}  // namespace candela
