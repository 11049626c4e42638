// SPDX-License-Identifier: MIT
// The path tracer as one reads it: the oracle of every faster driver.
#include "renderer/integrator/stages.h"

namespace candela {

RadianceSample trace_sample(const World& world, const View& view, const IntegratorSettings& settings,
                            PixelSample sample, RayCounts& counts) noexcept {
    PathState path = begin_path(view, settings, sample);
    while (path.alive) {
        const Hit hit = extend(world, path, counts);
        const VertexPoints u = draw_vertex(path);
        const ShadowRequest light = shade(world, settings, hit, u, path);
        if (light.active) connect(world, light, path, counts);
    }
    return finish(path);
}

}  // namespace candela
