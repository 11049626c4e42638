// SPDX-License-Identifier: MIT
// candela info: what a file holds, and what becomes of it.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "renderer/io/load_gltf.h"
#include "renderer/scene/animation.h"

namespace candela {

namespace {

using OrderedJson = nlohmann::ordered_json;

const char* word_for(ExtensionUse::Treatment treatment) {
    switch (treatment) {
        case ExtensionUse::Treatment::rendered:
            return "rendered";
        case ExtensionUse::Treatment::approximated:
            return "approximated";
        case ExtensionUse::Treatment::ignored:
            return "ignored";
        case ExtensionUse::Treatment::refused:
            return "refused";
    }
    return "";
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

OrderedJson describe(const Scene& scene, const Diagnostics& diagnostics) {
    OrderedJson out;
    out["scene"] = scene.source;
    out["scenes"] = scene.scene_names;
    out["active_scene"] = scene.active_scene;
    out["counts"] = {{"nodes", scene.nodes.size()},          {"meshes", scene.meshes.size() - scene.posed_mesh_count},
                     {"materials", scene.materials.size()},  {"textures", scene.textures.size()},
                     {"images", scene.images.size()},        {"instances", scene.instances.size()},
                     {"cameras", scene.cameras.size()},      {"lights", scene.light_instances.size()},
                     {"animations", scene.animations.size()}};
    out["triangles"] = unique_triangle_count(scene);
    out["placed_triangles"] = instanced_triangle_count(scene);
    out["vertex_bytes"] = vertex_bytes(scene);
    const Bounds3 bounds = bounds_of(scene);
    if (!bounds.empty()) {
        out["bounds"] = {{bounds.lower.x, bounds.lower.y, bounds.lower.z},
                         {bounds.upper.x, bounds.upper.y, bounds.upper.z}};
    }
    out["cameras"] = OrderedJson::array();
    for (const CameraInstance& camera : scene.cameras) {
        out["cameras"].push_back({{"name", camera.name}, {"projection", name_of(camera.camera.projection)}});
    }
    out["animations"] = OrderedJson::array();
    for (const std::shared_ptr<const Animation>& animation : scene.animations)
        out["animations"].push_back(animation->name);
    out["extensions"] = OrderedJson::array();
    for (const ExtensionUse& use : scene.extensions) {
        out["extensions"].push_back(
            {{"name", use.name}, {"required", use.required}, {"treatment", word_for(use.treatment)}, {"how", use.how}});
    }
    out["warnings"] = OrderedJson::array();
    for (const Diagnostic& warning : diagnostics.warnings()) {
        out["warnings"].push_back({{"where", warning.where}, {"message", warning.message}});
    }
    return out;
}

void print_tree(const Scene& scene, NodeId id, int depth) {
    const Node& node = scene.nodes[id.value];
    const std::string name = node.name.empty() ? fmt::format("node {}", id.value) : node.name;
    std::string holds;
    if (node.mesh.valid()) {
        const Mesh& mesh = scene.mesh(node.mesh);
        holds = fmt::format("  mesh {} ({} primitives)",
                            mesh.name.empty() ? std::to_string(node.mesh.value) : mesh.name, mesh.primitives.size());
    }
    fmt::print("  {}{}{}\n", std::string(static_cast<size_t>(2 * depth), ' '), name, holds);
    for (const NodeId child : node.children)
        print_tree(scene, child, depth + 1);
}

void print_text(const OrderedJson& facts, const Scene& scene) {
    fmt::print("{}\n", scene.source);
    for (const auto& [name, count] : facts["counts"].items()) {
        if (count != 0) fmt::print("  {:<12} {}\n", name, count.get<uint64_t>());
    }
    fmt::print("  {:<12} {} ({} as placed)\n", "triangles", facts["triangles"].get<uint64_t>(),
               facts["placed_triangles"].get<uint64_t>());
    fmt::print("  {:<12} {:.1f} MB\n", "vertex data", facts["vertex_bytes"].get<double>() * 1e-6);
    if (scene.strokes.width_m > 0) {
        fmt::print("  {:<12} {} points and {} segments of lines, drawn {:.3g} m thick\n", "strokes",
                   scene.strokes.points, scene.strokes.segments, scene.strokes.width_m);
    }
    const Bounds3 bounds = bounds_of(scene);
    if (!bounds.empty()) {
        fmt::print("  {:<12} {:.4g},{:.4g},{:.4g} to {:.4g},{:.4g},{:.4g} m\n", "bounds", bounds.lower.x,
                   bounds.lower.y, bounds.lower.z, bounds.upper.x, bounds.upper.y, bounds.upper.z);
    }
    for (size_t i = 0; i < scene.cameras.size(); ++i)
        fmt::print("  camera {}     {}\n", i, scene.cameras[i].name);
    if (!scene.extensions.empty()) fmt::print("extensions\n");
    for (const ExtensionUse& use : scene.extensions) {
        fmt::print("  {}: {}{}{}\n", use.name, word_for(use.treatment), use.how.empty() ? "" : " (" + use.how + ")",
                   use.required ? ", required" : "");
    }
    fmt::print("nodes\n");
    for (uint32_t i = 0; i < scene.nodes.size(); ++i) {
        if (!scene.nodes[i].parent.valid() && scene.nodes[i].in_active_scene) print_tree(scene, {i}, 0);
    }
    for (const auto& warning : facts["warnings"]) {
        fmt::print("warning: {}: {}\n", warning["where"].get<std::string>(), warning["message"].get<std::string>());
    }
}

}  // namespace

ExitStatus run_info(const InfoOptions& options) {
    Diagnostics diagnostics;
    LoadOptions load;
    load.decode_images = false;
    load.scene = options.scene_index;
    load.variant = options.variant;
    try {
        const Scene scene = load_gltf(options.scene, diagnostics, load);
        const OrderedJson facts = describe(scene, diagnostics);
        if (options.json) {
            fmt::print("{}\n", facts.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
        } else {
            print_text(facts, scene);
        }
    } catch (const ChoiceError& error) {
        throw CommandError(ExitStatus::wrong_usage, error.what());
    } catch (const LoadError& error) {
        throw CommandError(ExitStatus::unreadable_scene, error.what());
    }
    return ExitStatus::done;
}

}  // namespace candela
