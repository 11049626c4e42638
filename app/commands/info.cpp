// SPDX-License-Identifier: MIT
// candela info: what a file holds, and what becomes of it.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/motion_facts.h"
#include "app/scene_facts.h"
#include "renderer/io/load_gltf.h"

namespace candela {

namespace {

using OrderedJson = nlohmann::ordered_json;

// Longer lists are cut without -v.
constexpr size_t short_list = 40;
// Deeper nodes are not indented further: chains may be thousands of nodes long.
constexpr size_t deepest_indent = 24;

std::string text_of(const OrderedJson& value) {
    return value.get<std::string>();
}

// The name in quotes, or the number where there is none.
std::string named(const std::string& name, const char* kind, uint64_t index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} \"{}\"", kind, name);
}

class Printer {
  public:
    Printer(const OrderedJson& facts, const Scene& scene, bool all)
        : facts_(facts), scene_(scene), limit_(all ? std::numeric_limits<size_t>::max() : short_list) {}

    void print() {
        fmt::print("{}\n", scene_.source);
        print_counts();
        print_choices("scene", "scenes", scene_.scene_names, scene_.active_scene);
        print_choices("variant", "variants", scene_.variant_names, scene_.active_variant);
        print_cameras_and_lights();
        print_motion(facts_, limit_);
        print_extensions();
        print_metadata();
        print_tree();
        for (const auto& warning : facts_["warnings"])
            fmt::print("warning: {}: {}\n", text_of(warning["where"]), text_of(warning["message"]));
    }

  private:
    void print_counts() const {
        for (const auto& [name, count] : facts_["counts"].items()) {
            if (count != 0) fmt::print("  {:<12} {}\n", name, count.get<uint64_t>());
        }
        fmt::print("  {:<12} {} ({} as placed)\n", "triangles", facts_["triangles"].get<uint64_t>(),
                   facts_["placed_triangles"].get<uint64_t>());
        if (scene_.strokes.width_m > 0) {
            fmt::print("  {:<12} {} points and {} segments of lines, drawn {:.3g} m thick\n", "strokes",
                       scene_.strokes.points, scene_.strokes.segments, scene_.strokes.width_m);
        }
        const OrderedJson& bytes = facts_["estimated_bytes"];
        const auto megabytes = [&](const char* part) { return bytes[part].get<double>() * 1e-6; };
        fmt::print("  {:<12} about {:.1f} MB (vertices {:.1f}, images {:.1f}, accelerator {:.1f})\n", "memory",
                   megabytes("total"), megabytes("vertices"), megabytes("images"), megabytes("accelerator"));
        const Bounds3 bounds = bounds_of(scene_);
        if (!bounds.empty()) {
            fmt::print("  {:<12} {:.4g},{:.4g},{:.4g} to {:.4g},{:.4g},{:.4g} m\n", "bounds", bounds.lower.x,
                       bounds.lower.y, bounds.lower.z, bounds.upper.x, bounds.upper.y, bounds.upper.z);
        }
    }

    // Files with one scene or no variant have no choice.
    void print_choices(const char* kind, const char* title, const std::vector<std::string>& names,
                       std::optional<uint32_t> active) const {
        const bool is_choice = std::string_view(kind) == "scene" ? names.size() > 1 : !names.empty();
        if (!is_choice) return;
        fmt::print("{}\n", title);
        for (size_t i = 0; i < names.size() && i < limit_; ++i)
            fmt::print("  {}: {}{}\n", i, named(names[i], kind, i), active == i ? ", shown" : "");
        print_rest(names.size());
    }

    void print_cameras_and_lights() const {
        const OrderedJson& cameras = facts_["cameras"];
        if (!cameras.empty()) fmt::print("cameras\n");
        for (size_t i = 0; i < cameras.size() && i < limit_; ++i) {
            const OrderedJson& camera = cameras[i];
            const std::string size = camera.contains("yfov_degrees")
                                         ? fmt::format("{:.4g}°", camera["yfov_degrees"].get<double>())
                                         : fmt::format("{:.4g} m high", camera["height_m"].get<double>());
            fmt::print("  {}: {}, {} {}\n", i, named(text_of(camera["name"]), "camera", i),
                       text_of(camera["projection"]), size);
        }
        print_rest(cameras.size());
        const OrderedJson& lights = facts_["lights"];
        if (!lights.empty()) fmt::print("lights\n");
        for (size_t i = 0; i < lights.size() && i < limit_; ++i) {
            const OrderedJson& light = lights[i];
            fmt::print("  {}: {}, {} {:.4g} {}\n", i, named(text_of(light["name"]), "light", i), text_of(light["kind"]),
                       light["intensity"].get<double>(), text_of(light["unit"]));
        }
        print_rest(lights.size());
    }

