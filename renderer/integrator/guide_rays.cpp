// SPDX-License-Identifier: MIT
#include "renderer/integrator/guide_rays.h"

#include "renderer/integrator/stages.h"
#include "renderer/math/parallel.h"
#include "renderer/world/shaded_material.h"

namespace candela {

namespace {

Guide guide_of(const World& world, const PathState& path, const Hit& hit) noexcept {
    Guide out;
    if (!hit.valid()) return out;
    const Vec3 wo = -path.ray.direction;
    const SurfacePoint point = make_surface_point(world, hit, wo);
    const ShadedMaterial material = shade_material(world, point, wo);
    out.albedo = material.emission;
    if (!material.unlit) out.albedo += albedo(material.bsdf, point.shading.local_from_world(wo));
    out.albedo = glm::clamp(out.albedo, Vec3(0), Vec3(1));
    out.normal = point.shading.normal;
    out.depth = glm::length(point.position - path.ray.origin);
    return out;
}

}  // namespace

bool add_guides(const World& world, const View& view, const IntegratorSettings& settings, uint32_t passes,
                Guides& guides, const std::atomic<bool>* cancel) {
    const auto stopped = [&] { return cancel != nullptr && cancel->load(std::memory_order_relaxed); };
    parallel_for_each(view.extent.y, 4, [&](size_t row) {
        if (stopped()) return;
        const auto y = static_cast<uint16_t>(row);
        for (uint32_t x = 0; x < view.extent.x; ++x) {
            for (uint32_t index = guides.passes; index < passes; ++index) {
                const PathState path = begin_path(view, settings, {static_cast<uint16_t>(x), y, index});
                RayCounts counts;
                guides.add(static_cast<int>(x), y, guide_of(world, path, extend(world, path, counts)));
            }
        }
    });
    guides.passes = std::max(guides.passes, passes);
    return !stopped();
}

}  // namespace candela
