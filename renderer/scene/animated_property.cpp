// SPDX-License-Identifier: MIT
#include "renderer/scene/animated_property.h"

#include <charconv>

#include "renderer/scene/animated_materials.h"
#include "renderer/scene/animation.h"
#include "renderer/scene/place_nodes.h"

namespace candela {
namespace {

using Owner = AnimatedProperty::Owner;
using Value = std::span<const float>;

Vec3 vec3(Value v) {
    return {v[0], v[1], v[2]};
}

void set_translation(Scene& scene, uint32_t i, Value v) {
    Node& node = scene.nodes[i];
    node.translation = vec3(v);
    node.parent_from_node = compose_transform(node.translation, node.rotation, node.scale);
}

void set_rotation(Scene& scene, uint32_t i, Value v) {
    Node& node = scene.nodes[i];
    node.rotation = Quat(v[3], v[0], v[1], v[2]);
    node.parent_from_node = compose_transform(node.translation, node.rotation, node.scale);
}

void set_scale(Scene& scene, uint32_t i, Value v) {
    Node& node = scene.nodes[i];
    node.scale = vec3(v);
    node.parent_from_node = compose_transform(node.translation, node.rotation, node.scale);
}

void set_visible(Scene& scene, uint32_t i, Value v) {
    scene.nodes[i].visible = v[0] > 0.5f;
}

void set_node_weights(Scene& scene, uint32_t i, Value v) {
    scene.nodes[i].morph_weights.assign(v.begin(), v.end());
}

// For the nodes that bring no weights of their own.
void set_mesh_weights(Scene& scene, uint32_t i, Value v) {
    for (Node& node : scene.nodes) {
        if (node.mesh.value == i && !node.has_own_weights) node.morph_weights.assign(v.begin(), v.end());
    }
}

void set_light_color(Scene& scene, uint32_t i, Value v) {
    scene.lights[i].color = glm::max(vec3(v), 0.0f);
}

void set_light_intensity(Scene& scene, uint32_t i, Value v) {
    scene.lights[i].intensity = std::max(v[0], 0.0f);
}

void set_light_range(Scene& scene, uint32_t i, Value v) {
    scene.lights[i].range = v[0] > 0.0f ? v[0] : infinity;
}

void set_inner_cone(Scene& scene, uint32_t i, Value v) {
    scene.lights[i].inner_cone_radians = std::clamp(v[0], 0.0f, pi / 2);
}

void set_outer_cone(Scene& scene, uint32_t i, Value v) {
    scene.lights[i].outer_cone_radians = std::clamp(v[0], 1e-4f, pi / 2);
}

void set_yfov(Scene& scene, uint32_t i, Value v) {
    scene.file_cameras[i].camera.yfov_radians = std::clamp(v[0], 1e-3f, 3.14f);
}

void set_aspect(Scene& scene, uint32_t i, Value v) {
    scene.file_cameras[i].camera.aspect = std::max(v[0], 0.0f);
}

void set_xmag(Scene& scene, uint32_t i, Value v) {
    Camera& camera = scene.file_cameras[i].camera;
    camera.aspect = std::max(std::abs(v[0]), 1e-6f) / camera.ortho_half_height_m;
}

// The width stays.
void set_ymag(Scene& scene, uint32_t i, Value v) {
    Camera& camera = scene.file_cameras[i].camera;
    const float half_width_m = camera.aspect * camera.ortho_half_height_m;
    camera.ortho_half_height_m = std::max(std::abs(v[0]), 1e-6f);
    camera.aspect = half_width_m / camera.ortho_half_height_m;
}

// Rays begin at the eye and end nowhere: clip planes mean nothing to them.
void no_effect(Scene& /*scene*/, uint32_t /*i*/, Value /*v*/) {}

void recompose(Scene& scene, const AnimatedUv& animated) {
    TextureRef& ref = animated_texture_slots()[animated.slot].ref(scene.materials[animated.material.value]);
    ref.uv_transform = compose_uv_transform(animated.transform);
}

void set_uv_offset(Scene& scene, uint32_t i, Value v) {
    scene.animated_uvs[i].transform.offset = {v[0], v[1]};
    recompose(scene, scene.animated_uvs[i]);
}

void set_uv_rotation(Scene& scene, uint32_t i, Value v) {
    scene.animated_uvs[i].transform.rotation_radians = static_cast<double>(v[0]);
    recompose(scene, scene.animated_uvs[i]);
}

void set_uv_scale(Scene& scene, uint32_t i, Value v) {
    scene.animated_uvs[i].transform.scale = {v[0], v[1]};
    recompose(scene, scene.animated_uvs[i]);
}

constexpr AnimatedProperty properties[] = {
    {"/nodes/*/translation", Owner::node, 3, false, true, set_translation},
    {"/nodes/*/rotation", Owner::node, 4, true, true, set_rotation},
    {"/nodes/*/scale", Owner::node, 3, false, true, set_scale},
    {"/nodes/*/extensions/KHR_node_visibility/visible", Owner::node, 1, false, true, set_visible},
    {"/nodes/*/weights", Owner::node, 0, false, false, set_node_weights},
    {"/meshes/*/weights", Owner::mesh, 0, false, false, set_mesh_weights},
    {"/extensions/KHR_lights_punctual/lights/*/color", Owner::light, 3, false, false, set_light_color},
    {"/extensions/KHR_lights_punctual/lights/*/intensity", Owner::light, 1, false, false, set_light_intensity},
    {"/extensions/KHR_lights_punctual/lights/*/range", Owner::light, 1, false, false, set_light_range},
    {"/extensions/KHR_lights_punctual/lights/*/spot/innerConeAngle", Owner::light, 1, false, false, set_inner_cone},
    {"/extensions/KHR_lights_punctual/lights/*/spot/outerConeAngle", Owner::light, 1, false, false, set_outer_cone},
    {"/cameras/*/perspective/yfov", Owner::camera, 1, false, false, set_yfov},
    {"/cameras/*/perspective/aspectRatio", Owner::camera, 1, false, false, set_aspect},
    {"/cameras/*/perspective/znear", Owner::camera, 1, false, false, no_effect},
    {"/cameras/*/perspective/zfar", Owner::camera, 1, false, false, no_effect},
    {"/cameras/*/orthographic/xmag", Owner::camera, 1, false, false, set_xmag},
    {"/cameras/*/orthographic/ymag", Owner::camera, 1, false, false, set_ymag},
    {"/cameras/*/orthographic/znear", Owner::camera, 1, false, false, no_effect},
    {"/cameras/*/orthographic/zfar", Owner::camera, 1, false, false, no_effect},
};

// Of any texture of a material; what stands between is the texture's place.
constexpr AnimatedProperty uv_properties[] = {
    {"/extensions/KHR_texture_transform/offset", Owner::texture_transform, 2, false, false, set_uv_offset},
    {"/extensions/KHR_texture_transform/rotation", Owner::texture_transform, 1, false, false, set_uv_rotation},
    {"/extensions/KHR_texture_transform/scale", Owner::texture_transform, 2, false, false, set_uv_scale},
};

// Splits off an index at the front of text, as JSON pointers write it: no sign, no leading zeros.
std::optional<uint32_t> take_index(std::string_view& text) {
    uint32_t index = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), index);
    if (parsed.ec != std::errc() || (text.front() == '0' && parsed.ptr != text.data() + 1)) return std::nullopt;
    text.remove_prefix(static_cast<size_t>(parsed.ptr - text.data()));
    return index;
}

