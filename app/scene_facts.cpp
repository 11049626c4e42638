// SPDX-License-Identifier: MIT
#include "app/scene_facts.h"

#include "app/motion_facts.h"

#include <nlohmann/json.hpp>

namespace candela {

namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson list_of(const Vec3& v) {
    return {v.x, v.y, v.z};
}

template <typename Tag>
OrderedJson index_or_null(Id<Tag> id) {
    return id.valid() ? OrderedJson(id.value) : OrderedJson(nullptr);
}

const char* word_for(ExtensionUse::Treatment treatment) {
    constexpr const char* words[] = {"rendered", "approximated", "ignored", "refused"};
    return words[static_cast<size_t>(treatment)];
}

const char* word_for(LightKind kind) {
    constexpr const char* words[] = {"point", "spot", "directional"};
    return words[static_cast<size_t>(kind)];
}

const char* word_for(PrimitiveShape shape) {
    constexpr const char* words[] = {"triangles", "points", "lines"};
    return words[static_cast<size_t>(shape)];
}

uint64_t vertex_bytes(const Scene& scene) {
    uint64_t bytes = 0;
    for (const std::shared_ptr<const Mesh>& mesh : scene.meshes) {
        for (const Primitive& p : mesh->primitives) {
            bytes += p.positions.size() * sizeof(Vec3) + p.normals.size() * sizeof(Vec3) +
                     p.tangents.size() * sizeof(Vec4) + (p.uv[0].size() + p.uv[1].size()) * sizeof(Vec2) +
                     p.colors.size() * sizeof(Vec4) + p.triangles.size() * sizeof(Vec3u);
        }
    }
    return bytes;
}

// What rendering will take, roughly: Embree's trees of medium quality take 80 to 90 bytes a triangle.
OrderedJson estimate_memory(const Scene& scene) {
    constexpr uint64_t accelerator_bytes_per_triangle = 90, accelerator_bytes_per_instance = 500, bytes_per_pixel = 4;
    const uint64_t vertices = vertex_bytes(scene);
    uint64_t pixels = 0;
    for (const SceneImage& image : scene.images)
        pixels += image.pixel_count;
    // The accelerator has its own copy of the positions.
    uint64_t positions = 0;
    for (const std::shared_ptr<const Mesh>& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh->primitives)
            positions += primitive.positions.size() * sizeof(Vec3);
    }
    const uint64_t accelerator = unique_triangle_count(scene) * accelerator_bytes_per_triangle +
                                 scene.instances.size() * accelerator_bytes_per_instance + positions;
    const uint64_t images = pixels * bytes_per_pixel;
    return {{"vertices", vertices},
            {"images", images},
            {"accelerator", accelerator},
            {"total", vertices + images + accelerator}};
}

OrderedJson describe_nodes(const Scene& scene) {
    OrderedJson out = OrderedJson::array();
    for (const Node& node : scene.nodes) {
        OrderedJson entry = {{"name", node.name},
                             {"parent", index_or_null(node.parent)},
                             {"mesh", index_or_null(node.mesh)},
                             {"camera", index_or_null(node.camera)},
                             {"light", index_or_null(node.light)},
                             {"instances", node.node_from_instance ? node.node_from_instance->size() : 1},
                             {"visible", node.visible},
                             {"in_active_scene", node.in_active_scene},
                             {"children", OrderedJson::array()}};
        for (const NodeId child : node.children)
            entry["children"].push_back(child.value);
        out.push_back(std::move(entry));
    }
    return out;
}

OrderedJson describe_meshes(const Scene& scene) {
    OrderedJson out = OrderedJson::array();
    for (size_t m = 0; m + scene.posed_mesh_count < scene.meshes.size(); ++m) {
        OrderedJson primitives = OrderedJson::array();
        for (const Primitive& primitive : scene.meshes[m]->primitives) {
            primitives.push_back({{"shape", word_for(primitive.shape)},
                                  {"triangles", primitive.triangles.size()},
                                  {"vertices", primitive.positions.size()},
                                  {"material", index_or_null(material_of(scene, primitive))}});
        }
        out.push_back({{"name", scene.meshes[m]->name}, {"primitives", std::move(primitives)}});
    }
    return out;
}

