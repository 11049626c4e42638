// SPDX-License-Identifier: MIT
#include "renderer/scene/scene.h"

namespace candela {

MaterialId material_of(const Scene& scene, const Primitive& primitive) {
    if (scene.active_variant) {
        for (const VariantMaterial& each : primitive.variants) {
            if (each.variant == *scene.active_variant) return each.material;
        }
    }
    return primitive.material;
}

Bounds3 bounds_of(const Scene& scene) {
    Bounds3 bounds;
    for (const Instance& instance : scene.instances) {
        for (const Primitive& primitive : scene.mesh(instance.mesh).primitives) {
            // Only vertices that a triangle uses count.
            for (const Vec3u& triangle : primitive.triangles) {
                for (int i = 0; i < 3; ++i) {
                    const Vec3 p(instance.world_from_object * Vec4(primitive.positions[triangle[i]], 1.0f));
                    if (is_finite(p)) bounds.extend(p);
                }
            }
        }
    }
    return bounds;
}

glm::mat3x2 compose_uv_transform(const UvTransform& transform) {
    const double c = std::cos(transform.rotation_radians), s = std::sin(transform.rotation_radians);
    const glm::dvec2 scale = transform.scale;
    return glm::mat3x2(
        glm::dmat3x2(c * scale.x, -s * scale.x, s * scale.y, c * scale.y, transform.offset.x, transform.offset.y));
}

namespace {

uint64_t triangles_of(const Mesh& mesh) {
    uint64_t count = 0;
    for (const Primitive& primitive : mesh.primitives)
        count += primitive.triangles.size();
    return count;
}

}  // namespace

uint64_t unique_triangle_count(const Scene& scene) {
    uint64_t count = 0;
    for (size_t m = 0; m < scene.meshes.size() - scene.posed_mesh_count; ++m)
        count += triangles_of(*scene.meshes[m]);
    return count;
}

uint64_t instanced_triangle_count(const Scene& scene) {
    uint64_t count = 0;
    for (const Instance& instance : scene.instances)
        count += triangles_of(scene.mesh(instance.mesh));
    return count;
}

}  // namespace candela
