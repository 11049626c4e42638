// SPDX-License-Identifier: MIT
#include "renderer/scene/animated_property.h"

#include <algorithm>

#include "renderer/scene/place_nodes.h"

namespace candela {
namespace {

using Owner = AnimatedProperty::Owner;
using Value = std::span<const float>;

Vec3 vec3(Value v) {
    return {v[0], v[1], v[2]};
}

void recompose(Node& node) {
    node.parent_from_node = compose_transform(node.translation, node.rotation, node.scale);
}

constexpr AnimatedProperty properties[] = {
    {"/nodes/*/translation", Owner::node, 3, false, true,
     [](Scene& scene, uint32_t i, Value v) {
         scene.nodes[i].translation = vec3(v);
         recompose(scene.nodes[i]);
     }},
    {"/nodes/*/rotation", Owner::node, 4, true, true,
     [](Scene& scene, uint32_t i, Value v) {
         scene.nodes[i].rotation = Quat(v[3], v[0], v[1], v[2]);
         recompose(scene.nodes[i]);
     }},
    {"/nodes/*/scale", Owner::node, 3, false, true,
     [](Scene& scene, uint32_t i, Value v) {
         scene.nodes[i].scale = vec3(v);
         recompose(scene.nodes[i]);
     }},
    {"/nodes/*/extensions/KHR_node_visibility/visible", Owner::node, 1, false, true,
     [](Scene& scene, uint32_t i, Value v) { scene.nodes[i].visible = v[0] > 0.5f; }},
};

}  // namespace

std::span<const AnimatedProperty> animated_properties() {
    return properties;
}

const AnimatedProperty* find_animated_property(std::string_view pointer) {
    const auto* found = std::find_if(std::begin(properties), std::end(properties),
                                     [&](const AnimatedProperty& property) { return property.pointer == pointer; });
    return found == std::end(properties) ? nullptr : found;
}

}  // namespace candela