    void print_extensions() const {
        if (!scene_.extensions.empty()) fmt::print("extensions\n");
        for (const OrderedJson& use : facts_["extensions"]) {
            const std::string how = text_of(use["how"]);
            fmt::print("  {}: {}{}{}\n", text_of(use["name"]), text_of(use["treatment"]),
                       how.empty() ? "" : " (" + how + ")", use["required"].get<bool>() ? ", required" : "");
        }
    }

    void print_metadata() const {
        if (!scene_.metadata.empty()) fmt::print("metadata\n");
        for (size_t i = 0; i < scene_.metadata.size() && i < limit_; ++i) {
            const MetadataEntry& entry = scene_.metadata[i];
            fmt::print("  {} {}: {}\n", entry.where, entry.key, entry.value);
        }
        print_rest(scene_.metadata.size());
    }

    std::string describe(NodeId id) const {
        const Node& node = scene_.nodes[id.value];
        std::string out = node.name.empty() ? fmt::format("node {}", id.value) : node.name;
        if (node.mesh.valid()) {
            const Mesh& mesh = scene_.mesh(node.mesh);
            uint64_t triangles = 0;
            for (const Primitive& primitive : mesh.primitives)
                triangles += primitive.triangles.size();
            out += fmt::format("  {} ({} primitive{}, {} triangles)", named(mesh.name, "mesh", node.mesh.value),
                               mesh.primitives.size(), mesh.primitives.size() == 1 ? "" : "s", triangles);
        }
        if (node.node_from_instance) out += fmt::format(" × {}", node.node_from_instance->size());
        if (node.light.valid()) {
            out += "  " + named(scene_.lights[node.light.value].name, "light", node.light.value);
        }
        if (node.camera.valid()) {
            out += "  " + named(scene_.file_cameras[node.camera.value].name, "camera", node.camera.value);
        }
        return out + (node.visible ? "" : "  hidden");
    }

    // Depth first in the order of the file, with an own stack.
    void print_tree() const {
        fmt::print("nodes\n");
        std::vector<std::pair<NodeId, size_t>> stack;
        for (auto root = scene_.roots.rbegin(); root != scene_.roots.rend(); ++root)
            stack.emplace_back(*root, 0);
        std::vector<uint8_t> seen(scene_.nodes.size(), 0);
        size_t printed = 0;
        while (!stack.empty()) {
            const auto [id, depth] = stack.back();
            stack.pop_back();
            if (seen[id.value] != 0) continue;
            seen[id.value] = 1;
            if (printed++ < limit_) {
                fmt::print("  {}{}\n", std::string(2 * std::min(depth, deepest_indent), ' '), describe(id));
            }
            const std::vector<NodeId>& children = scene_.nodes[id.value].children;
            for (auto child = children.rbegin(); child != children.rend(); ++child)
                stack.emplace_back(*child, depth + 1);
        }
        print_rest(printed);
        const size_t elsewhere = scene_.nodes.size() - printed;
        if (elsewhere > 0) fmt::print("  {} nodes are not in this scene\n", elsewhere);
    }

    void print_rest(size_t count) const {
        if (count > limit_) fmt::print("  … and {} more; -v lists all\n", count - limit_);
    }

    const OrderedJson& facts_;
    const Scene& scene_;
    size_t limit_;
};

}  // namespace

ExitStatus run_info(const InfoOptions& options) {
    Diagnostics diagnostics;
    LoadOptions load;
    static_cast<LoadLimits&>(load) = options.limits;
    load.decode_images = false;
    load.measure_images = true;
    load.list_refused = true;
    load.scene = options.scene_index;
    load.variant = options.variant;
    try {
        const Scene scene = load_gltf(options.scene, diagnostics, load);
        const OrderedJson facts = describe_scene(scene, diagnostics);
        if (options.json) {
            fmt::print("{}\n", facts.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
        } else {
            Printer(facts, scene, options.verbose).print();
        }
        for (const ExtensionUse& use : scene.extensions) {
            if (use.treatment == ExtensionUse::Treatment::refused) {
                throw CommandError(ExitStatus::unreadable_scene,
                                   fmt::format("{}: the required extension {} is not supported; export the scene "
                                               "without it",
                                               options.scene, use.name));
            }
        }
    } catch (const ChoiceError& error) {
        throw CommandError(ExitStatus::wrong_usage, error.what());
    } catch (const LoadError& error) {
        throw CommandError(ExitStatus::unreadable_scene, error.what());
    }
    return ExitStatus::done;
}

}  // namespace candela
