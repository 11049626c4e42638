// SPDX-License-Identifier: MIT
#include "renderer/scene/animated_materials.h"

namespace candela {
namespace {

using Owner = AnimatedProperty::Owner;
using Value = std::span<const float>;

// What a factor may be.
enum class Range : uint8_t { any, positive, unit, from_1 };

float limited(float value, Range range) {
    if (range == Range::any || !(value == value)) return value == value ? value : 0.0f;
    const float lowest = range == Range::from_1 ? 1.0f : 0.0f;
    return std::clamp(value, lowest, range == Range::unit ? 1.0f : 1e30f);
}

void assign(float& out, Value value, Range range) {
    out = limited(value[0], range);
}
template <int n>
void assign(glm::vec<n, float>& out, Value value, Range range) {
    for (int i = 0; i < n; ++i)
        out[i] = limited(value[static_cast<size_t>(i)], range);
}

// Sets a member of the material, or a member of one of its layers.
template <Range range, auto member>
void set(Scene& scene, uint32_t material, Value value) {
    assign(scene.materials[material].*member, value, range);
}
template <Range range, auto layer, auto member>
void set(Scene& scene, uint32_t material, Value value) {
    assign(scene.materials[material].*layer.*member, value, range);
}

void set_ior(Scene& scene, uint32_t material, Value value) {
    scene.materials[material].ior = value[0] > 0.0f ? limited(value[0], Range::from_1) : 0.0f;
}

void set_attenuation_distance(Scene& scene, uint32_t material, Value value) {
    scene.materials[material].volume.attenuation_distance_m = value[0] > 0.0f ? value[0] : infinity;
}

void set_glossiness(Scene& scene, uint32_t material, Value value) {
    scene.materials[material].roughness_factor = 1.0f - limited(value[0], Range::unit);
}

void no_effect(Scene& /*scene*/, uint32_t /*material*/, Value /*value*/) {}

constexpr AnimatedProperty properties[] = {
    {"/materials/*/pbrMetallicRoughness/baseColorFactor", Owner::material, 4, false, false,
     set<Range::unit, &Material::base_color_factor>},
    {"/materials/*/pbrMetallicRoughness/metallicFactor", Owner::material, 1, false, false,
     set<Range::unit, &Material::metallic_factor>},
    {"/materials/*/pbrMetallicRoughness/roughnessFactor", Owner::material, 1, false, false,
     set<Range::unit, &Material::roughness_factor>},
    {"/materials/*/normalTexture/scale", Owner::material, 1, false, false, set<Range::any, &Material::normal_scale>},
    {"/materials/*/emissiveFactor", Owner::material, 3, false, false, set<Range::positive, &Material::emissive_factor>},
    {"/materials/*/alphaCutoff", Owner::material, 1, false, false, set<Range::positive, &Material::alpha_cutoff>},
    {"/materials/*/extensions/KHR_materials_emissive_strength/emissiveStrength", Owner::material, 1, false, false,
     set<Range::positive, &Material::emissive_strength>},
    {"/materials/*/extensions/KHR_materials_specular/specularFactor", Owner::material, 1, false, false,
     set<Range::unit, &Material::specular, &SpecularLayer::factor>},
    {"/materials/*/extensions/KHR_materials_specular/specularColorFactor", Owner::material, 3, false, false,
     set<Range::positive, &Material::specular, &SpecularLayer::color_factor>},
    {"/materials/*/extensions/KHR_materials_clearcoat/clearcoatFactor", Owner::material, 1, false, false,
     set<Range::unit, &Material::clearcoat, &ClearcoatLayer::factor>},
    {"/materials/*/extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", Owner::material, 1, false, false,
     set<Range::unit, &Material::clearcoat, &ClearcoatLayer::roughness_factor>},
    {"/materials/*/extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale", Owner::material, 1, false, false,
     set<Range::any, &Material::clearcoat, &ClearcoatLayer::normal_scale>},
    {"/materials/*/extensions/KHR_materials_sheen/sheenColorFactor", Owner::material, 3, false, false,
     set<Range::unit, &Material::sheen, &SheenLayer::color_factor>},
    {"/materials/*/extensions/KHR_materials_sheen/sheenRoughnessFactor", Owner::material, 1, false, false,
     set<Range::unit, &Material::sheen, &SheenLayer::roughness_factor>},
    {"/materials/*/extensions/KHR_materials_iridescence/iridescenceFactor", Owner::material, 1, false, false,
     set<Range::unit, &Material::iridescence, &IridescenceLayer::factor>},
    {"/materials/*/extensions/KHR_materials_iridescence/iridescenceIor", Owner::material, 1, false, false,
     set<Range::from_1, &Material::iridescence, &IridescenceLayer::ior>},
    {"/materials/*/extensions/KHR_materials_iridescence/iridescenceThicknessMinimum", Owner::material, 1, false, false,
     set<Range::positive, &Material::iridescence, &IridescenceLayer::thickness_minimum_nm>},
    {"/materials/*/extensions/KHR_materials_iridescence/iridescenceThicknessMaximum", Owner::material, 1, false, false,
     set<Range::positive, &Material::iridescence, &IridescenceLayer::thickness_maximum_nm>},
    {"/materials/*/extensions/KHR_materials_anisotropy/anisotropyStrength", Owner::material, 1, false, false,
     set<Range::unit, &Material::anisotropy, &Anisotropy::strength>},
    {"/materials/*/extensions/KHR_materials_anisotropy/anisotropyRotation", Owner::material, 1, false, false,
     set<Range::any, &Material::anisotropy, &Anisotropy::rotation_radians>},
    {"/materials/*/extensions/KHR_materials_transmission/transmissionFactor", Owner::material, 1, false, false,
     set<Range::unit, &Material::transmission, &Transmission::factor>},
    {"/materials/*/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionFactor", Owner::material, 1, false,
     false, set<Range::unit, &Material::diffuse_transmission, &DiffuseTransmission::factor>},
    {"/materials/*/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorFactor", Owner::material, 3,
     false, false, set<Range::unit, &Material::diffuse_transmission, &DiffuseTransmission::color_factor>},
    {"/materials/*/extensions/KHR_materials_volume/thicknessFactor", Owner::material, 1, false, false,
     set<Range::positive, &Material::volume, &Volume::thickness_factor>},
    {"/materials/*/extensions/KHR_materials_volume/attenuationColor", Owner::material, 3, false, false,
     set<Range::unit, &Material::volume, &Volume::attenuation_color>},
    {"/materials/*/extensions/KHR_materials_dispersion/dispersion", Owner::material, 1, false, false,
     set<Range::positive, &Material::volume, &Volume::dispersion>},
    {"/materials/*/extensions/KHR_materials_pbrSpecularGlossiness/diffuseFactor", Owner::material, 4, false, false,
     set<Range::unit, &Material::base_color_factor>},
    {"/materials/*/extensions/KHR_materials_pbrSpecularGlossiness/specularFactor", Owner::material, 3, false, false,
     set<Range::unit, &Material::specular, &SpecularLayer::color_factor>},
    {"/materials/*/extensions/KHR_materials_ior/ior", Owner::material, 1, false, false, set_ior},
    {"/materials/*/extensions/KHR_materials_volume/attenuationDistance", Owner::material, 1, false, false,
     set_attenuation_distance},
    {"/materials/*/extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor", Owner::material, 1, false, false,
     set_glossiness},
    // A path tracer computes occlusion.
    {"/materials/*/occlusionTexture/strength", Owner::material, 1, false, false, no_effect},
};

template <auto member>
TextureRef& slot(Material& material) {
    return material.*member;
}
template <auto layer, auto member>
TextureRef& slot(Material& material) {
    return material.*layer.*member;
}

constexpr TextureSlotPlace texture_slots[] = {
    {"/pbrMetallicRoughness/baseColorTexture", slot<&Material::base_color>},
    {"/pbrMetallicRoughness/metallicRoughnessTexture", slot<&Material::metallic_roughness>},
    {"/normalTexture", slot<&Material::normal>},
    {"/occlusionTexture", slot<&Material::occlusion>},
    {"/emissiveTexture", slot<&Material::emissive>},
    {"/extensions/KHR_materials_specular/specularTexture", slot<&Material::specular, &SpecularLayer::texture>},
    {"/extensions/KHR_materials_specular/specularColorTexture", slot<&Material::specular, &SpecularLayer::color>},
    {"/extensions/KHR_materials_clearcoat/clearcoatTexture", slot<&Material::clearcoat, &ClearcoatLayer::texture>},
    {"/extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture",
     slot<&Material::clearcoat, &ClearcoatLayer::roughness>},
    {"/extensions/KHR_materials_clearcoat/clearcoatNormalTexture", slot<&Material::clearcoat, &ClearcoatLayer::normal>},
    {"/extensions/KHR_materials_sheen/sheenColorTexture", slot<&Material::sheen, &SheenLayer::color>},
    {"/extensions/KHR_materials_sheen/sheenRoughnessTexture", slot<&Material::sheen, &SheenLayer::roughness>},
    {"/extensions/KHR_materials_iridescence/iridescenceTexture",
     slot<&Material::iridescence, &IridescenceLayer::texture>},
    {"/extensions/KHR_materials_iridescence/iridescenceThicknessTexture",
     slot<&Material::iridescence, &IridescenceLayer::thickness>},
    {"/extensions/KHR_materials_anisotropy/anisotropyTexture", slot<&Material::anisotropy, &Anisotropy::texture>},
    {"/extensions/KHR_materials_transmission/transmissionTexture",
     slot<&Material::transmission, &Transmission::texture>},
    {"/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionTexture",
     slot<&Material::diffuse_transmission, &DiffuseTransmission::texture>},
    {"/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorTexture",
     slot<&Material::diffuse_transmission, &DiffuseTransmission::color>},
    {"/extensions/KHR_materials_pbrSpecularGlossiness/diffuseTexture", slot<&Material::base_color>},
    {"/extensions/KHR_materials_pbrSpecularGlossiness/specularGlossinessTexture",
     slot<&Material::specular_glossiness_texture>},
};

}  // namespace

std::span<const AnimatedProperty> animated_material_properties() {
    return properties;
}

std::span<const TextureSlotPlace> animated_texture_slots() {
    return texture_slots;
}

}  // namespace candela
