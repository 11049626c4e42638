// SPDX-License-Identifier: MIT
#include "renderer/world/emissive.h"
#include "renderer/world/media.h"
#include "renderer/world/placement.h"
#include "renderer/world/shaded_material.h"
#include "renderer/world/world.h"

namespace candela {

namespace {

Vec3 transmittance_callback(const void* user, uint32_t surface, uint32_t triangle, float u, float v,
                            const Vec3& direction) noexcept {
    return surface_transmittance(*static_cast<const World*>(user), surface, triangle, u, v, direction);
}

float opacity_callback(const void* user, uint32_t surface, uint32_t triangle, float u, float v) noexcept {
    return surface_opacity(*static_cast<const World*>(user), surface, triangle, u, v);
}

bool has_alpha(const ImageRgba8& image) {
    return std::any_of(image.pixels().begin(), image.pixels().end(), [](const Rgba8& p) { return p.a != 255; });
}

// Which primitives let light through somewhere, so that only they pay for the opacity function. Images are looked at
// once.
class OpacityScan {
  public:
    explicit OpacityScan(const Scene& scene) : scene_(scene), image_alpha_(scene.images.size(), unknown) {}

    bool may_be_transparent(const Material& material, const Primitive& primitive) {
        if (material.alpha_mode == AlphaMode::opaque) return false;
        const float limit = material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff : 1.0f;
        if (material.base_color_factor.a < limit) return true;
        if (material.base_color.valid() && texture_has_alpha(material.base_color.texture)) return true;
        return std::any_of(primitive.colors.begin(), primitive.colors.end(),
                           [&](const Vec4& color) { return color.a < 1.0f; });
    }

  private:
    enum Known : uint8_t { unknown, opaque, transparent };

    bool texture_has_alpha(TextureId id) {
        const ImageId image = scene_.textures[id.value].image;
        if (!image.valid() || !scene_.images[image.value].pixels) return false;
        Known& known = image_alpha_[image.value];
        if (known == unknown) known = has_alpha(*scene_.images[image.value].pixels) ? transparent : opaque;
        return known == transparent;
    }