OrderedJson describe_cameras(const Scene& scene) {
    OrderedJson out = OrderedJson::array();
    for (const CameraInstance& instance : scene.cameras) {
        const Camera& camera = instance.camera;
        OrderedJson entry = {{"name", instance.name}, {"projection", name_of(camera.projection)}};
        if (camera.projection == Projection::perspective) {
            entry["yfov_degrees"] = glm::degrees(camera.yfov_radians);
        } else {
            entry["height_m"] = 2 * camera.ortho_half_height_m;
        }
        entry["eye"] = list_of(camera.position());
        out.push_back(std::move(entry));
    }
    return out;
}

OrderedJson describe_lights(const Scene& scene) {
    OrderedJson out = OrderedJson::array();
    for (const LightInstance& instance : scene.light_instances) {
        const PunctualLight& light = scene.lights[instance.light.value];
        OrderedJson entry = {{"name", light.name},
                             {"kind", word_for(light.kind)},
                             {"color", list_of(light.color)},
                             {"intensity", light.intensity},
                             {"unit", light.kind == LightKind::directional ? "lx" : "cd"},
                             {"node", instance.node.value}};
        // The range is read but not applied.
        if (std::isfinite(light.range)) entry["range_m"] = light.range;
        out.push_back(std::move(entry));
    }
    return out;
}

}  // namespace

OrderedJson describe_scene(const Scene& scene, const Diagnostics& diagnostics) {
    OrderedJson out;
    out["scene"] = scene.source;
    out["scenes"] = scene.scene_names;
    out["active_scene"] = scene.active_scene;
    out["variants"] = scene.variant_names;
    out["active_variant"] =
        scene.active_variant ? OrderedJson(scene.variant_names[*scene.active_variant]) : OrderedJson(nullptr);
    out["counts"] = {{"nodes", scene.nodes.size()},           {"meshes", scene.meshes.size() - scene.posed_mesh_count},
                     {"materials", scene.materials.size()},   {"textures", scene.textures.size()},
                     {"images", scene.images.size()},         {"instances", scene.instances.size()},
                     {"cameras", scene.cameras.size()},       {"lights", scene.light_instances.size()},
                     {"animations", scene.animations.size()}, {"skins", scene.skins.size()}};
    out["triangles"] = unique_triangle_count(scene);
    out["placed_triangles"] = instanced_triangle_count(scene);
    out["strokes"] = {
        {"points", scene.strokes.points}, {"segments", scene.strokes.segments}, {"width_m", scene.strokes.width_m}};
    out["vertex_bytes"] = vertex_bytes(scene);
    out["estimated_bytes"] = estimate_memory(scene);
    const Bounds3 bounds = bounds_of(scene);
    if (!bounds.empty()) out["bounds"] = {list_of(bounds.lower), list_of(bounds.upper)};
    out["nodes"] = describe_nodes(scene);
    out["meshes"] = describe_meshes(scene);
    out["cameras"] = describe_cameras(scene);
    out["lights"] = describe_lights(scene);
    describe_motion(scene, out);
    out["extensions"] = OrderedJson::array();
    for (const ExtensionUse& use : scene.extensions) {
        out["extensions"].push_back(
            {{"name", use.name}, {"required", use.required}, {"treatment", word_for(use.treatment)}, {"how", use.how}});
    }
    out["metadata"] = OrderedJson::array();
    for (const MetadataEntry& entry : scene.metadata)
        out["metadata"].push_back({{"where", entry.where}, {"key", entry.key}, {"value", entry.value}});
    out["warnings"] = OrderedJson::array();
    for (const Diagnostic& warning : diagnostics.warnings())
        out["warnings"].push_back({{"where", warning.where}, {"message", warning.message}});
    return out;
}

}  // namespace candela
