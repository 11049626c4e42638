// SPDX-License-Identifier: MIT
#include "renderer/io/nodes.h"

#include "renderer/io/tinygltf.h"

namespace candela {
namespace {

using glm::dmat4;
using glm::dvec3;

// translation · rotation · scale, or the matrix (glTF 2.0, section 3.5.3).
dmat4 local_transform(LoadContext& context, const tinygltf::Node& node, const std::string& where) {
    dmat4 out(1.0);
    if (!node.matrix.empty()) {
        for (int i = 0; i < 16; ++i)
            out[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
        if (out[0][3] != 0.0 || out[1][3] != 0.0 || out[2][3] != 0.0 || out[3][3] != 1.0) {
            context.warn(where + "/matrix", "is not affine; its last row is taken as 0 0 0 1");
            out[0][3] = out[1][3] = out[2][3] = 0.0;
            out[3][3] = 1.0;
        }
        return out;
    }
    if (!node.rotation.empty()) {
        const std::vector<double>& r = node.rotation;  // x y z w
        const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
        if (length > 1e-12) {
            out = glm::mat4_cast(glm::dquat(r[3] / length, r[0] / length, r[1] / length, r[2] / length));
            if (std::abs(length - 1.0) > 1e-2) context.warn(where + "/rotation", "is not a unit quaternion");
        } else {
            context.warn(where + "/rotation", "is the zero quaternion; no rotation is used");
        }
    }
    for (int c = 0; c < 3 && !node.scale.empty(); ++c)
        out[c] *= node.scale[static_cast<size_t>(c)];
    for (int c = 0; c < 3 && !node.translation.empty(); ++c)
        out[3][c] = node.translation[static_cast<size_t>(c)];
    return out;
}

bool is_finite(const Mat4& m) {
    return candela::is_finite(Vec3(m[0])) && candela::is_finite(Vec3(m[1])) && candela::is_finite(Vec3(m[2])) &&
           candela::is_finite(Vec3(m[3]));
}

// One parent each and no way back to where one came from, or walking would not end.
void link_children(LoadContext& context, const tinygltf::Model& model, Scene& scene) {
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        const std::vector<int>& children = model.nodes[n].children;
        for (size_t c = 0; c < children.size(); ++c) {
            const NodeId child{static_cast<uint32_t>(children[c])};
            Node& node = scene.nodes[child.value];
            if (node.parent.valid()) {
                context.fail(pointer_to("/nodes", n, "children", c),
                             pointer_to("/nodes", child.value) + " has two parents, this one and " +
                                 pointer_to("/nodes", node.parent.value) + "; nodes must form a tree");
            }
            node.parent = NodeId{n};
            scene.nodes[n].children.push_back(child);
        }
    }
    // Going up from each node, paths that were seen to end are not walked again.
    std::vector<uint32_t> seen_from(scene.nodes.size(), NodeId::none);
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        for (NodeId at{n}; at.valid(); at = scene.nodes[at.value].parent) {
            if (seen_from[at.value] == n) {
                context.fail(pointer_to("/nodes", at.value), "is its own ancestor; nodes must form a tree");
            }
            if (seen_from[at.value] != NodeId::none) break;
            seen_from[at.value] = n;
        }
    }
}

void choose_scene(LoadContext& context, const tinygltf::Model& model, Scene& scene) {
    for (const tinygltf::Scene& source : model.scenes)
        scene.scene_names.push_back(source.name);
    const size_t count = model.scenes.size();
    if (context.options().scene) {
        if (*context.options().scene >= count) {
            context.fail("/scenes", "scene " + std::to_string(*context.options().scene) +
                                        " was asked for, but the file has " + std::to_string(count));
        }
        scene.active_scene = *context.options().scene;
    } else if (model.defaultScene >= 0) {
        scene.active_scene = static_cast<uint32_t>(model.defaultScene);
    }
    if (count == 0) context.warn("/scenes", "the file has no scene; all its nodes are shown");
}

std::vector<uint32_t> root_nodes(LoadContext& context, const tinygltf::Model& model, const Scene& scene) {
    std::vector<uint32_t> roots;
    if (model.scenes.empty()) {
        for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
            if (!scene.nodes[n].parent.valid()) roots.push_back(n);
        }
        return roots;
    }
    const std::vector<int>& listed = model.scenes[scene.active_scene].nodes;
    for (size_t i = 0; i < listed.size(); ++i) {
        const auto node = static_cast<uint32_t>(listed[i]);
        if (scene.nodes[node].parent.valid()) {
            context.warn(pointer_to("/scenes", scene.active_scene, "nodes", i),
                         "is not a root node; it is shown without its parents' transforms");
        }
        roots.push_back(node);
    }
    return roots;
}