    const Scene& scene_;
    std::vector<Known> image_alpha_;
};

PlacedLight place_light(const PunctualLight& light, const Mat4& world_from_light) {
    PlacedLight out;
    out.kind = light.kind;
    out.position = Vec3(world_from_light[3]);
    const Vec3 axis = -Vec3(world_from_light[2]);
    out.direction = glm::length(axis) > 0.0f ? glm::normalize(axis) : Vec3(0, 0, -1);
    out.intensity = light.color * light.intensity;
    out.cos_inner = std::cos(light.inner_cone_radians);
    out.cos_outer = std::cos(light.outer_cone_radians);
    return out;
}

std::string instance_name(const Scene& scene, const Instance& instance) {
    const std::string& node = instance.node.valid() ? scene.nodes[instance.node.value].name : std::string();
    return node.empty() ? "/nodes/" + std::to_string(instance.node.value) : "node \"" + node + "\"";
}

void gather_lights(World& world, const std::optional<Environment>& chosen) {
    // Punctual lights are few; emissive triangles come in the order of their surfaces.
    for (const LightInstance& light : world.scene->light_instances) {
        world.lights.punctual.push_back(place_light(world.scene->lights[light.light.value], light.world_from_light));
    }
    for (uint32_t i = 0; i < world.surfaces.size(); ++i) {
        Surface& surface = world.surfaces[i];
        if (world.materials[surface.material].emits()) append_emissive_triangles(world, i, surface, world.lights);
    }
    const std::optional<Environment>& environment = chosen ? chosen : world.scene->environment;
    if (environment) world.lights.environment.emplace(*environment);
    finish_lights(world.lights, world.bounds);
}

}  // namespace

std::shared_ptr<const World> build_world(std::shared_ptr<const Scene> scene_pointer, const BuildOptions& options) {
    auto world = std::make_shared<World>();
    world->scene = std::move(scene_pointer);
    const Scene& scene = *world->scene;
    world->materials = scene.materials;
    world->materials.emplace_back();
    world->textures = make_texture_views(scene);

    // Count how often each mesh is placed: once means world space, more means a shared BVH.
    std::vector<uint32_t> uses(scene.meshes.size(), 0);
    std::vector<TransformKind> kinds;
    kinds.reserve(scene.instances.size());
    for (const Instance& instance : scene.instances) {
        kinds.push_back(classify_transform(instance.world_from_object));
        if (kinds.back() == TransformKind::invertible) ++uses[instance.mesh.value];
    }

    // Give every placed primitive its surface, and its vertices to the accelerator.
    AccelInput input;
    OpacityScan opacity(scene);
    std::vector<uint32_t> group_of_mesh(scene.meshes.size(), invalid_index);
    std::vector<uint32_t> group_positions(scene.meshes.size(), 0);
    const auto geometry_of = [&](const Primitive& primitive, const std::vector<Vec3>& positions, uint32_t surface) {
        // In whichever variant, so that switching them needs no other accelerator.
        const auto lets_light_through = [&](MaterialId id) {
            const Material& material = world->materials[id.valid() ? id.value : world->materials.size() - 1];
            return opacity.may_be_transparent(material, primitive) || material.is_thin_glass();
        };
        AccelGeometry geometry;
        geometry.positions = std::span(positions).first(primitive.positions.size());
        geometry.triangles = primitive.triangles;
        geometry.has_opacity = lets_light_through(primitive.material);
        for (const VariantMaterial& each : primitive.variants)
            geometry.has_opacity = geometry.has_opacity || lets_light_through(each.material);
        geometry.surface = surface;
        return geometry;
    };
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.mesh(instance.mesh);
        if (mesh.primitives.empty()) continue;
        if (kinds[i] == TransformKind::unusable) {
            world->warnings.push_back(instance_name(scene, instance) +
                                      ": its transform is not finite or leaves no area, so it is not drawn");
            continue;
        }
        const bool shared = kinds[i] == TransformKind::invertible && uses[instance.mesh.value] > 1;
        const auto transform = static_cast<uint32_t>(world->transforms.size());
        world->transforms.push_back(make_surface_transform(instance.world_from_object));
        const auto first_surface = static_cast<uint32_t>(world->surfaces.size());

        // The first placement of a shared mesh makes the group.
        uint32_t& group = group_of_mesh[instance.mesh.value];
        const bool new_group = shared && group == invalid_index;
        if (new_group) {
            group = static_cast<uint32_t>(input.groups.size());
            input.groups.emplace_back();
            group_positions[instance.mesh.value] = static_cast<uint32_t>(world->positions.size());
        }

        for (uint32_t k = 0; k < mesh.primitives.size(); ++k) {
            const Primitive& primitive = mesh.primitives[k];
            const MaterialId material_id = material_of(scene, primitive);
            const uint32_t material =
                material_id.valid() ? material_id.value : static_cast<uint32_t>(world->materials.size() - 1);
            if (!shared) {
                world->positions.push_back(padded_positions(primitive.positions, &instance.world_from_object));
                input.world_geometry.push_back(geometry_of(primitive, world->positions.back(), first_surface + k));
            } else if (new_group) {
                world->positions.push_back(padded_positions(primitive.positions, nullptr));
                input.groups[group].push_back(geometry_of(primitive, world->positions.back(), k));
            }
            Surface surface;
            surface.primitive = &primitive;
            surface.positions =
                (shared ? world->positions[group_positions[instance.mesh.value] + k] : world->positions.back()).data();
            surface.material = material;
            surface.transform = transform;
            surface.instance = i;
            surface.positions_in_world = !shared;
            world->surfaces.push_back(surface);
            world->triangle_count += primitive.triangles.size();
        }
        if (shared) input.instances.push_back({group, instance.world_from_object, first_surface});
    }

    // Build the accelerator, then the lights, which want the bounds.
    input.opacity = opacity_callback;
    input.transmittance = transmittance_callback;
    input.opacity_user = world.get();
    world->accel = Accel::build(input, options.progress, options.cancel);
    world->bounds = world->accel->bounds();
    gather_media(*world);
    gather_lights(*world, options.environment);
    return world;
}

std::shared_ptr<const World> with_environment(const std::shared_ptr<const World>& world,
                                              const std::optional<Environment>& environment) {
    auto out = std::make_shared<World>();
    out->scene = world->scene;
    out->surfaces = world->surfaces;
    out->transforms = world->transforms;
    out->materials = world->materials;
    out->textures = world->textures;
    out->media = world->media;
    out->lights = world->lights;
    out->bounds = world->bounds;
    out->triangle_count = world->triangle_count;
    out->warnings = world->warnings;
    out->accel = world->accel;
    out->geometry_owner = world->geometry_owner ? world->geometry_owner : world;
    out->lights.environment.reset();
    if (environment) out->lights.environment.emplace(*environment);
    finish_lights(out->lights, out->bounds);
    return out;
}

}  // namespace candela
