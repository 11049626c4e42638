// SPDX-License-Identifier: MIT
// The path tracer as one reads it: the oracle of every faster driver.
#include "renderer/integrator/stages.h"

namespace candela {

namespace {

RadianceSample trace_path(const World& world, const View& view, const IntegratorSettings& settings,
                          const PixelSample& sample, ReusablePath* reuse, RayCounts& counts) {
    PathState path = begin_path(view, settings, sample);
    while (path.alive) {
        const Hit hit = extend(world, path, counts);
        const VertexPoints u = draw_vertex(path);
        const ShadowRequest light = shade(world, settings, hit, u, path, reuse);
        if (light.active) connect(world, light, path, reuse, counts);
    }
    return finish(path, reuse);
}

}  // namespace

RadianceSample trace_sample(const World& world, const View& view, const IntegratorSettings& settings,
                            PixelSample sample, RayCounts& counts) noexcept {
    return trace_path(world, view, settings, sample, nullptr, counts);
}

void trace_samples(const World& world, const View& view, const IntegratorSettings& settings,
                   std::span<const PixelSample> samples, std::span<RadianceSample> out, RayCounts& counts) noexcept {
    thread_local std::array<ReusablePath, max_batch> paths;
    for (size_t i = 0; i < samples.size(); ++i) {
        paths[i].clear();
        out[i] = trace_path(world, view, settings, samples[i],
                            samples[i].sharing != PathSharing::none ? &paths[i] : nullptr, counts);
    }
    ReuseGroups groups;
    groups.form(samples);
    for (size_t g = 0; g < groups.count; ++g)
        reuse_paths(world, settings, groups.group(g), paths, out, counts);
}

}  // namespace candela
