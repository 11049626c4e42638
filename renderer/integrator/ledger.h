// SPDX-License-Identifier: MIT
// What happened to one sample of a pixel, vertex by vertex: the firefly's ledger.
// It is the path that the pixel traced itself; what neighbours share with it (path_reuse.h) is not in it.
#pragma once

#include "renderer/integrator/integrator.h"

namespace candela {

enum class PathEvent : uint8_t {
    missed,  // left the scene
    ended,   // absorbed, or gave up by roulette
    reflected,
    transmitted,
    mirrored,   // reflected in a delta direction
    refracted,  // transmitted in a delta direction
    passed      // went on straight: through thin glass, or a boundary that another body hides
};
const char* name_of(PathEvent event);

struct LedgerVertex {
    PathEvent event = PathEvent::missed;
    Vec3 position{0};                                             // of the surface; of a miss: a point on the ray
    uint32_t instance = invalid_index, material = invalid_index;  // invalid: missed
    Vec3 throughput{1};                                           // after the event
    float pdf = 0;                                                // of the direction that was drawn; 0: none was
    Vec3 found{0};                                                // light that the segment ran into
    Vec3 connected{0};                                            // light of the connection, if it came through
    bool has_connection = false;
    Vec3 connection_end{0};  // where the connection leads
};

struct Ledger {
    PixelSample sample;
    Vec3 radiance{0};  // of trace_sample, to the bit
    Vec3 eye{0};
    std::vector<LedgerVertex> vertices;
};

// Replays the sample as the scalar driver traces it. far_m: how far misses and connections to infinity are drawn.
Ledger trace_ledger(const World& world, const View& view, const IntegratorSettings& settings, PixelSample sample,
                    float far_m);

// The sample of largest luminance among the first `count` of a pixel. Runs on TBB's threads; nothing once *cancel (may
// be null) is set.
std::optional<PixelSample> brightest_sample(const World& world, const View& view, const IntegratorSettings& settings,
                                            Vec2u pixel, uint32_t count, const std::atomic<bool>* cancel = nullptr);

}  // namespace candela
