// SPDX-License-Identifier: MIT
#include "renderer/scene/pose.h"

#include "renderer/scene/animation.h"
#include "renderer/scene/place_nodes.h"

namespace candela {

void mark_moving_nodes(Scene& scene) {
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
}

std::vector<NodeId> pose_scene(Scene& scene, const Scene* like) {
    (void)like;
    return place_nodes(scene, world_from_nodes(scene));
}

std::shared_ptr<const Scene> posed_scene(const std::shared_ptr<const Scene>& rest, uint32_t animation, float time_s) {
    auto scene = std::make_shared<Scene>(*rest);
    std::vector<float> value;
    for (const AnimationChannel& channel : rest->animations[animation]->channels) {
        value.resize(channel.sampler.width);
        evaluate(channel.sampler, time_s, value);
        channel.property->apply(*scene, channel.object, value);
    }
    pose_scene(*scene, rest.get());
    return scene;
}

}  // namespace candela
