// SPDX-License-Identifier: MIT
// Materials, textures and samplers of a file.
#pragma once

#include <optional>
#include <vector>

#include "renderer/io/load_context.h"

namespace tinygltf {
class Model;
}

namespace candela {

// Fills scene.textures (as many as the file has) and scene.materials. Factors out of range are clamped with a warning.
// Needs scene.images to be as long as the file's; a texture without a usable image is left out of the materials.
void load_materials(LoadContext& context, const tinygltf::Model& model, Scene& scene);

// The textures that a material uses.
struct TextureSlot {
    const TextureRef* ref;
    const char* name;
    bool color = false;  // sRGB colours; false: plain numbers
};
std::vector<TextureSlot> texture_slots(const Material& material);

// The texture coordinates along which the material's tangents run; nothing where it needs none.
std::optional<uint32_t> tangent_uv_set(const Material& material);

}  // namespace candela
