// SPDX-License-Identifier: MIT
// The part of animated_property.h that concerns materials.
#pragma once

#include "renderer/scene/animated_property.h"
#include "renderer/scene/scene.h"

namespace candela {

std::span<const AnimatedProperty> animated_material_properties();

// The textures whose transforms can be animated, by the pointer of their textureInfo from the material on.
struct TextureSlotPlace {
    std::string_view pointer;
    TextureRef& (*ref)(Material& material);
};
std::span<const TextureSlotPlace> animated_texture_slots();

}  // namespace candela