class Placer {
  public:
    Placer(LoadContext& context, const tinygltf::Model& model, Scene& scene)
        : context_(context), model_(model), scene_(scene) {}

    // Depth first in the order of the file, with an own stack: chains of nodes may be longer than the machine's.
    void walk(uint32_t root) {
        std::vector<std::pair<uint32_t, dmat4>> stack{{root, dmat4(1.0)}};
        while (!stack.empty()) {
            const auto [index, world_from_parent] = stack.back();
            stack.pop_back();
            Node& node = scene_.nodes[index];
            if (node.in_active_scene) continue;
            node.in_active_scene = true;
            const dmat4 world_from_node = world_from_parent * dmat4(node.parent_from_node);
            place(index, Mat4(world_from_node));
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
                stack.emplace_back(child->value, world_from_node);
        }
    }

  private:
    void place(uint32_t index, const Mat4& world_from_node) {
        const tinygltf::Node& source = model_.nodes[index];
        const Node& node = scene_.nodes[index];
        const std::string where = pointer_to("/nodes", index);
        const bool has_mesh = node.mesh.valid() && !scene_.meshes[node.mesh.value].primitives.empty();
        const tinygltf::Value* light = find_extension(source.extensions, "KHR_lights_punctual");
        if ((has_mesh || light != nullptr || source.camera >= 0) && !is_finite(world_from_node)) {
            context_.warn(where, "its transform in the world is not finite; what it holds is not shown");
            return;
        }
        if (has_mesh) scene_.instances.push_back({node.mesh, NodeId{index}, world_from_node});
        if (light != nullptr && light->Has("light")) {
            const auto id = static_cast<uint32_t>(light->Get("light").GetNumberAsInt());
            scene_.light_instances.push_back({LightId{id}, NodeId{index}, world_from_node});
        }
        if (source.camera >= 0) {
            const auto camera = static_cast<uint32_t>(source.camera);
            const std::string& own_name = model_.cameras[camera].name;
            scene_.cameras.push_back({own_name.empty() ? source.name : own_name, NodeId{index},
                                      make_camera(context_, model_, camera, world_from_node)});
        }
    }

    LoadContext& context_;
    const tinygltf::Model& model_;
    Scene& scene_;
};

}  // namespace

void load_nodes(LoadContext& context, const tinygltf::Model& model, Scene& scene) {
    bool has_skin = false;
    for (size_t n = 0; n < model.nodes.size(); ++n) {
        const tinygltf::Node& source = model.nodes[n];
        const std::string where = pointer_to("/nodes", n);
        Node& node = scene.nodes.emplace_back();
        node.name = source.name;
        node.parent_from_node = Mat4(local_transform(context, source, where));
        if (!is_finite(node.parent_from_node)) context.fail(where, "its transform is not finite");
        if (source.mesh >= 0) node.mesh = MeshId{static_cast<uint32_t>(source.mesh)};
        if (source.skin >= 0 && !has_skin) {
            context.warn(where + "/skin", "skins are ignored; meshes are shown as modelled");
            has_skin = true;
        }
    }
    link_children(context, model, scene);
    choose_scene(context, model, scene);
}

void place_nodes(LoadContext& context, const tinygltf::Model& model, Scene& scene) {
    Placer placer(context, model, scene);
    for (const uint32_t root : root_nodes(context, model, scene))
        placer.walk(root);
}

}  // namespace candela
