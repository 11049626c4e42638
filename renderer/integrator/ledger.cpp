// SPDX-License-Identifier: MIT
#include "renderer/integrator/ledger.h"

#include "renderer/integrator/stages.h"
#include "renderer/math/parallel.h"
#include "renderer/world/surface_point.h"

namespace candela {

const char* name_of_scattering(const VertexRecord& shading) {
    switch (shading.lobe) {
        case coat_lobe:
            return "clear coat";
        case sheen_lobe:
            return "sheen";
        case specular_lobe:
            return "specular reflection";
        case diffuse_lobe:
            return "diffuse";
        case transmitted_lobe:
            return "diffuse transmission";
        case glass_lobe:
            return shading.transmitted ? "transmission" : "specular reflection";
        case bsdf_lobe_count:
            break;
    }
    return shading.end == PathEnd::none ? "hidden boundary" : "no direction";
}

const char* name_of(LightTechnique technique) {
    constexpr const char* names[] = {"seen", "BSDF sample", "light sample"};
    return names[static_cast<size_t>(technique)];
}

Ledger trace_ledger(const World& world, const View& view, const IntegratorSettings& settings, PixelSample sample,
                    float far_m) {
    Ledger out;
    out.sample = sample;
    RayCounts counts;
    PathState path = begin_path(view, settings, sample);
    out.eye = path.ray.origin;
    while (path.alive) {
        // The stages of trace_sample, with what they decided written down.
        const PathState before = path;
        const Hit hit = extend(world, path, counts);
        const VertexPoints u = draw_vertex(path);
        LedgerVertex vertex;
        const ShadowRequest light = shade_recorded(world, settings, hit, u, path, vertex.shading);
        vertex.found = path.radiance - before.radiance;
        if (hit.valid()) {
            const SurfacePoint point = make_surface_point(world, hit, -before.ray.direction);
            vertex.position = point.position;
            vertex.material = point.material;
            vertex.instance = world.surfaces[point.surface].instance;
        } else {
            vertex.position = before.ray.origin + far_m * before.ray.direction;
        }
        vertex.throughput = path.throughput;
        if (light.active) {
            const Vec3 unconnected = path.radiance;
            connect(world, light, path, nullptr, counts);
            vertex.connected = path.radiance - unconnected;
            vertex.visibility = world.accel->transmittance(light.ray);
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
