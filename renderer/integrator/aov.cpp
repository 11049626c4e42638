// SPDX-License-Identifier: MIT
#include "renderer/integrator/aov.h"

#include "renderer/world/shaded_material.h"

namespace candela {

FirstHit trace_first_hit(const World& world, const View& view, const Vec2& film_uv) noexcept {
    FirstHit out;
    Camera pinhole = view.camera;
    pinhole.aperture_diameter_m = 0.0f;
    const Ray ray = generate_ray(pinhole, static_cast<float>(view.extent.x) / static_cast<float>(view.extent.y),
                                 film_uv, Vec2(0.5f));
    // A fixed seed decides at blended surfaces, so that asking twice gives the same answer.
    const Hit hit = world.accel->intersect(ray, 0);
    if (!hit.valid()) return out;
    const SurfacePoint point = make_surface_point(world, hit, -ray.direction);
    const ShadedMaterial material = shade_material(world, point, -ray.direction);
    out.hit = true;
    out.albedo =
        material.unlit ? material.emission : albedo(material.bsdf, point.shading.local_from_world(-ray.direction));
    out.normal = point.shading.normal;
    out.position = point.position;
    out.depth = glm::length(point.position - ray.origin);
    out.uv = point.uv[0];
    out.material = point.material;
    out.instance = world.surfaces[point.surface].instance;
    return out;
}

}  // namespace candela