// The index that stands for * in the pattern.
std::optional<uint32_t> match(std::string_view pattern, std::string_view pointer) {
    const size_t star = pattern.find('*');
    if (pointer.substr(0, star) != pattern.substr(0, star)) return std::nullopt;
    pointer.remove_prefix(star);
    const std::optional<uint32_t> index = take_index(pointer);
    return index && pointer == pattern.substr(star + 1) ? index : std::nullopt;
}

std::optional<PropertyMatch> find_uv_property(std::string_view pointer) {
    constexpr std::string_view materials = "/materials/";
    if (!pointer.starts_with(materials)) return std::nullopt;
    pointer.remove_prefix(materials.size());
    const std::optional<uint32_t> material = take_index(pointer);
    if (!material) return std::nullopt;
    for (const AnimatedProperty& property : uv_properties) {
        if (!pointer.ends_with(property.pointer)) continue;
        const std::string_view place = pointer.substr(0, pointer.size() - property.pointer.size());
        const std::span<const TextureSlotPlace> slots = animated_texture_slots();
        for (uint32_t slot = 0; slot < slots.size(); ++slot) {
            if (slots[slot].pointer == place) return PropertyMatch{&property, *material, slot};
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<PropertyMatch> find_animated_property(std::string_view pointer) {
    for (const std::span<const AnimatedProperty> table :
         {std::span<const AnimatedProperty>(properties), animated_material_properties()}) {
        for (const AnimatedProperty& property : table) {
            if (const std::optional<uint32_t> index = match(property.pointer, pointer))
                return PropertyMatch{&property, *index, 0};
        }
    }
    return find_uv_property(pointer);
}

std::string pointer_of(const AnimationChannel& channel, const Scene& scene) {
    const std::string pattern(channel.property->pointer);
    if (channel.property->owner == Owner::texture_transform) {
        const AnimatedUv& animated = scene.animated_uvs[channel.object];
        return "/materials/" + std::to_string(animated.material.value) +
               std::string(animated_texture_slots()[animated.slot].pointer) + pattern;
    }
    const size_t star = pattern.find('*');
    return pattern.substr(0, star) + std::to_string(channel.object) + pattern.substr(star + 1);
}

}  // namespace candela
