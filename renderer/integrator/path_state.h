// SPDX-License-Identifier: MIT
// One path under way: what the stages hand to each other. Plain data without pointers, so that a driver can hold
// hundreds.
#pragma once

#include "renderer/integrator/integrator.h"
#include "renderer/integrator/medium_set.h"

namespace candela {

struct PathState {
    Ray ray;                    // the next segment
    Vec3 throughput{1};         // product of the weights so far; of a shared path, since its second vertex
    Vec3 shared_throughput{1};  // the product up to there
    Vec3 radiance{0};           // gathered so far
    float alpha = 1;
    Sampler sampler;
    MediumSet media;          // what the segment runs through
    RayCone cone;             // around ray: for texture footprints alone
    float texture_share = 0;  // of a footprint, for this sample; 0: textures are not filtered
    // Where ray.direction was drawn, as the light sampler saw it: thin glass and hidden boundaries only move the ray's
    // start.
    LightReceiver vertex;
    float bsdf_pdf = 0;       // with which it was drawn, per solid angle
    float wavelength_nm = 0;  // of a path that went through dispersive glass; 0: all
    float eta_scale = 1;      // product of squared relative indices, taken out of the roulette's decision
    uint32_t depth = 0;       // scattering events so far
    uint32_t segments = 0;    // surfaces met so far, those that were passed straight included
    uint32_t traced = 0;      // rays followed so far, and connections to lights
    uint32_t shadow_rays = 0;
    bool shared = false;     // radiance is what comes from the second vertex on
    bool from_delta = true;  // no light sample could have found ray.direction: camera rays and delta lobes
    bool alive = true;
};

// What next-event estimation wants to know: does light come through, and how much would it be.
struct ShadowRequest {
    Ray ray;  // up to just before the light
    Vec3 contribution{0};
    bool active = false;
    bool shared = false;  // the contribution is what arrives at the second vertex of a path that others share
    // Which light: a placed primitive or a punctual light; neither: the environment.
    uint32_t light_surface = invalid_index, punctual = invalid_index;
};

}  // namespace candela
