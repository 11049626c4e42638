// SPDX-License-Identifier: MIT
#include "renderer/io/nodes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "renderer/io/tinygltf.h"

namespace candela {
namespace {

glm::dmat4 local_transform(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
    glm::dmat4 out(1.0);
    if (node.translation.size() == 3) out = glm::translate(out, glm::make_vec3(node.translation.data()));
    if (node.rotation.size() == 4) {
        glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        const double length = glm::length(q);
        if (length > 0 && std::isfinite(length)) out *= glm::mat4_cast(q / length);
    }
    if (node.scale.size() == 3) out = glm::scale(out, glm::make_vec3(node.scale.data()));
    return out;
}

PunctualLight read_light(const tinygltf::Light& source, LoadContext& context, const std::string& where) {
    PunctualLight out;
    out.name = source.name;
    if (source.color.size() == 3) out.color = Vec3(glm::make_vec3(source.color.data()));
    out.intensity = static_cast<float>(source.intensity);
    if (source.range > 0) out.range = static_cast<float>(source.range);
    if (source.type == "directional") {
        out.kind = LightKind::directional;
    } else if (source.type == "spot") {
        out.kind = LightKind::spot;
        out.inner_cone_radians = static_cast<float>(source.spot.innerConeAngle);
        out.outer_cone_radians = static_cast<float>(source.spot.outerConeAngle);
        if (!(out.inner_cone_radians >= 0.0f && out.inner_cone_radians < out.outer_cone_radians &&
              out.outer_cone_radians <= 0.5f * pi + 1e-4f)) {
            context.warn(where + "/spot", "cone angles must satisfy 0 <= inner < outer <= pi/2; they were clamped");
            out.outer_cone_radians = std::clamp(out.outer_cone_radians, 1e-3f, 0.5f * pi);
            out.inner_cone_radians = std::clamp(out.inner_cone_radians, 0.0f, out.outer_cone_radians - 1e-4f);
        }
    } else if (source.type != "point") {
        context.warn(where + "/type", "\"" + source.type.substr(0, 40) + "\" is no kind of light; it is left dark");
        out.intensity = 0.0f;
    }
    if (out.intensity < 0.0f || !std::isfinite(out.intensity)) {
        context.warn(where + "/intensity", "is negative or not finite; the light is left dark");
        out.intensity = 0.0f;
    }
    return out;
}

// The pose without scale or mirroring: a camera looks along its node's -Z whatever its node does to meshes.
std::optional<Camera> place_camera(const tinygltf::Camera& source, const Mat4& world_from_node) {
    Camera out;
    const Vec3 z(world_from_node[2]);
    const Vec3 y(world_from_node[1]);
    if (!(glm::length(z) > 0.0f) || !(glm::length(y) > 0.0f) || !is_finite(Vec3(world_from_node[3]))) return std::nullopt;
    const Vec3 eye(world_from_node[3]);
    out.world_from_camera = look_at(eye, eye - glm::normalize(z), y);
    out.world_from_camera[3] = Vec4(eye, 1.0f);
    if (source.type == "orthographic") {
        out.projection = Projection::orthographic;
        out.ortho_half_height_m = static_cast<float>(std::abs(source.orthographic.ymag));
        if (source.orthographic.ymag != 0) {
            out.aspect = static_cast<float>(std::abs(source.orthographic.xmag / source.orthographic.ymag));
        }
        if (!(out.ortho_half_height_m > 0.0f)) return std::nullopt;
    } else {
        out.yfov_radians = static_cast<float>(source.perspective.yfov);
        out.aspect = static_cast<float>(source.perspective.aspectRatio);
        if (!(out.yfov_radians > 1e-4f && out.yfov_radians < pi - 1e-3f)) return std::nullopt;
    }
    if (!(out.aspect > 0.0f) || !std::isfinite(out.aspect)) out.aspect = 0.0f;
    return out;
}

class TreeWalker {
  public:
    TreeWalker(LoadContext& context, const tinygltf::Model& model, Scene& scene)
        : context_(context), model_(model), scene_(scene) {}

    void read_tree();
    void flatten(const tinygltf::Scene& root, const std::string& where);

  private:
    void place(uint32_t index, const glm::dmat4& world_from_node);

