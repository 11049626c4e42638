// SPDX-License-Identifier: MIT
#include "renderer/world/emissive.h"

namespace candela {

namespace {

// The mean and the largest luminance of a texture over a triangle in uv, on a grid of barycentric points that is as
// fine as the texels up to 16 × 16.
struct TextureMean {
    float mean = 1.0f;
    float largest = 1.0f;
};

TextureMean mean_over_triangle(const TextureView& texture, const TextureRef& ref, const Vec3& factor,
                               const Vec2 uv[3]) {
    Vec2 texel[3];
    for (int i = 0; i < 3; ++i) {
        texel[i] = ref.uv_transform * Vec3(uv[i], 1.0f) *
                   Vec2(static_cast<float>(texture.width), static_cast<float>(texture.height));
    }
    const float longest = std::max(
        {glm::length(texel[1] - texel[0]), glm::length(texel[2] - texel[0]), glm::length(texel[2] - texel[1])});
    const int n = std::isfinite(longest) ? std::clamp(static_cast<int>(std::ceil(longest)), 1, 16) : 1;

    double sum = 0;
    float largest = 0;
    int count = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; i + j < n; ++j) {
            const float u = (static_cast<float>(i) + 1.0f / 3.0f) / static_cast<float>(n);
            const float v = (static_cast<float>(j) + 1.0f / 3.0f) / static_cast<float>(n);
            const Vec2 at = (1.0f - u - v) * uv[0] + u * uv[1] + v * uv[2];
            const float value = luminance(factor * Vec3(lookup_srgb(texture, ref.uv_transform * Vec3(at, 1.0f))));
            sum += static_cast<double>(value);
            largest = std::max(largest, value);
            ++count;
        }
    }
    return {static_cast<float>(sum / count), largest};
}

}  // namespace

void append_emissive_triangles(const World& world, uint32_t surface_index, Surface& surface,
                               std::vector<EmissiveTriangle>& out) {
    const Primitive& primitive = *surface.primitive;
    const Material& material = world.materials[surface.material];
    const SurfaceTransform& transform = world.transforms[surface.transform];
    const Vec3 factor = material.emissive_factor * material.emissive_strength;
    const std::vector<Vec2>* uv = nullptr;
    if (material.emissive.valid() && !primitive.uv[material.emissive.uv_set & 1u].empty()) {
        uv = &primitive.uv[material.emissive.uv_set & 1u];
    }

    surface.first_emissive = static_cast<uint32_t>(out.size());
    out.reserve(out.size() + primitive.triangles.size());
    for (uint32_t t = 0; t < primitive.triangles.size(); ++t) {
        Vec3u index = primitive.triangles[t];
        if (transform.flips) std::swap(index.y, index.z);
        Vec3 p[3];
        for (int i = 0; i < 3; ++i) {
            p[i] = surface.positions[index[i]];
            if (!surface.positions_in_world) p[i] = transform.world_from_object * Vec4(p[i], 1.0f);
        }
        EmissiveTriangle light;
        light.p0 = p[0];
        light.edge1 = p[1] - p[0];
        light.edge2 = p[2] - p[0];
        light.surface = surface_index;
        light.triangle = t;
        light.two_sided = material.double_sided;

        // A triangle must stay reachable as long as a texel of it may shine: the grid can miss some, so its choice
        // never falls below a hundredth of the factor's unless the grid saw every texel black.
        light.mean_radiance = luminance(factor);
        if (uv != nullptr) {
            const Vec2 corners[3] = {(*uv)[index.x], (*uv)[index.y], (*uv)[index.z]};
            const TextureMean texture =
                mean_over_triangle(world.textures[material.emissive.texture.value], material.emissive, factor, corners);
            light.mean_radiance = std::max(texture.mean, 0.01f * std::max(texture.largest, 0.01f * luminance(factor)));
        }
        out.push_back(light);
    }
}

}  // namespace candela
