// SPDX-License-Identifier: MIT
// What happened to one sample of a pixel, vertex by vertex: the firefly's ledger.
// It is the path that the pixel traced itself; what neighbours share with it (path_reuse.h) is not in it.
#pragma once

#include "renderer/integrator/integrator.h"
#include "renderer/integrator/vertex_record.h"

namespace candela {

struct LedgerVertex {
    VertexRecord shading;
    Vec3 position{0};                                             // of the surface; of a miss: a point on the ray
    uint32_t instance = invalid_index, material = invalid_index;  // invalid: missed
    Vec3 throughput{1};                                           // of the path after the vertex
    Vec3 found{0};                                                // what shading.found adds to its radiance
    Vec3 connected{0};                                            // what shading.sampled adds
    Vec3 visibility{0};      // of the light sample: what of its light comes through; 0 where it is hidden
    Vec3 connection_end{0};  // where the connection to it leads
};

struct Ledger {
    PixelSample sample;
    Vec3 radiance{0};  // of trace_sample, to the bit
    Vec3 eye{0};
    std::vector<LedgerVertex> vertices;
};

// "diffuse", "clear coat": what sent the path on, or was to; "no direction" where none was drawn.
const char* name_of_scattering(const VertexRecord& shading);
// "light sample", "BSDF sample".
const char* name_of(LightTechnique technique);

// Replays the sample as the scalar driver traces it. far_m: how far misses and connections to infinity are drawn.
Ledger trace_ledger(const World& world, const View& view, const IntegratorSettings& settings, PixelSample sample,
                    float far_m);

// The sample of largest luminance among the first `count` of a pixel. Runs on TBB's threads; nothing once *cancel (may
// be null) is set.
std::optional<PixelSample> brightest_sample(const World& world, const View& view, const IntegratorSettings& settings,
                                            Vec2u pixel, uint32_t count, const std::atomic<bool>* cancel = nullptr);

}  // namespace candela
