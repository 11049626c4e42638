// SPDX-License-Identifier: MIT
// What the shading of one vertex decided and why, for whoever wants to read a path (ledger.h): the factors of which the
// path's radiance is made.
#pragma once

#include <optional>

#include "renderer/bsdf/stack.h"
#include "renderer/math/math.h"

namespace candela {

enum class LightTechnique : uint8_t {
    seen,         // by the camera itself
    bsdf_sample,  // a direction of the path ran into it
    light_sample
};

// Light that one technique brings to a path at a vertex.
struct LightRecord {
    LightTechnique technique = LightTechnique::seen;
    // Which light: of World::surfaces, or of Lights::punctual; neither: the environment.
    uint32_t surface = 0xffffffffu, punctual = 0xffffffffu;
    bool is_background = false;  // a colour in its place
    Vec3 light{0};               // radiance that was found; of a light sample radiance / pdf
    Vec3 scattered{1};           // f·|cos| towards a light sample
    Vec3 transmittance{1};       // of the body that the connection runs through
    // With which the two techniques draw this direction, per solid angle. 0: that one cannot.
    float light_pdf = 0, bsdf_pdf = 0;
    bool is_delta = false;  // no other technique can find it, and its pdf is a probability
    float share = 1;        // the weight of the technique
};

// Why a path goes no further.
enum class PathEnd : uint8_t {
    none,      // it goes on
    missed,    // left the scene
    absorbed,  // nothing is scattered, or to where no light goes
    depth,     // Settings::max_depth, or more boundaries than optics knows
    roulette
};

struct VertexRecord {
    Vec3 transmittance{1};  // of the segment: what a body left, times the weight of the wavelength that was drawn
    std::optional<LightRecord> found, sampled;
    // The direction that was drawn, if one was.
    BsdfLobe lobe = bsdf_lobe_count;
    bool transmitted = false;  // to the other side
    bool is_delta = false;     // pdf is the probability of the lobe
    bool is_straight = false;
    float pdf = 0;   // per solid angle
    Vec3 weight{1};  // f·|cos| / pdf
    float survival = 1;
    PathEnd end = PathEnd::none;
};

}  // namespace candela
