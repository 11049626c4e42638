// SPDX-License-Identifier: MIT
// What the renderer relies on in a loaded scene, whatever the file held.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "renderer/io/materials.h"
#include "renderer/scene/scene.h"

namespace candela::test {

// Empty, or the first promise that the primitive breaks.
inline std::string unsoundness_of(const Primitive& p, const Scene& scene) {
    const size_t n = p.positions.size();
    const auto absent_or_full = [n](const auto& values) { return values.empty() || values.size() == n; };
    if (p.flat_normals ? !p.normals.empty() : p.normals.size() != n) return "normals are as many as vertices";
    if (!absent_or_full(p.tangents)) return "tangents are as many as vertices";
    if (!absent_or_full(p.uv[0]) || !absent_or_full(p.uv[1])) return "texture coordinates are as many as vertices";
    if (!absent_or_full(p.colors)) return "colours are as many as vertices";
    for (const Vec3u& t : p.triangles) {
        if (std::max({t.x, t.y, t.z}) >= n) return "triangles name vertices that exist";
    }
    for (const Vec3& position : p.positions) {
        if (!is_finite(position)) return "positions are finite";
    }
    for (const Vec3& normal : p.normals) {
        if (!(std::abs(glm::length(normal) - 1.0f) < 1e-4f)) return "normals are of unit length";
    }
    for (const Vec4& tangent : p.tangents) {
        if (!(std::abs(glm::length(Vec3(tangent)) - 1.0f) < 1e-4f)) return "tangents are of unit length";
    }
    for (const std::vector<Vec2>& set : p.uv) {
        for (const Vec2& uv : set) {
            if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return "texture coordinates are finite";
        }
    }
    for (const Vec4& color : p.colors) {
        if (!is_finite(Vec3(color)) || !std::isfinite(color.w)) return "colours are finite";
    }
    if (p.material.valid() && p.material.value >= scene.materials.size()) return "primitives name materials that exist";
    for (const VariantMaterial& variant : p.variants) {
        if (variant.variant >= scene.variant_names.size()) return "primitives name variants that exist";
        if (variant.material.valid() && variant.material.value >= scene.materials.size())
            return "variants name materials that exist";
    }
    return {};
}

// Empty, or the first promise that is broken.
inline std::string unsoundness_of(const Scene& scene) {
    for (const std::shared_ptr<const Mesh>& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh->primitives) {
            if (std::string broken = unsoundness_of(primitive, scene); !broken.empty()) return broken;
        }
    }
    for (const Material& m : scene.materials) {
        for (const TextureSlot& slot : texture_slots(m)) {
            const TextureRef& ref = *slot.ref;
            if (ref.texture.value >= scene.textures.size()) return "materials name textures that exist";
            if (ref.uv_set >= 2) return "texture coordinates are of set 0 or 1";
            if (scene.textures[ref.texture.value].image.value >= scene.images.size())
                return "textures name images that exist";
            const ImageId fallback = scene.textures[ref.texture.value].fallback;
            if (fallback.valid() && fallback.value >= scene.images.size()) return "fallbacks are images that exist";
        }
        if (!std::isfinite(m.emissive_strength)) return "emission is finite";
        if (!(m.ior >= 1.0f || m.ior == 0.0f)) return "indices of refraction are at least 1, or 0";
        if (!(m.roughness_factor >= 0.0f)) return "roughness is not negative";
    }
    for (const Instance& instance : scene.instances) {
        if (instance.mesh.value >= scene.meshes.size()) return "instances name meshes that exist";
        for (int c = 0; c < 4; ++c) {
            if (!is_finite(Vec3(instance.world_from_object[c]))) return "instances are placed finitely";
        }
    }
    for (const LightInstance& light : scene.light_instances) {
        if (light.light.value >= scene.lights.size()) return "placed lights exist";
    }
    for (const CameraInstance& camera : scene.cameras) {
        if (!(std::abs(glm::determinant(Mat3(camera.camera.world_from_camera)) - 1.0f) < 1e-3f))
            return "cameras are placed without scale";
    }
    return {};
}

}  // namespace candela::test
