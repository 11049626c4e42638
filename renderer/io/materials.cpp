// SPDX-License-Identifier: MIT
#include "renderer/io/materials.h"

#include "renderer/io/material_layers.h"

namespace candela {
namespace {

class MaterialLoader {
  public:
    MaterialLoader(LoadContext& context, const tinygltf::Model& model, const Scene& scene)
        : context_(context), model_(model), reader_(context, scene) {}

    Texture texture(size_t index) const;
    Material material(size_t index) const;

  private:
    WrapMode wrap(int mode, size_t sampler, const char* member) const;
    void read_filters(const tinygltf::Sampler& from, size_t sampler, Texture& out) const;

    LoadContext& context_;
    const tinygltf::Model& model_;
    MaterialReader reader_;
};

constexpr double no_limit = 3e38;

WrapMode MaterialLoader::wrap(int mode, size_t sampler, const char* member) const {
    switch (mode) {
        case TINYGLTF_TEXTURE_WRAP_REPEAT:
            return WrapMode::repeat;
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return WrapMode::clamp_to_edge;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return WrapMode::mirrored_repeat;
        default:
            context_.warn(pointer_to("/samplers", sampler, member), "is not a wrap mode of glTF; repeat is used");
            return WrapMode::repeat;
    }
}

void MaterialLoader::read_filters(const tinygltf::Sampler& from, size_t sampler, Texture& out) const {
    const auto warn = [&](const char* member) {
        context_.warn(pointer_to("/samplers", sampler, member), "is not a filter of glTF; linear is used");
    };
    if (from.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) {
        out.mag_filter = TextureFilter::nearest;
    } else if (from.magFilter != -1 && from.magFilter != TINYGLTF_TEXTURE_FILTER_LINEAR) {
        warn("magFilter");
    }
    const auto minify = [&](TextureFilter filter, MipFilter mip_filter) {
        out.min_filter = filter;
        out.mip_filter = mip_filter;
    };
    switch (from.minFilter) {
        case TINYGLTF_TEXTURE_FILTER_NEAREST:
            return minify(TextureFilter::nearest, MipFilter::none);
        case TINYGLTF_TEXTURE_FILTER_LINEAR:
            return minify(TextureFilter::linear, MipFilter::none);
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
            return minify(TextureFilter::nearest, MipFilter::nearest);
        case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
            return minify(TextureFilter::linear, MipFilter::nearest);
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
            return minify(TextureFilter::nearest, MipFilter::linear);
        case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR:
        case -1:
            return;
        default:
            warn("minFilter");
    }
}

Texture MaterialLoader::texture(size_t index) const {
    const tinygltf::Texture& source = model_.textures[index];
    const std::string where = pointer_to("/textures", index);
    Texture out;
    // Images of extensions come before the texture's own, which is there for readers that do not know them.
    int images[3] = {-1, -1, source.source};
    for (int i = 0; i < 2; ++i) {
        const tinygltf::Value* extension =
            find_extension(source.extensions, i == 0 ? "KHR_texture_basisu" : "EXT_texture_webp");
        if (extension != nullptr && extension->Has("source")) images[i] = extension->Get("source").GetNumberAsInt();
    }
    for (const int image : images) {
        if (image < 0) continue;
        const ImageId id{static_cast<uint32_t>(image)};
        if (!out.image.valid()) {
            out.image = id;
        } else if (id.value != out.image.value) {
            out.fallback = id;
        }
    }
    if (!out.image.valid()) context_.warn(where, "has no image that can be read; white is used");
    if (source.sampler >= 0) {
        const auto sampler = static_cast<size_t>(source.sampler);
        const tinygltf::Sampler& from = model_.samplers[sampler];
        out.wrap_u = wrap(from.wrapS, sampler, "wrapS");
        out.wrap_v = wrap(from.wrapT, sampler, "wrapT");
        read_filters(from, sampler, out);
    }
    return out;
}

Material MaterialLoader::material(size_t index) const {
    const tinygltf::Material& source = model_.materials[index];
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    const std::string where = pointer_to("/materials", index);
    const std::string pbr_place = where + "/pbrMetallicRoughness";
    Material out;
    out.name = source.name;
    for (int i = 0; i < 4; ++i) {
        out.base_color_factor[i] =
            reader_.clamped(pbr.baseColorFactor[static_cast<size_t>(i)], 0.0, 1.0, pbr_place + "/baseColorFactor");
    }
    out.metallic_factor = reader_.clamped(pbr.metallicFactor, 0.0, 1.0, pbr_place + "/metallicFactor");
    out.roughness_factor = reader_.clamped(pbr.roughnessFactor, 0.0, 1.0, pbr_place + "/roughnessFactor");
    for (int i = 0; i < 3; ++i) {
        out.emissive_factor[i] =
            reader_.clamped(source.emissiveFactor[static_cast<size_t>(i)], 0.0, no_limit, where + "/emissiveFactor");
    }
    out.normal_scale = static_cast<float>(source.normalTexture.scale);

    const auto ref = [&](const auto& info, const std::string& place) {
        return reader_.texture(info.index, info.texCoord, find_extension(info.extensions, "KHR_texture_transform"),
                               place);
    };
    out.base_color = ref(pbr.baseColorTexture, pbr_place + "/baseColorTexture");
    out.metallic_roughness = ref(pbr.metallicRoughnessTexture, pbr_place + "/metallicRoughnessTexture");
    out.normal = ref(source.normalTexture, where + "/normalTexture");
    out.occlusion = ref(source.occlusionTexture, where + "/occlusionTexture");
    out.emissive = ref(source.emissiveTexture, where + "/emissiveTexture");

    if (source.alphaMode == "MASK") {
        out.alpha_mode = AlphaMode::mask;
    } else if (source.alphaMode == "BLEND") {
        out.alpha_mode = AlphaMode::blend;
    } else if (source.alphaMode != "OPAQUE") {
        context_.warn(where + "/alphaMode", "\"" + source.alphaMode.substr(0, 40) + "\" is unknown; OPAQUE is used");
    }
    out.alpha_cutoff = reader_.clamped(source.alphaCutoff, 0.0, no_limit, where + "/alphaCutoff");
    out.double_sided = source.doubleSided;
    read_material_layers(reader_, source.extensions, where, out);
    return out;
}

}  // namespace

void load_materials(LoadContext& context, const tinygltf::Model& model, Scene& scene) {
    const MaterialLoader loader(context, model, scene);
    for (size_t i = 0; i < model.textures.size(); ++i)
        scene.textures.push_back(loader.texture(i));
    for (size_t i = 0; i < model.materials.size(); ++i)
        scene.materials.push_back(loader.material(i));
}

std::vector<TextureSlot> texture_slots(const Material& material) {
    const TextureSlot all[] = {
        {&material.base_color, "base colour texture", true},
        {&material.metallic_roughness, "metallic-roughness texture"},
        {&material.normal, "normal texture"},
        {&material.occlusion, "occlusion texture"},
        {&material.emissive, "emissive texture", true},
        {&material.specular.texture, "specular texture"},
        {&material.specular.color, "specular colour texture", true},
        {&material.clearcoat.texture, "clearcoat texture"},
        {&material.clearcoat.roughness, "clearcoat roughness texture"},
        {&material.clearcoat.normal, "clearcoat normal texture"},
        {&material.sheen.color, "sheen colour texture", true},
        {&material.sheen.roughness, "sheen roughness texture"},
        {&material.iridescence.texture, "iridescence texture"},
        {&material.iridescence.thickness, "iridescence thickness texture"},
        {&material.anisotropy.texture, "anisotropy texture"},
        {&material.transmission.texture, "transmission texture"},
        {&material.diffuse_transmission.texture, "diffuse transmission texture"},
        {&material.diffuse_transmission.color, "diffuse transmission colour texture", true},
        {&material.specular_glossiness_texture, "specular-glossiness texture", true},
    };
    std::vector<TextureSlot> used;
    std::copy_if(std::begin(all), std::end(all), std::back_inserter(used),
                 [](const TextureSlot& slot) { return slot.ref->valid(); });
    return used;
}

std::optional<uint32_t> tangent_uv_set(const Material& material) {
    if (material.normal.valid()) return material.normal.uv_set;
    if (material.clearcoat.normal.valid()) return material.clearcoat.normal.uv_set;
    if (material.anisotropy.strength > 0.0f) return material.anisotropy.texture.uv_set;
    return std::nullopt;
}

}  // namespace candela
