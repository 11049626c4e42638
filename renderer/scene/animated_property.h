// SPDX-License-Identifier: MIT
// What an animation can drive, named by the JSON pointer that KHR_animation_pointer uses.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace candela {

struct Scene;
struct AnimationChannel;

struct AnimatedProperty {
    enum class Owner : uint8_t { node, mesh, material, texture_transform, light, camera };

    std::string_view pointer;  // with * where the owner's index stands
    Owner owner = Owner::node;
    uint32_t width = 1;  // numbers of a value; 0: one for each morph target
    bool is_rotation = false;
    bool moves_nodes = false;  // changes where things are, or whether they are shown
    // Puts the value into the scene; object: the owner's index, in range. Values out of the property's own range are
    // clamped.
    void (*apply)(Scene& scene, uint32_t object, std::span<const float> value) = nullptr;
};

// What a pointer names, with the index that stands in it.
struct PropertyMatch {
    const AnimatedProperty* property = nullptr;
    // Of the node, material, …; of a texture transform: the material's. Not checked against any scene.
    uint32_t object = 0;
    uint32_t texture_slot = 0;
};

// Nothing where a pointer names nothing that can be animated.
std::optional<PropertyMatch> find_animated_property(std::string_view pointer);

// The pointer of what the channel drives.
std::string pointer_of(const AnimationChannel& channel, const Scene& scene);

}  // namespace candela
