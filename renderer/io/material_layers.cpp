// SPDX-License-Identifier: MIT
#include "renderer/io/material_layers.h"

namespace candela {
namespace {

constexpr double no_limit = 3e38;

glm::mat3x2 uv_transform(const tinygltf::Value& transform) {
    UvTransform parts;
    parts.rotation_radians = number_member(transform, "rotation", 0.0);
    for (int i = 0; i < 2; ++i) {
        parts.offset[i] = array_member(transform, "offset", i, 0.0);
        parts.scale[i] = array_member(transform, "scale", i, 1.0);
    }
    return compose_uv_transform(parts);
}

void read_specular(const MaterialReader& reader, const tinygltf::Value& from, const std::string& where,
                   SpecularLayer& out) {
    out.factor = reader.factor(from, "specularFactor", 1.0, 1.0, where);
    out.texture = reader.texture(from, "specularTexture", where);
    out.color_factor = reader.color(from, "specularColorFactor", 1.0, no_limit, where);
    out.color = reader.texture(from, "specularColorTexture", where);
}

void read_clearcoat(const MaterialReader& reader, const tinygltf::Value& from, const std::string& where,
                    ClearcoatLayer& out) {
    out.factor = reader.factor(from, "clearcoatFactor", 0.0, 1.0, where);
    out.texture = reader.texture(from, "clearcoatTexture", where);
    out.roughness_factor = reader.factor(from, "clearcoatRoughnessFactor", 0.0, 1.0, where);
    out.roughness = reader.texture(from, "clearcoatRoughnessTexture", where);
    out.normal = reader.texture(from, "clearcoatNormalTexture", where);
    if (from.Has("clearcoatNormalTexture")) {
        out.normal_scale = static_cast<float>(number_member(from.Get("clearcoatNormalTexture"), "scale", 1.0));
    }
}

void read_sheen(const MaterialReader& reader, const tinygltf::Value& from, const std::string& where, SheenLayer& out) {
    out.color_factor = reader.color(from, "sheenColorFactor", 0.0, 1.0, where);
    out.color = reader.texture(from, "sheenColorTexture", where);
    out.roughness_factor = reader.factor(from, "sheenRoughnessFactor", 0.0, 1.0, where);
    out.roughness = reader.texture(from, "sheenRoughnessTexture", where);
}

void read_iridescence(const MaterialReader& reader, const tinygltf::Value& from, const std::string& where,
                      IridescenceLayer& out) {
    out.factor = reader.factor(from, "iridescenceFactor", 0.0, 1.0, where);
    out.texture = reader.texture(from, "iridescenceTexture", where);
    out.ior = reader.clamped(number_member(from, "iridescenceIor", 1.3), 1.0, 1e3, where + "/iridescenceIor");
    out.thickness_minimum_nm = reader.factor(from, "iridescenceThicknessMinimum", 100.0, 1e6, where);
    out.thickness_maximum_nm = reader.factor(from, "iridescenceThicknessMaximum", 400.0, 1e6, where);
    out.thickness = reader.texture(from, "iridescenceThicknessTexture", where);
}

void read_anisotropy(const MaterialReader& reader, const tinygltf::Value& from, const std::string& where,
                     Anisotropy& out) {
    out.strength = reader.factor(from, "anisotropyStrength", 0.0, 1.0, where);
    out.rotation_radians = static_cast<float>(number_member(from, "anisotropyRotation", 0.0));
    out.texture = reader.texture(from, "anisotropyTexture", where);
}

void read_diffuse_transmission(const MaterialReader& reader, const tinygltf::Value& from, const std::string& where,
                               DiffuseTransmission& out) {
    out.factor = reader.factor(from, "diffuseTransmissionFactor", 0.0, 1.0, where);
    out.texture = reader.texture(from, "diffuseTransmissionTexture", where);
    out.color_factor = reader.color(from, "diffuseTransmissionColorFactor", 1.0, 1.0, where);
    out.color = reader.texture(from, "diffuseTransmissionColorTexture", where);
}

void read_volume(const MaterialReader& reader, const tinygltf::Value& from, const std::string& where, Volume& out) {
    out.thickness_factor = reader.factor(from, "thicknessFactor", 0.0, no_limit, where);
    out.attenuation_color = reader.color(from, "attenuationColor", 1.0, 1.0, where);
    if (!from.Has("attenuationDistance")) return;
    const double distance = number_member(from, "attenuationDistance", 0.0);
    if (distance > 0.0) {
        out.attenuation_distance_m = static_cast<float>(distance);
    } else {
        reader.warn(where + "/attenuationDistance", "should be greater than 0; the body does not absorb");
    }
}

// The archived KHR_materials_pbrSpecularGlossiness replaces the metallic-roughness parameters.
void read_specular_glossiness(const MaterialReader& reader, const tinygltf::Value& from, const std::string& where,
                              Material& out) {
    out.specular_glossiness = true;
    out.metallic_factor = 0.0f;
    out.metallic_roughness = TextureRef{};
    for (int i = 0; i < 4; ++i) {
        out.base_color_factor[i] =
            reader.clamped(array_member(from, "diffuseFactor", i, 1.0), 0.0, 1.0, where + "/diffuseFactor");
    }
    out.base_color = reader.texture(from, "diffuseTexture", where);
    out.specular.color_factor = reader.color(from, "specularFactor", 1.0, 1.0, where);
    out.roughness_factor = 1.0f - reader.factor(from, "glossinessFactor", 1.0, 1.0, where);
    out.specular_glossiness_texture = reader.texture(from, "specularGlossinessTexture", where);
}

}  // namespace

TextureRef MaterialReader::texture(int index, int tex_coord, const tinygltf::Value* transform,
                                   const std::string& where) const {
    TextureRef ref;
    if (index < 0 || !scene_.textures[static_cast<size_t>(index)].image.valid()) return ref;
    if (transform != nullptr) {
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

TextureRef MaterialReader::texture(const tinygltf::Value& extension, const char* name, const std::string& where) const {
    if (!extension.Has(name)) return {};
    const tinygltf::Value& info = extension.Get(name);
    const tinygltf::Value* transform = nullptr;
    if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform")) {
        transform = &info.Get("extensions").Get("KHR_texture_transform");
    }
    const int tex_coord = info.Has("texCoord") ? info.Get("texCoord").GetNumberAsInt() : 0;
    return texture(info.Get("index").GetNumberAsInt(), tex_coord, transform, where + "/" + name);
}

float MaterialReader::clamped(double value, double lowest, double highest, const std::string& where) const {
    if (value >= lowest && value <= highest) return static_cast<float>(value);
    context_.warn(where, "is out of range and was clamped");
    return static_cast<float>(value > highest ? highest : lowest);
}

float MaterialReader::factor(const tinygltf::Value& extension, const char* name, double missing, double highest,
                             const std::string& where) const {
    return clamped(number_member(extension, name, missing), 0.0, highest, where + "/" + name);
}

Vec3 MaterialReader::color(const tinygltf::Value& extension, const char* name, double missing, double highest,
                           const std::string& where) const {
    Vec3 out;
    for (int i = 0; i < 3; ++i)
        out[i] = clamped(array_member(extension, name, i, missing), 0.0, highest, where + "/" + name);
    return out;
}

void read_material_layers(const MaterialReader& reader, const TinyExtensions& extensions, const std::string& where,
                          Material& out) {
    const auto read = [&](const std::string& name, const auto& reading) {
        const std::string place = where + "/extensions/" + name;
        if (const tinygltf::Value* extension = find_extension(extensions, name.c_str())) reading(*extension, place);
    };
    read("KHR_materials_emissive_strength", [&](const tinygltf::Value& from, const std::string& place) {
        out.emissive_strength = reader.factor(from, "emissiveStrength", 1.0, no_limit, place);
    });
    read("KHR_materials_ior", [&](const tinygltf::Value& from, const std::string& place) {
        const double value = number_member(from, "ior", 1.5);
        out.ior = value == 0.0 ? 0.0f : reader.clamped(value, 1.0, 1e6, place + "/ior");
    });
    read("KHR_materials_specular", [&](const tinygltf::Value& from, const std::string& place) {
        read_specular(reader, from, place, out.specular);
    });
    read("KHR_materials_clearcoat", [&](const tinygltf::Value& from, const std::string& place) {
        read_clearcoat(reader, from, place, out.clearcoat);
    });
    read("KHR_materials_sheen",
         [&](const tinygltf::Value& from, const std::string& place) { read_sheen(reader, from, place, out.sheen); });
    read("KHR_materials_iridescence", [&](const tinygltf::Value& from, const std::string& place) {
        read_iridescence(reader, from, place, out.iridescence);
    });
    read("KHR_materials_anisotropy", [&](const tinygltf::Value& from, const std::string& place) {
        read_anisotropy(reader, from, place, out.anisotropy);
    });
    read("KHR_materials_transmission", [&](const tinygltf::Value& from, const std::string& place) {
        out.transmission.factor = reader.factor(from, "transmissionFactor", 0.0, 1.0, place);
        out.transmission.texture = reader.texture(from, "transmissionTexture", place);
    });
    read("KHR_materials_diffuse_transmission", [&](const tinygltf::Value& from, const std::string& place) {
        read_diffuse_transmission(reader, from, place, out.diffuse_transmission);
    });
    read("KHR_materials_volume",
         [&](const tinygltf::Value& from, const std::string& place) { read_volume(reader, from, place, out.volume); });
    read("KHR_materials_dispersion", [&](const tinygltf::Value& from, const std::string& place) {
        out.volume.dispersion = reader.factor(from, "dispersion", 0.0, 1e3, place);
    });
    read("KHR_materials_pbrSpecularGlossiness", [&](const tinygltf::Value& from, const std::string& place) {
        read_specular_glossiness(reader, from, place, out);
    });
    out.unlit = extensions.count("KHR_materials_unlit") != 0;
}

}  // namespace candela
