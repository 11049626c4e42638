// SPDX-License-Identifier: MIT
// Materials, textures and samplers of a file.
#pragma once

#include <array>

#include "renderer/io/load_context.h"

namespace tinygltf {
class Model;
}

namespace candela {

// Fills scene.textures (as many as the file has) and scene.materials. Factors out of range are clamped with a warning.
// Needs scene.images to be as long as the file's; a texture without a usable image is left out of the materials.
void load_materials(LoadContext& context, const tinygltf::Model& model, Scene& scene);

// The pointer to each textureInfo of material index that refs points to, in the order below.
inline constexpr size_t texture_slot_count = 5;
struct TextureSlot {
    TextureRef* ref;
    const char* member;  // "pbrMetallicRoughness/baseColorTexture"
};
std::array<TextureSlot, texture_slot_count> texture_slots(Material& material);

}  // namespace candela
