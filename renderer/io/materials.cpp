// SPDX-License-Identifier: MIT
#include "renderer/io/materials.h"

#include "renderer/io/tinygltf.h"

namespace candela {
namespace {

class MaterialLoader {
  public:
    MaterialLoader(LoadContext& context, const tinygltf::Model& model, Scene& scene)
        : context_(context), model_(model), scene_(scene) {}

    Texture texture(size_t index) const;
    Material material(size_t index) const;

  private:
    WrapMode wrap(int mode, size_t sampler, const char* member) const;
    TextureRef texture_ref(int index, int tex_coord, const TinyExtensions& extensions, const std::string& where) const;
    float clamped(double value, double lowest, double highest, const std::string& where) const;
    void extensions(const tinygltf::Material& source, const std::string& where, Material& out) const;

    LoadContext& context_;
    const tinygltf::Model& model_;
    Scene& scene_;
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

Texture MaterialLoader::texture(size_t index) const {
    const tinygltf::Texture& source = model_.textures[index];
    const std::string where = pointer_to("/textures", index);
    Texture out;
    int image = source.source;
    if (const tinygltf::Value* webp = find_extension(source.extensions, "EXT_texture_webp")) {
        if (webp->Has("source")) image = webp->Get("source").GetNumberAsInt();
    }
    if (image >= 0) {
        out.image = ImageId{static_cast<uint32_t>(image)};
    } else {
        context_.warn(where, "has no image that can be read; white is used");
    }
    if (source.sampler >= 0) {
        const auto sampler = static_cast<size_t>(source.sampler);
        const tinygltf::Sampler& from = model_.samplers[sampler];
        out.wrap_u = wrap(from.wrapS, sampler, "wrapS");
        out.wrap_v = wrap(from.wrapT, sampler, "wrapT");
        if (from.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) {
            out.filter = TextureFilter::nearest;
        } else if (from.magFilter != -1 && from.magFilter != TINYGLTF_TEXTURE_FILTER_LINEAR) {
            context_.warn(pointer_to("/samplers", sampler, "magFilter"), "is not a filter of glTF; linear is used");
        }
    }
    return out;
}

float MaterialLoader::clamped(double value, double lowest, double highest, const std::string& where) const {
    if (value >= lowest && value <= highest) return static_cast<float>(value);
    context_.warn(where, "is out of range and was clamped");
    return static_cast<float>(value > highest ? highest : lowest);
}

// KHR_texture_transform: translation · rotation · scale. A positive rotation turns the coordinates counter-clockwise as
// the picture is seen, where v points down: u' = u cos + v sin, v' = v cos - u sin.
glm::mat3x2 uv_transform(const tinygltf::Value& transform) {
    const double angle = number_member(transform, "rotation", 0.0);
    const double c = std::cos(angle), s = std::sin(angle);
    const double su = array_member(transform, "scale", 0, 1.0), sv = array_member(transform, "scale", 1, 1.0);
    const double ou = array_member(transform, "offset", 0, 0.0), ov = array_member(transform, "offset", 1, 0.0);
    return glm::mat3x2(glm::dmat3x2(c * su, -s * su, s * sv, c * sv, ou, ov));
}

TextureRef MaterialLoader::texture_ref(int index, int tex_coord, const TinyExtensions& extensions,
                                       const std::string& where) const {
    TextureRef ref;
    if (index < 0 || !scene_.textures[static_cast<size_t>(index)].image.valid()) return ref;
    if (const tinygltf::Value* transform = find_extension(extensions, "KHR_texture_transform")) {
        ref.uv_transform = uv_transform(*transform);
        if (transform->Has("texCoord")) tex_coord = transform->Get("texCoord").GetNumberAsInt();
    }
    if (tex_coord < 0 || tex_coord > 1) {
        context_.warn(where + "/texCoord", "only TEXCOORD_0 and TEXCOORD_1 are read; the texture is ignored");
        return ref;
    }
    ref.uv_set = static_cast<uint32_t>(tex_coord);
    ref.texture = TextureId{static_cast<uint32_t>(index)};
    return ref;
}

void MaterialLoader::extensions(const tinygltf::Material& source, const std::string& where, Material& out) const {
    const std::string place = where + "/extensions/";
    if (const tinygltf::Value* strength = find_extension(source.extensions, "KHR_materials_emissive_strength")) {
        out.emissive_strength = clamped(number_member(*strength, "emissiveStrength", 1.0), 0.0, no_limit,
                                        place + "KHR_materials_emissive_strength/emissiveStrength");
    }
    if (const tinygltf::Value* ior = find_extension(source.extensions, "KHR_materials_ior")) {
        const double value = number_member(*ior, "ior", 1.5);
        const std::string member = place + "KHR_materials_ior/ior";
        if (value == 0.0) {
            // The extension's 0 means an infinite index: every dielectric reflection is total.
            out.ior = 1e6f;
        } else {
            out.ior = clamped(value, 1.0, 1e6, member);
        }
    }
    if (const tinygltf::Value* specular = find_extension(source.extensions, "KHR_materials_specular")) {
        const std::string members = place + "KHR_materials_specular/";
        out.specular_factor =
            clamped(number_member(*specular, "specularFactor", 1.0), 0.0, 1.0, members + "specularFactor");
        for (int i = 0; i < 3; ++i) {
            out.specular_color_factor[i] = clamped(array_member(*specular, "specularColorFactor", i, 1.0), 0.0,
                                                   no_limit, members + "specularColorFactor");
        }
    }
    out.unlit = source.extensions.count("KHR_materials_unlit") != 0;
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
            clamped(pbr.baseColorFactor[static_cast<size_t>(i)], 0.0, 1.0, pbr_place + "/baseColorFactor");
    }
    out.metallic_factor = clamped(pbr.metallicFactor, 0.0, 1.0, pbr_place + "/metallicFactor");
    out.roughness_factor = clamped(pbr.roughnessFactor, 0.0, 1.0, pbr_place + "/roughnessFactor");
    for (int i = 0; i < 3; ++i) {
        out.emissive_factor[i] =
            clamped(source.emissiveFactor[static_cast<size_t>(i)], 0.0, no_limit, where + "/emissiveFactor");
    }
    out.normal_scale = static_cast<float>(source.normalTexture.scale);

    const auto ref = [&](const auto& info, const std::string& place) {
        return texture_ref(info.index, info.texCoord, info.extensions, place);
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
    out.alpha_cutoff = clamped(source.alphaCutoff, 0.0, no_limit, where + "/alphaCutoff");
    out.double_sided = source.doubleSided;
    extensions(source, where, out);
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

std::array<TextureSlot, texture_slot_count> texture_slots(Material& material) {
    return {{{&material.base_color, "pbrMetallicRoughness/baseColorTexture"},
             {&material.metallic_roughness, "pbrMetallicRoughness/metallicRoughnessTexture"},
             {&material.normal, "normalTexture"},
             {&material.occlusion, "occlusionTexture"},
             {&material.emissive, "emissiveTexture"}}};
}

}  // namespace candela
