// SPDX-License-Identifier: MIT
// What a path costs, and what it would cost if it were traced alone.
#pragma once

#include <limits>
#include <vector>

#include "renderer/session/schedule.h"

namespace candela::bench {

// Of this thread.
double cpu_seconds();

// Traces a picture as a session does, on this thread: visit(samples, radiance) for each batch. Returns its CPU seconds.
template <typename Visit>
double trace_picture(const World& world, const View& view, const IntegratorSettings& settings, uint32_t spp,
                     RayCounts& rays, const Visit& visit) {
    std::vector<PixelSample> wanted;
    std::vector<RadianceSample> got(max_batch);
    Schedule schedule(view.extent, 1, settings.may_reuse_paths());
    const double start = cpu_seconds();
    while (schedule.complete_samples() < spp) {
        const Slice pass = schedule.next(std::numeric_limits<uint32_t>::max());
        for (uint32_t t = 0; t < pass.size(); ++t) {
            schedule.list(pass, pass.tile(t), wanted);
            trace_batch(world, view, settings, wanted, got, rays);
            schedule.note(pass.tile(t), wanted, got);
            visit(wanted, got);
        }
    }
    return cpu_seconds() - start;
}

// Paths per CPU second that the accelerator alone traces: cosine-distributed bounces off every surface, at each a ray
// to a point of some lamp (straight up where there is none), and no shading at all. The median of five pictures.
double limit_paths_per_s(const World& world, const View& view, uint32_t max_depth);

}  // namespace candela::bench
