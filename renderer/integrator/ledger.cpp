// SPDX-License-Identifier: MIT
#include "renderer/integrator/ledger.h"

#include "renderer/integrator/stages.h"
#include "renderer/math/parallel.h"
#include "renderer/world/surface_point.h"

namespace candela {

namespace {

// What became of a path that stood before the surface as `before`.
PathEvent event_of(const Vec3& geometric_normal, const PathState& before, const PathState& after) {
    if (!after.alive) return PathEvent::ended;
    if (after.depth == before.depth) return PathEvent::passed;
    const bool same_side = (glm::dot(after.ray.direction, geometric_normal) > 0.0f) ==
                           (glm::dot(before.ray.direction, geometric_normal) < 0.0f);
    if (after.from_delta) return same_side ? PathEvent::mirrored : PathEvent::refracted;
    return same_side ? PathEvent::reflected : PathEvent::transmitted;
}

}  // namespace

const char* name_of(PathEvent event) {
    constexpr const char* names[] = {"missed", "ended", "reflected", "transmitted", "mirrored", "refracted", "passed"};
    return names[static_cast<size_t>(event)];
}

Ledger trace_ledger(const World& world, const View& view, const IntegratorSettings& settings, PixelSample sample,
                    float far_m) {
    Ledger out;
    out.sample = sample;
    RayCounts counts;
    PathState path = begin_path(view, settings, sample);
    out.eye = path.ray.origin;
    while (path.alive) {
        // The stages of trace_sample, with what they changed written down.
        const PathState before = path;
        const Hit hit = extend(world, path, counts);
        const VertexPoints u = draw_vertex(path);
        const ShadowRequest light = shade(world, settings, hit, u, path, nullptr);
        LedgerVertex vertex;
        vertex.found = path.radiance - before.radiance;
        if (hit.valid()) {
            const SurfacePoint point = make_surface_point(world, hit, -before.ray.direction);
            vertex.event = event_of(point.geometric_normal, before, path);
            vertex.position = point.position;
            vertex.material = point.material;
            vertex.instance = world.surfaces[point.surface].instance;
        } else {
            vertex.position = before.ray.origin + far_m * before.ray.direction;
        }
        vertex.throughput = path.throughput;
        if (vertex.event == PathEvent::reflected || vertex.event == PathEvent::transmitted) vertex.pdf = path.bsdf_pdf;
        if (light.active) {
            const Vec3 unconnected = path.radiance;
            connect(world, light, path, nullptr, counts);
            vertex.connected = path.radiance - unconnected;
            vertex.has_connection = true;
            vertex.connection_end = light.ray.origin + std::min(light.ray.t_max, far_m) * light.ray.direction;
        }
        out.vertices.push_back(vertex);
    }
    out.radiance = finish(path, nullptr).radiance;
    return out;
}

std::optional<PixelSample> brightest_sample(const World& world, const View& view, const IntegratorSettings& settings,
                                            Vec2u pixel, uint32_t count, const std::atomic<bool>* cancel) {
    constexpr uint32_t chunk = 16;
    const uint32_t chunks = (count + chunk - 1) / chunk;
    struct Best {
        float luminance = -1;
        uint32_t index = 0;
    };
    const auto sample_of = [&](uint32_t index) {
        return PixelSample{static_cast<uint16_t>(pixel.x), static_cast<uint16_t>(pixel.y), index};
    };
    const auto stopped = [&] { return cancel != nullptr && cancel->load(std::memory_order_relaxed); };
    std::vector<Best> best(chunks);
    parallel_for_each(chunks, 1, [&](size_t i) {
        for (uint32_t index = static_cast<uint32_t>(i) * chunk;
             index < std::min(count, (static_cast<uint32_t>(i) + 1) * chunk) && !stopped(); ++index) {
            RayCounts counts;
            const float here = luminance(trace_sample(world, view, settings, sample_of(index), counts).radiance);
            if (here > best[i].luminance) best[i] = {here, index};
        }
    });
    if (stopped() || count == 0) return std::nullopt;
    Best brightest;
    for (const Best& each : best) {
        if (each.luminance > brightest.luminance) brightest = each;
    }
    return sample_of(brightest.index);
}

}  // namespace candela