    LoadContext& context_;
    const tinygltf::Model& model_;
    Scene& scene_;
};

void TreeWalker::read_tree() {
    for (const tinygltf::Node& source : model_.nodes) {
        Node node;
        node.name = source.name;
        node.parent_from_node = Mat4(local_transform(source));
        if (source.mesh >= 0) node.mesh = MeshId{static_cast<uint32_t>(source.mesh)};
        scene_.nodes.push_back(std::move(node));
    }
    for (uint32_t i = 0; i < model_.nodes.size(); ++i) {
        const std::vector<int>& children = model_.nodes[i].children;
        for (size_t k = 0; k < children.size(); ++k) {
            Node& child = scene_.nodes[static_cast<size_t>(children[k])];
            if (child.parent.valid()) {
                context_.fail(pointer_to(pointer_to("/nodes", i, "children"), k),
                              "node " + std::to_string(children[k]) + " has two parents");
            }
            child.parent = NodeId{i};
            scene_.nodes[i].children.push_back(NodeId{static_cast<uint32_t>(children[k])});
        }
    }
    // With one parent each, a walk upwards that is longer than the number of nodes goes in a circle. Nodes that are known to
    // lead to a root are not walked again.
    std::vector<bool> rooted(scene_.nodes.size(), false);
    for (uint32_t i = 0; i < scene_.nodes.size(); ++i) {
        std::vector<uint32_t> path;
        for (NodeId at{i}; at.valid() && !rooted[at.value]; at = scene_.nodes[at.value].parent) {
            path.push_back(at.value);
            if (path.size() > scene_.nodes.size()) context_.fail(pointer_to("/nodes", i), "is its own ancestor");
        }
        for (const uint32_t node : path) rooted[node] = true;
    }
}

void TreeWalker::place(uint32_t index, const glm::dmat4& world_from_node) {
    const tinygltf::Node& source = model_.nodes[index];
    const std::string where = pointer_to("/nodes", index);
    scene_.nodes[index].in_active_scene = true;
    const Mat4 placed(world_from_node);
    if (source.skin >= 0) context_.warn(where + "/skin", "skins are not applied; the mesh is shown in its bind pose");
    if (source.mesh >= 0) scene_.instances.push_back({MeshId{static_cast<uint32_t>(source.mesh)}, NodeId{index}, placed});
    if (source.camera >= 0) {
        const tinygltf::Camera& camera = model_.cameras[static_cast<size_t>(source.camera)];
        const std::string& name = camera.name.empty() ? source.name : camera.name;
        if (const std::optional<Camera> made = place_camera(camera, placed)) {
            scene_.cameras.push_back({name, NodeId{index}, *made});
        } else {
            context_.warn(where + "/camera", "the camera has no usable projection or pose and is left out");
        }
    }
    if (const tinygltf::Value* light = find_extension(source.extensions, "KHR_lights_punctual")) {
        const int id = light->Has("light") ? light->Get("light").GetNumberAsInt() : -1;
        if (id >= 0 && static_cast<size_t>(id) < scene_.lights.size()) {
            scene_.light_instances.push_back({LightId{static_cast<uint32_t>(id)}, NodeId{index}, placed});
        }
    }
}

void TreeWalker::flatten(const tinygltf::Scene& root, const std::string& where) {
    struct Visit {
        uint32_t node;
        glm::dmat4 world_from_parent;
    };
    std::vector<Visit> open;
    for (size_t k = root.nodes.size(); k-- > 0;) {
        const auto node = static_cast<uint32_t>(root.nodes[k]);
        if (scene_.nodes[node].parent.valid()) {
            context_.warn(pointer_to(where + "/nodes", k), "node " + std::to_string(node) + " has a parent, so it is no root of a scene");
        }
        open.push_back({node, glm::dmat4(1.0)});
    }
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        if (scene_.nodes[visit.node].in_active_scene) continue;
        const glm::dmat4 world_from_node = visit.world_from_parent * local_transform(model_.nodes[visit.node]);
        place(visit.node, world_from_node);
        const std::vector<NodeId>& children = scene_.nodes[visit.node].children;
        for (size_t k = children.size(); k-- > 0;) open.push_back({children[k].value, world_from_node});
    }
}

}  // namespace

void load_nodes(LoadContext& context, const tinygltf::Model& model, Scene& scene) {
    for (size_t i = 0; i < model.lights.size(); ++i) {
        scene.lights.push_back(read_light(model.lights[i], context, pointer_to("/extensions/KHR_lights_punctual/lights", i)));
    }
    TreeWalker walker(context, model, scene);
    walker.read_tree();

    // Choose the scene: the one asked for, the file's, the first; a file without scenes shows all its roots.
    for (const tinygltf::Scene& each : model.scenes) scene.scene_names.push_back(each.name);
    scene.active_scene = context.options().scene.value_or(
        model.defaultScene >= 0 ? static_cast<uint32_t>(model.defaultScene) : 0u);
    if (scene.active_scene < model.scenes.size()) {
        walker.flatten(model.scenes[scene.active_scene], pointer_to("/scenes", scene.active_scene));
        return;
    }
    if (context.options().scene && (!model.scenes.empty() || *context.options().scene != 0)) {
        context.fail("/scenes", "there is no scene " + std::to_string(*context.options().scene) + "; the file has " +
                                    std::to_string(model.scenes.size()));
    }
    tinygltf::Scene roots;
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        if (!scene.nodes[i].parent.valid()) roots.nodes.push_back(static_cast<int>(i));
    }
    walker.flatten(roots, "/scenes");
}

}  // namespace candela
