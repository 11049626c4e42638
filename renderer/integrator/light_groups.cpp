// SPDX-License-Identifier: MIT
#include "renderer/integrator/light_groups.h"

#include <algorithm>
#include <numeric>

#include "renderer/integrator/stages.h"

namespace candela {

namespace {

// A lamp or an emissive material that may get a group of its own.
struct Source {
    std::string name;
    float power = 0;
    bool is_punctual = false;
    size_t index = 0;
};

std::vector<Source> sources_of(const World& world) {
    std::vector<Source> out;
    const Lights& lights = world.lights;
    const float radius = 0.5f * glm::length(world.bounds.upper - world.bounds.lower);
    const std::vector<LightInstance>& placed = world.scene->light_instances;
    for (size_t i = 0; i < lights.punctual.size(); ++i) {
        // All around for lamps; through the disc that the scene fills for directional lights.
        const bool directional = lights.punctual[i].kind == LightKind::directional;
        const float reach = directional ? pi * radius * radius : 4 * pi;
        const bool known = placed.size() == lights.punctual.size();
        const std::string name = known ? world.scene->lights[placed[i].light.value].name : std::string();
        out.push_back({name.empty() ? "lamp " + std::to_string(i) : name,
                       reach * luminance(lights.punctual[i].intensity), true, i});
    }
    std::vector<float> powers(world.materials.size());
    for (const EmissiveTriangle& triangle : lights.triangles)
        powers[world.surfaces[triangle.surface].material] += pi * triangle.mean_radiance * 0.5f * triangle.doubled_area;
    for (size_t i = 0; i < powers.size(); ++i) {
        const std::string& name = world.materials[i].name;
        if (powers[i] > 0) out.push_back({name.empty() ? "material " + std::to_string(i) : name, powers[i], false, i});
    }
    return out;
}

uint8_t group_of_miss(const LightGroups& groups, const IntegratorSettings& settings, uint32_t depth) {
    const bool sees_background = depth == 0 && settings.background != BackgroundKind::environment;
    return sees_background ? groups.rest() : groups.environment;
}

uint8_t group_of_light(const World& world, const LightGroups& groups, const ShadowRequest& request) {
    if (request.light_surface != invalid_index)
        return groups.of_material[world.surfaces[request.light_surface].material];
    return request.punctual != invalid_index ? groups.of_punctual[request.punctual] : groups.environment;
}

}  // namespace

std::shared_ptr<const LightGroups> make_light_groups(const World& world) {
    auto out = std::make_shared<LightGroups>();
    std::vector<Source> sources = sources_of(world);
    std::stable_sort(sources.begin(), sources.end(),
                     [](const Source& a, const Source& b) { return a.power > b.power; });
    if (world.lights.environment) out->names.emplace_back("environment");
    while (!sources.empty() && out->names.size() + sources.size() + 1 > most_light_groups)
        sources.pop_back();
    const auto rest = static_cast<uint8_t>(out->names.size() + sources.size());
    out->environment = world.lights.environment ? uint8_t{0} : rest;
    out->of_punctual.assign(world.lights.punctual.size(), rest);
    out->of_material.assign(world.materials.size(), rest);
    for (const Source& source : sources) {
        (source.is_punctual ? out->of_punctual : out->of_material)[source.index] =
            static_cast<uint8_t>(out->names.size());
        out->names.push_back(source.name);
    }
    out->names.emplace_back("the rest");
    return out;
}

bool trace_grouped(const World& world, const View& view, const IntegratorSettings& settings, const LightGroups& groups,
                   std::span<const PixelSample> samples, std::span<RadianceSample> out, std::span<Vec3> group_radiance,
                   RayCounts& counts, const std::atomic<uint64_t>* cancel, uint64_t cancel_expected) noexcept {
    for (size_t i = 0; i < samples.size(); ++i) {
        if (cancel != nullptr && cancel->load(std::memory_order_relaxed) != cancel_expected) return false;
        const std::span<Vec3> sums = group_radiance.subspan(i * groups.size(), groups.size());
        std::fill(sums.begin(), sums.end(), Vec3(0));
        PathState path = begin_path(view, settings, samples[i]);
        // A stage adds at most one contribution: what it leaves in an empty path is that of one light. The total adds
        // up in the order in which trace_sample adds.
        Vec3 total(0);
        const auto take = [&](uint8_t group) {
            total += path.radiance;
            sums[group] += path.radiance;
            path.radiance = Vec3(0);
        };
        while (path.alive) {
            const Hit hit = extend(world, path, counts);
            const VertexPoints u = draw_vertex(path);
            const uint32_t depth = path.depth;
            const ShadowRequest light = shade(world, settings, hit, u, path, nullptr);
            take(hit.valid() ? groups.of_material[world.surfaces[hit.surface].material]
                             : group_of_miss(groups, settings, depth));
            if (light.active) {
                connect(world, light, path, nullptr, counts);
                take(group_of_light(world, groups, light));
            }
        }
        path.radiance = total;
        out[i] = finish(path, nullptr);
    }
    return true;
}

}  // namespace candela
