// SPDX-License-Identifier: MIT
#include "renderer/world/surface_point.h"

namespace candela {

namespace {

template <typename T>
T interpolate(const std::vector<T>& values, const Vec3u& index, const Vec3& weight) {
    return weight.x * values[index.x] + weight.y * values[index.y] + weight.z * values[index.z];
}

Vec2 texture_uv(const TextureRef& ref, const Vec2 uv[2]) {
    return ref.uv_transform * Vec3(uv[ref.uv_set & 1u], 1.0f);
}

Vec2 texture_uv(const TextureRef& ref, const Primitive& primitive, const Vec3u& index, const Vec3& weight) {
    const std::vector<Vec2>& uv = primitive.uv[ref.uv_set & 1u];
    return ref.uv_transform * Vec3(uv.empty() ? Vec2(0) : interpolate(uv, index, weight), 1.0f);
}

// The tangent along +u of a triangle without stored tangents, from its edges in space and in uv.
Vec4 triangle_tangent(const Vec3& edge1, const Vec3& edge2, const Vec2& uv1, const Vec2& uv2) {
    const float determinant = uv1.x * uv2.y - uv1.y * uv2.x;
    return Vec4((edge1 * uv2.y - edge2 * uv1.y) * (determinant < 0.0f ? -1.0f : 1.0f),
                determinant < 0.0f ? 1.0f : -1.0f);
}

// Turns n towards wo until it sees wo at a cosine of at least min_cosine.
Vec3 bend_towards(const Vec3& n, const Vec3& wo) {
    constexpr float min_cosine = 1e-2f;
    const float cosine = glm::dot(n, wo);
    if (cosine >= min_cosine) return n;
    const Vec3 across = n - cosine * wo;
    const float length = glm::length(across);
    if (!(length > 1e-6f)) return wo;
    return min_cosine * wo + std::sqrt(1.0f - min_cosine * min_cosine) / length * across;
}

OrthonormalFrame frame_with_tangent(const Vec3& normal, const Vec3& tangent, float sign) {
    const Vec3 across = tangent - glm::dot(tangent, normal) * normal;
    const float length = glm::length(across);
    if (!(length > 1e-12f) || !std::isfinite(length)) return OrthonormalFrame::from_normal(normal);
    const Vec3 t = across / length;
    return {t, sign * glm::cross(normal, t), normal};
}

}  // namespace

SurfacePoint make_surface_point(const World& world, const Hit& hit, const Vec3& wo) noexcept {
    const Surface& surface = world.surfaces[hit.surface];
    const Primitive& primitive = *surface.primitive;
    const Material& material = world.materials[surface.material];
    const SurfaceTransform& transform = world.transforms[surface.transform];
    const Vec3u index = primitive.triangles[hit.triangle];
    const Vec3 weight(1.0f - hit.u - hit.v, hit.u, hit.v);

    SurfacePoint point;
    point.surface = hit.surface;
    point.triangle = hit.triangle;
    point.material = surface.material;

    // The position comes from the triangle, not from the ray, so that its error does not grow with the distance.
    Vec3 p0 = surface.positions[index.x];
    Vec3 edge1 = surface.positions[index.y] - p0;
    Vec3 edge2 = surface.positions[index.z] - p0;
    Vec3 position = p0 + hit.u * edge1 + hit.v * edge2;
    if (!surface.positions_in_world) {
        const Mat3 linear(transform.world_from_object);
        edge1 = linear * edge1;
        edge2 = linear * edge2;
        position = transform.world_from_object * Vec4(position, 1.0f);
    }
    point.position = position;

    // The front of the triangle is where its vertices run counter-clockwise, mirrored transforms the other way round.
    Vec3 normal = glm::cross(edge1, edge2);
    const float doubled_area = glm::length(normal);
    normal = doubled_area > 0.0f ? normal / doubled_area : wo;
    if (transform.flips) normal = -normal;
    point.front_face = glm::dot(normal, wo) >= 0.0f;
    point.geometric_normal = point.front_face ? normal : -normal;

    // Interpolate what the vertices carry.
    for (int set = 0; set < 2; ++set) {
        if (!primitive.uv[set].empty()) point.uv[set] = interpolate(primitive.uv[set], index, weight);
    }
    if (!primitive.colors.empty()) point.color = interpolate(primitive.colors, index, weight);
    Vec3 shading_normal = normal;
    if (!primitive.normals.empty()) {
        const Vec3 n = transform.world_from_normal * interpolate(primitive.normals, index, weight);
        const float length = glm::length(n);
        if (length > 0.0f) shading_normal = n / length;
    }

    // The normal map tilts the normal in the tangent frame of the front side.
    if (material.normal.valid()) {
        Vec4 tangent(0);
        if (!primitive.tangents.empty()) {
            tangent = interpolate(primitive.tangents, index, weight);
            tangent = Vec4(Mat3(transform.world_from_object) * Vec3(tangent),
                           (tangent.w < 0.0f) == transform.flips ? 1.0f : -1.0f);
        } else if (const std::vector<Vec2>& uv = primitive.uv[material.normal.uv_set & 1u]; !uv.empty()) {
            tangent = triangle_tangent(edge1, edge2, uv[index.y] - uv[index.x], uv[index.z] - uv[index.x]);
            if (transform.flips) tangent.w = -tangent.w;
        }
        const Vec3 texel(
            lookup_linear(world.textures[material.normal.texture.value], texture_uv(material.normal, point.uv)));
        const Vec3 tilt = (texel * 2.0f - 1.0f) * Vec3(material.normal_scale, material.normal_scale, 1.0f);
        const Vec3 mapped = frame_with_tangent(shading_normal, Vec3(tangent), tangent.w).world_from_local(tilt);
        const float length = glm::length(mapped);
        if (length > 0.0f) shading_normal = mapped / length;
    }
    if (!point.front_face) shading_normal = -shading_normal;
    point.shading = OrthonormalFrame::from_normal(bend_towards(shading_normal, wo));
    return point;
}

ShadedMaterial shade_material(const World& world, const SurfacePoint& point) noexcept {
    const Material& material = world.materials[point.material];

    // Base colour: factor, texture and vertex colour multiply.
    Vec3 base_color = Vec3(material.base_color_factor) * Vec3(point.color);
    if (material.base_color.valid()) {
        base_color *= Vec3(
            lookup_srgb(world.textures[material.base_color.texture.value], texture_uv(material.base_color, point.uv)));
    }
    ShadedMaterial shaded;
    if (material.unlit) {
        shaded.unlit = true;
        shaded.emission = base_color;
        return shaded;
    }

    float metallic = material.metallic_factor;
    float roughness = material.roughness_factor;
    if (material.metallic_roughness.valid()) {
        const Vec4 texel = lookup_linear(world.textures[material.metallic_roughness.texture.value],
                                         texture_uv(material.metallic_roughness, point.uv));
        roughness *= texel.g;
        metallic *= texel.b;
    }
    shaded.bsdf = make_bsdf(glm::clamp(base_color, 0.0f, 1.0f), metallic, roughness, material.ior,
                            material.specular_factor, material.specular_color_factor);

    if (material.emits() && (point.front_face || material.double_sided)) {
        shaded.emission = material.emissive_factor * material.emissive_strength;
        if (material.emissive.valid()) {
            shaded.emission *= Vec3(
                lookup_srgb(world.textures[material.emissive.texture.value], texture_uv(material.emissive, point.uv)));
        }
    }
    return shaded;
}

Vec3 emitted_radiance(const World& world, uint32_t surface_index, uint32_t triangle, float u, float v) noexcept {
    const Surface& surface = world.surfaces[surface_index];
    const Material& material = world.materials[surface.material];
    // An EmissiveTriangle of a mirrored surface has its second and third vertex exchanged.
    if (world.transforms[surface.transform].flips) std::swap(u, v);
    Vec3 emission = material.emissive_factor * material.emissive_strength;
    if (material.emissive.valid()) {
        const Vec3u index = surface.primitive->triangles[triangle];
        emission *=
            Vec3(lookup_srgb(world.textures[material.emissive.texture.value],
                             texture_uv(material.emissive, *surface.primitive, index, Vec3(1.0f - u - v, u, v))));
    }
    if (material.alpha_mode != AlphaMode::opaque) emission *= surface_opacity(world, surface_index, triangle, u, v);
    return emission;
}

float surface_opacity(const World& world, uint32_t surface_index, uint32_t triangle, float u, float v) noexcept {
    const Surface& surface = world.surfaces[surface_index];
    const Primitive& primitive = *surface.primitive;
    const Material& material = world.materials[surface.material];
    if (material.alpha_mode == AlphaMode::opaque) return 1.0f;

    const Vec3u index = primitive.triangles[triangle];
    const Vec3 weight(1.0f - u - v, u, v);
    float alpha = material.base_color_factor.a;
    if (!primitive.colors.empty()) alpha *= interpolate(primitive.colors, index, weight).a;
    if (material.base_color.valid()) {
        alpha *= lookup_alpha(world.textures[material.base_color.texture.value],
                              texture_uv(material.base_color, primitive, index, weight));
    }
    if (material.alpha_mode == AlphaMode::mask) return alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
    return std::clamp(alpha, 0.0f, 1.0f);
}

}  // namespace candela
