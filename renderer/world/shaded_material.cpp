// SPDX-License-Identifier: MIT
#include "renderer/world/shaded_material.h"

#include "renderer/bsdf/thin_film.h"

namespace candela {

namespace {

// Texture lookups of one point, white where there is no texture.
class Texels {
  public:
    Texels(const World& world, const SurfacePoint& point) : world_(world), point_(point) {}

    Vec4 linear(const TextureRef& ref) const {
        return ref.valid() ? lookup_linear(world_.textures[ref.texture.value], texture_uv(ref, point_.uv)) : Vec4(1);
    }
    Vec4 srgb(const TextureRef& ref) const {
        return ref.valid() ? lookup_srgb(world_.textures[ref.texture.value], texture_uv(ref, point_.uv)) : Vec4(1);
    }
    // Colours, over the point's footprint.
    Vec4 color(const TextureRef& ref) const {
        if (!ref.valid()) return Vec4(1);
        TextureFootprint footprint = point_.footprint[ref.uv_set & 1u];
        const glm::mat3x2& m = ref.uv_transform;
        footprint.uv_area *= std::abs(m[0].x * m[1].y - m[0].y * m[1].x);
        return lookup_srgb(world_.textures[ref.texture.value], texture_uv(ref, point_.uv), footprint);
    }

