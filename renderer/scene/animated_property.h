// SPDX-License-Identifier: MIT
// What an animation can drive, named by the JSON pointer that KHR_animation_pointer uses.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace candela {

struct Scene;

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

std::span<const AnimatedProperty> animated_properties();

// By its pointer with *; null where nothing of that name can be animated.
const AnimatedProperty* find_animated_property(std::string_view pointer);

}  // namespace candela
