// SPDX-License-Identifier: MIT
#include "renderer/scene/pose.h"

#include <unordered_map>

#include "renderer/scene/animation.h"
#include "renderer/scene/deform.h"
#include "renderer/scene/place_nodes.h"

namespace candela {
namespace {

using glm::dmat4;

MeshPose mesh_pose(const Scene& scene, const Node& node, uint32_t index, const std::vector<dmat4>& world_from_node) {
    MeshPose out;
    out.morph_weights = node.morph_weights;
    out.skinned = node.skin.valid();
    if (!out.skinned) return out;
    out.world_from_mesh = Mat4(world_from_node[index]);
    const Skin& skin = *scene.skins[node.skin.value];
    out.world_from_joint.reserve(skin.joints.size());
    for (size_t j = 0; j < skin.joints.size(); ++j) {
        out.world_from_joint.emplace_back(world_from_node[skin.joints[j].value] * dmat4(skin.joint_from_mesh[j]));
    }
    return out;
}

// The posed meshes of a scene, by node.
class PosedMeshes {
  public:
    explicit PosedMeshes(const Scene* scene) : scene_(scene) {
        if (scene == nullptr) return;
        world_from_node_ = world_from_nodes(*scene);
        for (const Instance& instance : scene->instances) {
            if (instance.deforms) mesh_of_node_[instance.node.value] = scene->meshes[instance.mesh.value];
        }
    }

    // The node's, if it was posed so; else null.
    std::shared_ptr<const Mesh> find(NodeId node, const MeshPose& pose) const {
        const auto found = mesh_of_node_.find(node.value);
        if (found == mesh_of_node_.end()) return nullptr;
        const MeshPose own = mesh_pose(*scene_, scene_->nodes[node.value], node.value, world_from_node_);
        return own == pose ? found->second : nullptr;
    }

  private:
    const Scene* scene_;
    std::vector<dmat4> world_from_node_;
    std::unordered_map<uint32_t, std::shared_ptr<const Mesh>> mesh_of_node_;
};

// Null where it would not be finite.
std::shared_ptr<const Mesh> pose_mesh(const std::shared_ptr<const Mesh>& modelled, const MeshPose& pose) {
    if (pose.is_rest()) return modelled;
    std::optional<Mesh> deformed = deform(*modelled, pose);
    return deformed ? std::make_shared<const Mesh>(std::move(*deformed)) : nullptr;
}

void deform_instances(Scene& scene, const std::vector<dmat4>& world_from_node, const PosedMeshes& like,
                      std::vector<NodeId>& left_out) {
    std::vector<Instance> kept;
    kept.reserve(scene.instances.size());
    for (Instance instance : scene.instances) {
        const Node& node = scene.nodes[instance.node.value];
        if (!can_deform(scene.mesh(node.mesh), node.skin.valid())) {
            kept.push_back(instance);
            continue;
        }
        // A node that places its mesh several times deforms it once.
        if (!kept.empty() && kept.back().node == instance.node && kept.back().deforms) {
            kept.push_back(kept.back());
            if (!node.skin.valid()) kept.back().world_from_object = instance.world_from_object;
            continue;
        }
        const MeshPose pose = mesh_pose(scene, node, instance.node.value, world_from_node);
        std::shared_ptr<const Mesh> mesh = like.find(instance.node, pose);
        if (!mesh) mesh = pose_mesh(scene.meshes[node.mesh.value], pose);
        if (!mesh) {
            left_out.push_back(instance.node);
            continue;
        }
        instance.mesh = MeshId{static_cast<uint32_t>(scene.meshes.size())};
        instance.deforms = true;
        // Joints have brought the vertices into the world already.
        if (pose.skinned) instance.world_from_object = Mat4(1.0f);
        scene.meshes.push_back(std::move(mesh));
        ++scene.posed_mesh_count;
        kept.push_back(instance);
    }
    scene.instances = std::move(kept);
}

}  // namespace

void mark_moving_nodes(Scene& scene) {
    // What moves a node moves all that hangs from it.
    std::vector<NodeId> stack;
    for (const std::shared_ptr<const Animation>& animation : scene.animations) {
        for (const AnimationChannel& channel : animation->channels) {
            if (channel.property->moves_nodes) stack.push_back(NodeId{channel.object});
        }
    }
    while (!stack.empty()) {
        Node& node = scene.nodes[stack.back().value];
        stack.pop_back();
        if (node.moves) continue;
        node.moves = true;
        stack.insert(stack.end(), node.children.begin(), node.children.end());
    }
    // Joints and morph weights move only the vertices.
    for (Node& node : scene.nodes) {
        if (!node.skin.valid()) continue;
        for (const NodeId joint : scene.skins[node.skin.value]->joints)
            node.reshapes = node.reshapes || scene.nodes[joint.value].moves;
    }
    for (const std::shared_ptr<const Animation>& animation : scene.animations) {
        for (const AnimationChannel& channel : animation->channels) {
            if (channel.property->width != 0) continue;
            if (channel.property->owner == AnimatedProperty::Owner::node) {
                scene.nodes[channel.object].reshapes = true;
                continue;
            }
            for (Node& node : scene.nodes)
                node.reshapes = node.reshapes || node.mesh.value == channel.object;
        }
    }
}

std::vector<NodeId> pose_scene(Scene& scene, const Scene* like) {
    scene.meshes.resize(scene.meshes.size() - scene.posed_mesh_count);
    scene.posed_mesh_count = 0;
    const std::vector<dmat4> world_from_node = world_from_nodes(scene);
    std::vector<NodeId> left_out = place_nodes(scene, world_from_node);
    const bool any = std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
        return can_deform(scene.mesh(instance.mesh), scene.nodes[instance.node.value].skin.valid());
    });
    if (any) deform_instances(scene, world_from_node, PosedMeshes(like), left_out);
    return left_out;
}

std::shared_ptr<const Scene> posed_scene(const std::shared_ptr<const Scene>& rest, uint32_t animation, float time_s,
                                         std::vector<NodeId>* left_out, const Scene* like) {
    auto scene = std::make_shared<Scene>(*rest);
    std::vector<float> value;
    for (const AnimationChannel& channel : rest->animations[animation]->channels) {
        value.resize(channel.sampler.width);
        evaluate(channel.sampler, time_s, value);
        channel.property->apply(*scene, channel.object, value);
    }
    // A cone may not be wider inside than outside, whichever of both was driven first.
    for (PunctualLight& light : scene->lights)
        light.inner_cone_radians = std::min(light.inner_cone_radians, light.outer_cone_radians);
    std::vector<NodeId> lost = pose_scene(*scene, like != nullptr ? like : rest.get());
    if (left_out != nullptr) *left_out = std::move(lost);
    return scene;
}

}  // namespace candela
