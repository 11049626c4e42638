// SPDX-License-Identifier: MIT
#include "renderer/world/surface_point.h"

namespace candela {

namespace {

template <typename T>
T interpolate(const std::vector<T>& values, const Vec3u& index, const Vec3& weight) {
    return weight.x * values[index.x] + weight.y * values[index.y] + weight.z * values[index.z];
}

float determinant(const Vec2& a, const Vec2& b) {
    return a.x * b.y - a.y * b.x;
}

// The tangent along +u of a triangle without stored tangents, from its edges in space and in uv.
Vec4 triangle_tangent(const Vec3& edge1, const Vec3& edge2, const Vec2& uv1, const Vec2& uv2) {
    const bool mirrored = determinant(uv1, uv2) < 0.0f;
    return Vec4((edge1 * uv2.y - edge2 * uv1.y) * (mirrored ? -1.0f : 1.0f), mirrored ? 1.0f : -1.0f);
}

// How high over the surface a direction mirrored at n is, and how high it has to be.
struct MirroredHeight {
    Vec3 mirrored;
    float height, lowest;

    MirroredHeight(const Vec3& n, const Vec3& ng, const Vec3& wo)
        : mirrored(2.0f * glm::dot(n, wo) * n - wo),
          height(glm::dot(mirrored, ng)),
          lowest(std::min(1e-2f, 0.9f * glm::dot(ng, wo))) {}
};

// Bends n until it mirrors wo to the surface's own side. Both normals are unit vectors; wo is on the side of ng.
Vec3 bend_towards(const Vec3& n, const Vec3& ng, const Vec3& wo) {
    if (!bends_towards(n, ng, wo)) return n;
    const auto [mirrored, height, lowest] = MirroredHeight(n, ng, wo);
    const Vec3 lifted = mirrored + (lowest - height) * ng;
    const Vec3 half = wo + lifted / std::max(glm::length(lifted), 1e-12f);
    const float length = glm::length(half);
    return length > 1e-6f && glm::dot(half, wo) > 0.0f ? half / length : ng;
}

OrthonormalFrame frame_with_tangent(const Vec3& normal, const Vec3& tangent, float sign) {
    const Vec3 across = tangent - glm::dot(tangent, normal) * normal;
    const float length = glm::length(across);
    if (!(length > 1e-12f) || !std::isfinite(length)) return OrthonormalFrame::from_normal(normal);
    const Vec3 t = across / length;
    return {t, sign * glm::cross(normal, t), normal};
}

}  // namespace

bool bends_towards(const Vec3& shading_normal, const Vec3& geometric_normal, const Vec3& wo) noexcept {
    const MirroredHeight at(shading_normal, geometric_normal, wo);
    return !(at.height >= at.lowest && glm::dot(shading_normal, wo) > 0.0f);
}

SurfacePoint make_surface_point(const World& world, const Hit& hit, const Vec3& wo,
                                const RayFootprint& footprint) noexcept {
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
    Vec3 magnitudes = glm::abs(p0) + glm::abs(edge1) + glm::abs(edge2);
    if (!surface.positions_in_world) {
        const Mat3 linear(transform.world_from_object);
        const Mat3 absolute(glm::abs(linear[0]), glm::abs(linear[1]), glm::abs(linear[2]));
        magnitudes = absolute * magnitudes + 2.0f * glm::abs(Vec3(transform.world_from_object[3]));
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
    point.error_m = surface_error_m(magnitudes, normal);

    // Interpolate what the vertices carry.
    for (int set = 0; set < 2; ++set) {
        if (!primitive.uv[set].empty()) point.uv[set] = interpolate(primitive.uv[set], index, weight);
    }
    if (footprint.width_m > 0.0f && surface.filters_textures && doubled_area > 0.0f) {
        // A cone of width w covers w²/cos θ of the surface; the triangle tells how much uv that is.
        const float cosine = std::max(std::abs(glm::dot(normal, wo)), 1e-3f);
        const float uv_per_area = sqr(footprint.width_m) / (cosine * doubled_area);
        for (int set = 0; set < 2; ++set) {
            const std::vector<Vec2>& uv = primitive.uv[set];
            if (uv.empty()) continue;
            point.footprint[set] = {
                uv_per_area * std::abs(determinant(uv[index.y] - uv[index.x], uv[index.z] - uv[index.x])),
                footprint.share, footprint.u_level};
        }
    }
    if (!primitive.colors.empty()) point.color = interpolate(primitive.colors, index, weight);
    Vec3 shading_normal = normal;
    if (!primitive.normals.empty()) {
        const Vec3 n = transform.world_from_normal * interpolate(primitive.normals, index, weight);
        const float length = glm::length(n);
        if (length > 0.0f) shading_normal = n / length;
    }

    // Normal maps tilt the normal in the tangent frame of the front side.
    const bool anisotropic = material.anisotropy.strength > 0.0f;
    const Vec3 smooth_normal = shading_normal;
    Vec4 tangent(0);
    if (material.normal.valid() || material.clearcoat.normal.valid() || anisotropic) {
        const TextureRef& along = material.normal.valid()             ? material.normal
                                  : material.clearcoat.normal.valid() ? material.clearcoat.normal
                                                                      : material.anisotropy.texture;
        if (!primitive.tangents.empty()) {
            tangent = interpolate(primitive.tangents, index, weight);
            tangent = Vec4(Mat3(transform.world_from_object) * Vec3(tangent),
                           (tangent.w < 0.0f) == transform.flips ? 1.0f : -1.0f);
        } else if (const std::vector<Vec2>& uv = primitive.uv[along.uv_set & 1u]; !uv.empty()) {
            tangent = triangle_tangent(edge1, edge2, uv[index.y] - uv[index.x], uv[index.z] - uv[index.x]);
            if (transform.flips) tangent.w = -tangent.w;
        }
    }
    const auto mapped_normal = [&](const TextureRef& map, float scale) {
        const Vec3 texel(lookup_linear(world.textures[map.texture.value], texture_uv(map, point.uv)));
        const Vec3 tilt = (texel * 2.0f - 1.0f) * Vec3(scale, scale, 1.0f);
        const Vec3 mapped = frame_with_tangent(smooth_normal, Vec3(tangent), tangent.w).world_from_local(tilt);
        const float length = glm::length(mapped);
        return length > 0.0f ? mapped / length : smooth_normal;
    };
    if (material.normal.valid()) shading_normal = mapped_normal(material.normal, material.normal_scale);
    const float side = point.front_face ? 1.0f : -1.0f;
    const Vec3 normal_towards_wo = bend_towards(side * shading_normal, point.geometric_normal, wo);
    point.bent = normal_towards_wo != side * shading_normal;
    if (material.clearcoat.factor > 0.0f) {
        const Vec3 coat = material.clearcoat.normal.valid()
                              ? mapped_normal(material.clearcoat.normal, material.clearcoat.normal_scale)
                              : smooth_normal;
        point.coat_normal = bend_towards(side * coat, point.geometric_normal, wo);
    }

    // The frame follows the direction of the anisotropy: the tangent turned by the factor's angle and the texture's.
    if (!anisotropic) {
        point.shading = OrthonormalFrame::from_normal(normal_towards_wo);
        return point;
    }
    Vec2 direction(std::cos(material.anisotropy.rotation_radians), std::sin(material.anisotropy.rotation_radians));
    point.anisotropy_strength = material.anisotropy.strength;
    if (material.anisotropy.texture.valid()) {
        const Vec4 texel = lookup_linear(world.textures[material.anisotropy.texture.texture.value],
                                         texture_uv(material.anisotropy.texture, point.uv));
        const Vec2 turned = Vec2(texel) * 2.0f - 1.0f;
        direction =
            Vec2(direction.x * turned.x - direction.y * turned.y, direction.y * turned.x + direction.x * turned.y);
        point.anisotropy_strength *= texel.b;
    }
    const OrthonormalFrame around = frame_with_tangent(smooth_normal, Vec3(tangent), tangent.w);
    point.shading = frame_with_tangent(normal_towards_wo, around.world_from_local(Vec3(direction, 0.0f)), 1.0f);
    return point;
}

void prefetch_triangle(const World& world, const Hit& hit) noexcept {
    if (hit.valid()) __builtin_prefetch(&world.surfaces[hit.surface].primitive->triangles[hit.triangle]);
}

void prefetch_vertices(const World& world, const Hit& hit) noexcept {
    if (!hit.valid()) return;
    const Surface& surface = world.surfaces[hit.surface];
    const Primitive& primitive = *surface.primitive;
    const Vec3u index = primitive.triangles[hit.triangle];
    for (const uint32_t i : {index.x, index.y, index.z}) {
        __builtin_prefetch(surface.positions + i);
        if (!primitive.normals.empty()) __builtin_prefetch(&primitive.normals[i]);
        if (!primitive.uv[0].empty()) __builtin_prefetch(&primitive.uv[0][i]);
    }
}

Vec2 texture_uv(const TextureRef& ref, const Vec2 uv[2]) noexcept {
    return ref.uv_transform * Vec3(uv[ref.uv_set & 1u], 1.0f);
}

Vec2 texture_uv(const TextureRef& ref, const Primitive& primitive, uint32_t triangle, float u, float v) noexcept {
    const std::vector<Vec2>& uv = primitive.uv[ref.uv_set & 1u];
    const Vec2 at = uv.empty() ? Vec2(0) : interpolate(uv, primitive.triangles[triangle], Vec3(1.0f - u - v, u, v));
    return ref.uv_transform * Vec3(at, 1.0f);
}

}  // namespace candela
