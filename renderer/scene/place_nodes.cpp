// SPDX-License-Identifier: MIT
#include "renderer/scene/place_nodes.h"

namespace candela {
namespace {

using glm::dmat4;
using glm::dvec3;

bool is_finite(const Mat4& m) {
    return candela::is_finite(Vec3(m[0])) && candela::is_finite(Vec3(m[1])) && candela::is_finite(Vec3(m[2])) &&
           candela::is_finite(Vec3(m[3]));
}

// Right, up, back, orthonormal and right-handed whatever the node scales, mirrors or shears: the view axis is kept
// first, then the up axis as far as it can be.
Mat4 rigid(const Mat4& world_from_node) {
    const dmat4 m(world_from_node);
    dvec3 back(m[2]), up(m[1]);
    back = glm::length(back) > 1e-30 ? glm::normalize(back) : dvec3(0, 0, 1);
    up -= back * glm::dot(back, up);
    if (!(glm::length(up) > 1e-30)) {
        const dvec3 axis = std::abs(back.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
        up = axis - back * glm::dot(back, axis);
    }
    up = glm::normalize(up);
    const dvec3 right = glm::cross(up, back);
    return Mat4(Vec4(right, 0.0f), Vec4(up, 0.0f), Vec4(back, 0.0f), Vec4(Vec3(m[3]), 1.0f));
}

// Depth first in the order of the file, with an own stack: chains of nodes may be longer than the machine's. visit gets
// a node and whether it is the root.
template <typename Visit>
void walk(const Scene& scene, NodeId root, std::vector<uint8_t>& seen, const Visit& visit) {
    std::vector<NodeId> stack{root};
    while (!stack.empty()) {
        const NodeId id = stack.back();
        stack.pop_back();
        if (seen[id.value] != 0) continue;
        seen[id.value] = 1;
        visit(id, id == root);
        const std::vector<NodeId>& children = scene.nodes[id.value].children;
        stack.insert(stack.end(), children.rbegin(), children.rend());
    }
}

// Once, or as often as the node says; false where the transform of some instance is not finite.
bool place_mesh(Scene& scene, NodeId id, const dmat4& world_from_node) {
    const Node& node = scene.nodes[id.value];
    if (node.node_from_instance == nullptr) {
        scene.instances.push_back({node.mesh, id, Mat4(world_from_node), node.moves || node.reshapes, false});
        return true;
    }
    bool all_finite = true;
    for (const Mat4& node_from_instance : *node.node_from_instance) {
        const Mat4 world_from_instance(world_from_node * dmat4(node_from_instance));
        if (is_finite(world_from_instance)) {
            scene.instances.push_back({node.mesh, id, world_from_instance, node.moves || node.reshapes, false});
        } else {
            all_finite = false;
        }
    }
    return all_finite;
}

}  // namespace

Mat4 compose_transform(const Vec3& translation, const Quat& rotation, const Vec3& scale) {
    dmat4 out = glm::mat4_cast(glm::normalize(glm::dquat(rotation)));
    for (int c = 0; c < 3; ++c)
        out[c] *= static_cast<double>(scale[c]);
    out[3] = glm::dvec4(dvec3(translation), 1.0);
    return Mat4(out);
}

std::vector<dmat4> world_from_nodes(const Scene& scene) {
    std::vector<dmat4> out(scene.nodes.size(), dmat4(1.0));
    std::vector<uint8_t> seen(scene.nodes.size(), 0);
    const auto place = [&](NodeId id, bool is_root) {
        const Node& node = scene.nodes[id.value];
        const dmat4 own(node.parent_from_node);
        out[id.value] = is_root ? own : out[node.parent.value] * own;
    };
    for (const NodeId root : scene.roots)
        walk(scene, root, seen, place);
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        if (!scene.nodes[n].parent.valid()) walk(scene, NodeId{n}, seen, place);
    }
    return out;
}

std::vector<NodeId> place_nodes(Scene& scene, const std::vector<dmat4>& world_from_node) {
    std::vector<NodeId> not_finite;
    std::vector<uint8_t> seen(scene.nodes.size(), 0), hidden(scene.nodes.size(), 0);
    scene.instances.clear();
    scene.light_instances.clear();
    scene.cameras.clear();
    const auto place = [&](NodeId id, bool is_root) {
        Node& node = scene.nodes[id.value];
        node.in_active_scene = true;
        hidden[id.value] = !node.visible || (!is_root && hidden[node.parent.value] != 0) ? 1 : 0;
        const bool has_mesh = node.mesh.valid() && !scene.mesh(node.mesh).primitives.empty();
        if (!has_mesh && !node.light.valid() && !node.camera.valid()) return;
        const Mat4 world_from_this(world_from_node[id.value]);
        if (!is_finite(world_from_this)) {
            not_finite.push_back(id);
            return;
        }
        // What is hidden is neither drawn nor shines, but a camera sees from there.
        if (hidden[id.value] == 0) {
            if (has_mesh && !place_mesh(scene, id, world_from_node[id.value])) not_finite.push_back(id);
            if (node.light.valid()) scene.light_instances.push_back({node.light, id, world_from_this});
        }
        if (node.camera.valid()) {
            const FileCamera& source = scene.file_cameras[node.camera.value];
            scene.cameras.push_back({source.name.empty() ? node.name : source.name, id, source.camera});
            scene.cameras.back().camera.world_from_camera = rigid(world_from_this);
        }
    };
    for (const NodeId root : scene.roots)
        walk(scene, root, seen, place);
    return not_finite;
}

}  // namespace candela