  private:
    const World& world_;
    const SurfacePoint& point_;
};

// The reflectance at normal incidence with the colours of the film on top, for this direction.
Vec3 with_thin_film(const IridescenceLayer& film, const Texels& texels, float cos_o, const Vec3& f0) {
    const float factor = film.factor * texels.linear(film.texture).r;
    if (!(factor > 0.0f)) return f0;
    const float thickness = film.thickness.valid() ? lerp(film.thickness_minimum_nm, film.thickness_maximum_nm,
                                                          texels.linear(film.thickness).g)
                                                   : film.thickness_maximum_nm;
    const Vec3 reflectance = thin_film_reflectance(1.0f, film.ior, cos_o, thickness, f0);
    return glm::mix(f0, schlick_f0(reflectance, cos_o), factor);
}

// The bare coat of KHR_materials_clearcoat; its normal must see wo.
void add_coat(const ClearcoatLayer& coat, const Texels& texels, const SurfacePoint& point, const Vec3& wo, Bsdf& bsdf) {
    bsdf.coat = coat.factor * texels.linear(coat.texture).r;
    bsdf.coat_alpha = ggx_alpha(coat.roughness_factor * texels.linear(coat.roughness).g);
    const Vec3 normal = point.shading.local_from_world(point.coat_normal);
    bsdf.coat_normal = glm::dot(point.coat_normal, wo) > 0.0f ? glm::normalize(normal) : Vec3(0, 0, 1);
}

Vec3 emission_of(const Material& material, const Texels& texels) {
    Vec3 emission = material.emissive_factor * material.emissive_strength;
    if (material.emissive.valid()) emission *= Vec3(texels.color(material.emissive));
    return emission;
}

}  // namespace

ShadedMaterial shade_material(const World& world, const SurfacePoint& point, const Vec3& wo,
                              const InterfaceIndices& indices) noexcept {
    const Material& material = world.materials[point.material];
    const Texels texels(world, point);

    // Base colour: factor, texture and vertex colour multiply.
    Vec3 base_color = Vec3(material.base_color_factor) * Vec3(point.color);
    if (material.base_color.valid()) base_color *= Vec3(texels.color(material.base_color));
    ShadedMaterial shaded;
    if (material.unlit) {
        shaded.unlit = true;
        shaded.emission = base_color;
        return shaded;
    }
    base_color = glm::clamp(base_color, 0.0f, 1.0f);

    // Metal, roughness and the dielectric's reflectance.
    float metallic = material.metallic_factor;
    float roughness = material.roughness_factor;
    if (material.metallic_roughness.valid()) {
        const Vec4 texel = texels.linear(material.metallic_roughness);
        roughness *= texel.g;
        metallic *= texel.b;
    }
    const SpecularLayer& specular = material.specular;
    float specular_factor = specular.factor;
    if (specular.texture.valid()) specular_factor *= texels.linear(specular.texture).a;
    Vec3 specular_color = specular.color_factor;
    if (specular.color.valid()) specular_color *= Vec3(texels.color(specular.color));
    if (material.specular_glossiness) {
        const Vec4 texel = texels.srgb(material.specular_glossiness_texture);
        roughness = 1.0f - (1.0f - roughness) * texel.a;
        specular_color *= Vec3(texel);
    }
    const bool encloses_volume = material.has_volume();
    const bool inside = encloses_volume && !point.front_face;
    float eta = material.ior;
    if (encloses_volume && material.ior > 0.0f) {
        eta = indices.near > 0.0f ? indices.far / indices.near : (inside ? 1.0f / material.ior : material.ior);
    }
    Bsdf& bsdf = shaded.bsdf;
    bsdf = make_bsdf(base_color, metallic, roughness, eta, specular_factor, specular_color);
    if (material.specular_glossiness) {
        bsdf.dielectric_f0 = specular_color;
        bsdf.dielectric_f90 = 1.0f;
    }

    // The layers that the extensions add, each only where the material has it.
    const float cos_o = glm::dot(wo, point.shading.normal);
    if (material.iridescence.factor > 0.0f) {
        bsdf.dielectric_f0 = with_thin_film(material.iridescence, texels, cos_o, bsdf.dielectric_f0);
        bsdf.metal_f0 = with_thin_film(material.iridescence, texels, cos_o, bsdf.metal_f0);
    }
    if (material.anisotropy.strength > 0.0f) bsdf.alpha = anisotropic_alpha(roughness, point.anisotropy_strength);
    if (material.transmission.factor > 0.0f) {
        bsdf.transmission = material.transmission.factor * texels.linear(material.transmission.texture).r;
        bsdf.thin_walled = !encloses_volume;
    }
    if (const DiffuseTransmission& diffuse = material.diffuse_transmission; diffuse.factor > 0.0f) {
        bsdf.diffuse_transmission = diffuse.factor * texels.linear(diffuse.texture).a;
        bsdf.diffuse_transmission_color = diffuse.color_factor * Vec3(texels.color(diffuse.color));
    }
    // From inside a body neither coat nor sheen is on this side.
    if (!inside) {
        if (material.clearcoat.factor > 0.0f) add_coat(material.clearcoat, texels, point, wo, bsdf);
        if (max_component(material.sheen.color_factor) > 0.0f) {
            bsdf.sheen_color = material.sheen.color_factor * Vec3(texels.color(material.sheen.color));
            bsdf.sheen_alpha = sqr(material.sheen.roughness_factor * texels.linear(material.sheen.roughness).a);
        }
    }

    if (material.emits() && (point.front_face || material.double_sided)) {
        shaded.emission = emission_of(material, texels);
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
        emission *= Vec3(lookup_srgb(world.textures[material.emissive.texture.value],
                                     texture_uv(material.emissive, *surface.primitive, triangle, u, v)));
    }
    if (material.alpha_mode != AlphaMode::opaque) emission *= surface_opacity(world, surface_index, triangle, u, v);
    return emission;
}

float surface_opacity(const World& world, uint32_t surface_index, uint32_t triangle, float u, float v) noexcept {
    const Surface& surface = world.surfaces[surface_index];
    const Primitive& primitive = *surface.primitive;
    const Material& material = world.materials[surface.material];
    if (material.alpha_mode == AlphaMode::opaque) return 1.0f;

    float alpha = material.base_color_factor.a;
    if (!primitive.colors.empty()) {
        const Vec3u index = primitive.triangles[triangle];
        alpha *= (1.0f - u - v) * primitive.colors[index.x].a + u * primitive.colors[index.y].a +
                 v * primitive.colors[index.z].a;
    }
    if (material.base_color.valid()) {
        alpha *= lookup_alpha(world.textures[material.base_color.texture.value],
                              texture_uv(material.base_color, primitive, triangle, u, v));
    }
    if (material.alpha_mode == AlphaMode::mask) return alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
    return std::clamp(alpha, 0.0f, 1.0f);
}

Vec3 surface_transmittance(const World& world, uint32_t surface, uint32_t triangle, float u, float v,
                           const Vec3& direction) noexcept {
    const float opacity = surface_opacity(world, surface, triangle, u, v);
    Vec3 out(1.0f - opacity);
    if (opacity > 0.0f && world.materials[world.surfaces[surface].material].is_thin_glass()) {
        const Vec3 wo = -direction;
        const SurfacePoint point = make_surface_point(world, {0.0f, u, v, surface, triangle}, wo);
        const ShadedMaterial shaded = shade_material(world, point, wo);
        if (!shaded.unlit) {
            out += opacity * straight_transmittance(shaded.bsdf, point.shading.local_from_world(wo));
        }
    }
    return out;
}

}  // namespace candela
