// SPDX-License-Identifier: MIT
#include "renderer/io/nodes.h"

#include "renderer/io/tinygltf.h"

namespace candela {
namespace {

using glm::dmat4;

// translation · rotation · scale (glTF 2.0, section 3.5.3).
dmat4 transform_of_parts(LoadContext& context, const tinygltf::Node& node, const std::string& where, Node& out) {
    dmat4 transform(1.0);
    if (!node.rotation.empty()) {
        const std::vector<double>& r = node.rotation;  // x y z w
        const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
        if (length > 1e-12) {
            const glm::dquat rotation(r[3] / length, r[0] / length, r[1] / length, r[2] / length);
            transform = glm::mat4_cast(rotation);
            out.rotation = Quat(rotation);
            if (std::abs(length - 1.0) > 1e-2) context.warn(where + "/rotation", "is not a unit quaternion");
        } else {
            context.warn(where + "/rotation", "is the zero quaternion; no rotation is used");
        }
    }
    for (int c = 0; c < 3 && !node.scale.empty(); ++c) {
        const double scale = node.scale[static_cast<size_t>(c)];
        transform[c] *= scale;
        out.scale[c] = static_cast<float>(scale);
    }
    for (int c = 0; c < 3 && !node.translation.empty(); ++c) {
        const double translation = node.translation[static_cast<size_t>(c)];
        transform[3][c] = translation;
        out.translation[c] = static_cast<float>(translation);
    }
    return transform;
}

dmat4 transform_of_matrix(LoadContext& context, const tinygltf::Node& node, const std::string& where) {
    dmat4 out(1.0);
    for (int i = 0; i < 16; ++i)
        out[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
    if (out[0][3] != 0.0 || out[1][3] != 0.0 || out[2][3] != 0.0 || out[3][3] != 1.0) {
        context.warn(where + "/matrix", "is not affine; its last row is taken as 0 0 0 1");
        out[0][3] = out[1][3] = out[2][3] = 0.0;
        out[3][3] = 1.0;
    }
    return out;
}

// Sets the parts to those of a matrix without shear; a mirrored one is mirrored along x.
void decompose(const dmat4& matrix, Node& out) {
    glm::dmat3 axes(matrix);
    for (int c = 0; c < 3; ++c) {
        const double length = glm::length(axes[c]);
        out.scale[c] = static_cast<float>(length);
        axes[c] = length > 0.0 ? axes[c] / length : glm::dmat3(1.0)[c];
    }
    if (glm::determinant(axes) < 0.0) {
        axes[0] = -axes[0];
        out.scale.x = -out.scale.x;
    }
    out.rotation = Quat(glm::normalize(glm::quat_cast(axes)));
    out.translation = Vec3(matrix[3]);
}

bool is_finite(const Mat4& m) {
    return candela::is_finite(Vec3(m[0])) && candela::is_finite(Vec3(m[1])) && candela::is_finite(Vec3(m[2])) &&
           candela::is_finite(Vec3(m[3]));
}

void load_transform(LoadContext& context, const tinygltf::Node& source, const std::string& where, Node& out) {
    out.is_matrix = !source.matrix.empty();
    const dmat4 transform =
        out.is_matrix ? transform_of_matrix(context, source, where) : transform_of_parts(context, source, where, out);
    if (out.is_matrix) decompose(transform, out);
    out.parent_from_node = Mat4(transform);
    if (!is_finite(out.parent_from_node)) context.fail(where, "its transform is not finite");
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
            context.fail_choice("/scenes", "scene " + std::to_string(*context.options().scene) +
                                               " was asked for, but the file has " + std::to_string(count) +
                                               (count == 1 ? " scene, 0" : " scenes, counted from 0"));
        }
        scene.active_scene = *context.options().scene;
    } else if (model.defaultScene >= 0) {
        scene.active_scene = static_cast<uint32_t>(model.defaultScene);
    }
    if (count == 0) context.warn("/scenes", "the file has no scene; all its nodes are shown");
}

void list_roots(LoadContext& context, const tinygltf::Model& model, Scene& scene) {
    if (model.scenes.empty()) {
        for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
            if (!scene.nodes[n].parent.valid()) scene.roots.push_back(NodeId{n});
        }
        return;
    }
    const std::vector<int>& listed = model.scenes[scene.active_scene].nodes;
    for (size_t i = 0; i < listed.size(); ++i) {
        const NodeId node{static_cast<uint32_t>(listed[i])};
        if (scene.nodes[node.value].parent.valid()) {
            context.warn(pointer_to("/scenes", scene.active_scene, "nodes", i),
                         "is not a root node; it is shown without its parents' transforms");
        }
        scene.roots.push_back(node);
    }
}

}  // namespace

void load_nodes(LoadContext& context, const tinygltf::Model& model, Scene& scene) {
    for (size_t n = 0; n < model.nodes.size(); ++n) {
        const tinygltf::Node& source = model.nodes[n];
        const std::string where = pointer_to("/nodes", n);
        Node& node = scene.nodes.emplace_back();
        node.name = source.name;
        load_transform(context, source, where, node);
        if (const tinygltf::Value* visibility = find_extension(source.extensions, "KHR_node_visibility")) {
            node.visible = !visibility->Has("visible") || visibility->Get("visible").Get<bool>();
        }
        if (source.mesh >= 0) node.mesh = MeshId{static_cast<uint32_t>(source.mesh)};
        if (source.camera >= 0) node.camera = CameraId{static_cast<uint32_t>(source.camera)};
        const tinygltf::Value* light = find_extension(source.extensions, "KHR_lights_punctual");
        if (light != nullptr && light->Has("light")) {
            node.light = LightId{static_cast<uint32_t>(light->Get("light").GetNumberAsInt())};
        }
        if (source.skin >= 0) node.skin = SkinId{static_cast<uint32_t>(source.skin)};
    }
    link_children(context, model, scene);
    choose_scene(context, model, scene);
    list_roots(context, model, scene);
}

}  // namespace candela
