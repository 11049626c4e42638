// SPDX-License-Identifier: MIT
#include "tests/support/scenes.h"

namespace candela::test {

MaterialId add_lambert(Scene& scene, const Vec3& albedo) {
    Material material;
    material.base_color_factor = Vec4(albedo, 1.0f);
    material.metallic_factor = 0.0f;
    material.roughness_factor = 1.0f;
    material.specular.factor = 0.0f;
    scene.materials.push_back(material);
    return {static_cast<uint32_t>(scene.materials.size() - 1)};
}

MaterialId add_emitter(Scene& scene, const Vec3& radiance, const Vec3& albedo, bool double_sided) {
    const MaterialId id = add_lambert(scene, albedo);
    Material& material = scene.materials[id.value];
    material.emissive_factor = radiance;
    material.double_sided = double_sided;
    return id;
}

Primitive make_quad(const Vec3& origin, const Vec3& a, const Vec3& b) {
    Primitive out;
    out.positions = {origin, origin + a, origin + a + b, origin + b};
    out.uv[0] = {Vec2(0, 1), Vec2(1, 1), Vec2(1, 0), Vec2(0, 0)};
    out.triangles = {Vec3u(0, 1, 2), Vec3u(0, 2, 3)};
    out.flat_normals = true;
    return out;
}

Primitive make_sphere(const Vec3& center, float radius, int longitudes, int latitudes, bool inside_out) {
    Primitive out;
    for (int j = 0; j <= latitudes; ++j) {
        for (int i = 0; i <= longitudes; ++i) {
            const float theta = pi * static_cast<float>(j) / static_cast<float>(latitudes);
            const float phi = 2.0f * pi * static_cast<float>(i % longitudes) / static_cast<float>(longitudes);
            const Vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
            out.positions.push_back(center + radius * n);
            out.normals.push_back(inside_out ? -n : n);
            out.uv[0].emplace_back(static_cast<float>(i) / static_cast<float>(longitudes),
                                   static_cast<float>(j) / static_cast<float>(latitudes));
        }
    }
    const auto index = [&](int i, int j) { return static_cast<uint32_t>(j * (longitudes + 1) + i); };
    for (int j = 0; j < latitudes; ++j) {
        for (int i = 0; i < longitudes; ++i) {
            Vec3u lower(index(i, j), index(i, j + 1), index(i + 1, j + 1));
            Vec3u upper(index(i, j), index(i + 1, j + 1), index(i + 1, j));
            if (inside_out) {
                std::swap(lower.y, lower.z);
                std::swap(upper.y, upper.z);
            }
            if (j + 1 < latitudes) out.triangles.push_back(lower);
            if (j > 0) out.triangles.push_back(upper);
        }
    }
    return out;
}

void add_object(Scene& scene, Primitive primitive, MaterialId material, const Mat4& world_from_object) {
    primitive.material = material;
    Mesh mesh;
    mesh.primitives.push_back(std::move(primitive));
    scene.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
    Node node;
    node.mesh = {static_cast<uint32_t>(scene.meshes.size() - 1)};
    node.in_active_scene = true;
    node.parent_from_node = world_from_object;
    scene.nodes.push_back(node);
    scene.roots.push_back({static_cast<uint32_t>(scene.nodes.size() - 1)});
    scene.instances.push_back({node.mesh, {static_cast<uint32_t>(scene.nodes.size() - 1)}, world_from_object});
}

Environment constant_environment(const Vec3& radiance) {
    Environment out;
    out.radiance = ImageRgb32f(1, 1, radiance);
    return out;
}

std::shared_ptr<const World> build(Scene scene) {
    return build_world(std::make_shared<const Scene>(std::move(scene)));
}

}  // namespace candela::test
