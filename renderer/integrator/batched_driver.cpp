// SPDX-License-Identifier: MIT
// The same path tracer, one step for all paths of a batch before the next step: each step's code and data stay in
// cache.
#include <array>
#include <numeric>

#include "renderer/integrator/stages.h"
#include "renderer/world/surface_point.h"

namespace candela {

namespace {

// About 90 KiB, and 170 more where paths are shared: a batch stays in a core's L2 cache.
struct Batch {
    std::array<PathState, max_batch> paths;
    std::array<Hit, max_batch> hits;
    std::array<ShadowRequest, max_batch> lights;
    std::array<uint16_t, max_batch> alive;
    PointBatch points;
    std::array<ReusablePath, max_batch> reusable;
    ReuseGroups groups;

    ReusablePath* reuse(std::span<const PixelSample> samples, size_t i) {
        return samples[i].sharing != PathSharing::none ? &reusable[i] : nullptr;
    }
};

}  // namespace

bool trace_batch(const World& world, const View& view, const IntegratorSettings& settings,
                 std::span<const PixelSample> samples, std::span<RadianceSample> out, RayCounts& counts,
                 const std::atomic<uint64_t>* cancel, uint64_t cancel_expected) noexcept {
    thread_local Batch batch;
    const size_t count = std::min(samples.size(), max_batch);
    const auto cancelled = [&] {
        return cancel != nullptr && cancel->load(std::memory_order_relaxed) != cancel_expected;
    };

    // Start all camera rays.
    for (size_t i = 0; i < count; ++i) {
        batch.paths[i] = begin_path(view, settings, samples[i]);
        if (samples[i].sharing != PathSharing::none) batch.reusable[i].clear();
    }
    std::iota(batch.alive.begin(), batch.alive.begin() + static_cast<std::ptrdiff_t>(count), uint16_t{0});

    size_t alive = count;
    while (alive > 0) {
        // Follow every living path to its next surface.
        if (cancelled()) return false;
        for (size_t k = 0; k < alive; ++k) {
            const size_t i = batch.alive[k];
            batch.hits[i] = extend(world, batch.paths[i], counts);
            prefetch_triangle(world, batch.hits[i]);
        }
        // Draw the random numbers of all vertices.
        if (cancelled()) return false;
        for (size_t k = 0; k < alive; ++k) {
            prefetch_vertices(world, batch.hits[batch.alive[k]]);
            PathState& path = batch.paths[batch.alive[k]];
            start_vertex(path);
            batch.points.set(k, path.sampler);
        }
        batch.points.draw(alive, VertexPoints::pairs);
        // Scatter there, and plan the light connections.
        for (size_t k = 0; k < alive; ++k) {
            const size_t i = batch.alive[k];
            batch.lights[i] = shade(world, settings, batch.hits[i], vertex_points(batch.points, k), batch.paths[i],
                                    batch.reuse(samples, i));
        }
        // Trace the connections, and drop the paths that ended.
        if (cancelled()) return false;
        size_t still_alive = 0;
        for (size_t k = 0; k < alive; ++k) {
            const uint16_t i = batch.alive[k];
            if (batch.lights[i].active)
                connect(world, batch.lights[i], batch.paths[i], batch.reuse(samples, i), counts);
            if (batch.paths[i].alive) batch.alive[still_alive++] = i;
        }
        alive = still_alive;
    }
    for (size_t i = 0; i < count; ++i)
        out[i] = finish(batch.paths[i], batch.reuse(samples, i));

    // Connect the first vertices of each group to the second ones.
    batch.groups.form(samples.first(count));
    for (size_t g = 0; g < batch.groups.count; ++g) {
        if (cancelled()) return false;
        reuse_paths(world, settings, batch.groups.group(g), batch.reusable, out, counts);
    }
    return true;
}

}  // namespace candela
