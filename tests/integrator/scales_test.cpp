// SPDX-License-Identifier: MIT
// Scenes from a thousandth of a unit to a million units across, near the origin and far from it, read the same.
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/world/surface_point.h"
#include "tests/support/measure.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

using namespace test;

struct Place {
    float scale;
    Vec3 center;
    bool instanced;
};

const Place places[] = {{1e-3f, Vec3(0), false},
                        {1e-3f, Vec3(0), true},
                        {1, Vec3(0), false},
                        {1, Vec3(1e3f, -2e3f, 5e2f), false},
                        {1, Vec3(1e3f, -2e3f, 5e2f), true},
                        {1e3f, Vec3(1e5f, 0, -1e5f), false},
                        {1e6f, Vec3(0), false},
                        {1e6f, Vec3(3e6f, 1e6f, -2e6f), true}};

std::string describe(const Place& p) {
    return "scale " + std::to_string(p.scale) + " at " + std::to_string(p.center.x) + (p.instanced ? " instanced" : "");
}

Mat4 world_from_unit(const Place& place) {
    return glm::scale(glm::translate(Mat4(1), place.center), Vec3(place.scale));
}

Primitive faceted_sphere() {
    Primitive sphere = make_sphere(Vec3(0), 1, 48, 24);
    sphere.normals.clear();
    sphere.flat_normals = true;
    return sphere;
}

// Two placements make a mesh an instance; the second stands far aside.
void add_placed(Scene& scene, Primitive primitive, MaterialId material, const Place& place) {
    add_object(scene, std::move(primitive), material, world_from_unit(place));
    if (!place.instanced) return;
    Instance copy = scene.instances.back();
    copy.world_from_object = world_from_unit({place.scale, place.center + Vec3(0, 100 * place.scale, 0), true});
    scene.instances.push_back(copy);
}

TEST(Scales, NoRayMeetsTheTriangleThatItLeaves) {
    for (const Place& place : places) {
        Scene scene;
        add_placed(scene, faceted_sphere(), add_lambert(scene, Vec3(1)), place);
        const auto world = build(std::move(scene));
        Sampler sampler(SamplerKind::independent, Vec2u(0), 0, 1);
        int self_hits = 0;
        for (int i = 0; i < 20000; ++i) {
            // From outside onto the sphere, then off the surface in any direction above it.
            const Vec2 u = sampler.next_2d(), v = sampler.next_2d();
            const auto on_sphere = [](const Vec2& x) {
                const float z = 1 - 2 * x.x, r = safe_sqrt(1 - z * z);
                return Vec3(r * std::cos(2 * pi * x.y), r * std::sin(2 * pi * x.y), z);
            };
            const Vec3 from = place.center + 3.0f * place.scale * on_sphere(u);
            const Vec3 direction = glm::normalize(place.center + 0.9f * place.scale * on_sphere(v) - from);
            const Hit hit = world->accel->intersect({from, direction}, 0);
            if (!hit.valid()) continue;
            const SurfacePoint point = make_surface_point(*world, hit, -direction);
            Vec3 out = on_sphere(sampler.next_2d());
            if (glm::dot(out, point.geometric_normal) < 0) out = -out;
            const Ray ray{offset_ray_origin(point.position, point.geometric_normal, point.error_m), out};
            const Hit next = world->accel->intersect(ray, 0);
            // A convex body: nothing of it lies above any of its faces.
            if (next.valid() && next.distance < 3 * place.scale) ++self_hits;
        }
        EXPECT_EQ(self_hits, 0) << describe(place);
    }
}

TEST(Scales, FurnacesReadOne) {
    for (const Place& place : places) {
        Scene scene;
        add_placed(scene, faceted_sphere(), add_lambert(scene, Vec3(1)), place);
        scene.environment = constant_environment(Vec3(1));
        const auto world = build(std::move(scene));
        View view = look_at_point(place.center + place.scale * Vec3(0.3f, 0.2f, 5),
                                  place.center + place.scale * Vec3(0.3f, 0.2f, 0), Vec3(0, 1, 0));
        view.camera.ortho_half_height_m = 0.05f * place.scale;
        expect_exact(measure(*world, view, {}, 16, 4096), 1.0, 1e-3, describe(place));
    }
}

TEST(Scales, GlassBallsInFurnacesReadOne) {
    for (const Place& place : places) {
        Scene scene;
        Material glass;
        glass.metallic_factor = 0;
        glass.roughness_factor = 0;
        glass.transmission.factor = 1;
        glass.volume.thickness_factor = 1;
        scene.materials.push_back(glass);
        add_placed(scene, faceted_sphere(), {0}, place);
        scene.environment = constant_environment(Vec3(1));
        const auto world = build(std::move(scene));
        View view = look_at_point(place.center + place.scale * Vec3(0.3f, 0.2f, 5),
                                  place.center + place.scale * Vec3(0.3f, 0.2f, 0), Vec3(0, 1, 0));
        view.camera.ortho_half_height_m = 0.05f * place.scale;
        expect_exact(measure(*world, view, {}, 16, 4096), 1.0, 1e-3, describe(place));
    }
}

}  // namespace
}  // namespace candela
