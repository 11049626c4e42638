// SPDX-License-Identifier: MIT
#include "renderer/scene/color_mips.h"
#include "renderer/world/emissive.h"
#include "renderer/world/media.h"
#include "renderer/world/shaded_material.h"
#include "renderer/world/shape_table.h"

namespace candela {

namespace {

Vec3 transmittance_callback(const void* user, uint32_t surface, uint32_t triangle, float u, float v,
                            const Vec3& direction) noexcept {
    return surface_transmittance(*static_cast<const World*>(user), surface, triangle, u, v, direction);
}

float opacity_callback(const void* user, uint32_t surface, uint32_t triangle, float u, float v) noexcept {
    return surface_opacity(*static_cast<const World*>(user), surface, triangle, u, v);
}

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

bool filters_textures(const World& world, const Material& material) {
    const auto refs = color_textures(material);
    return std::any_of(refs.begin(), refs.end(), [&](const TextureRef* ref) {
        return ref->valid() && !world.textures[ref->texture.value].smaller.empty();
    });
}

void gather_lights(World& world, const World* before) {
    // Punctual lights are few; emissive triangles come in the order of their surfaces.
    for (const LightInstance& light : world.scene->light_instances) {
        world.lights.punctual.push_back(place_light(world.scene->lights[light.light.value], light.world_from_light));
    }
    for (uint32_t i = 0; i < world.surfaces.size(); ++i) {
        Surface& surface = world.surfaces[i];
        if (!world.materials[surface.material].emits()) continue;
        if (before == nullptr || !move_emissive_triangles(*before, world, i, surface, world.lights))
            append_emissive_triangles(world, i, surface, world.lights);
    }
    finish_lights(world.lights, world.bounds);
}

std::shared_ptr<const EnvironmentLight> make_environment(const std::optional<Environment>& environment) {
    return environment ? std::make_shared<const EnvironmentLight>(*environment) : nullptr;
}

// The world of a scene, sharing with `before` (null: nothing) what is the same there.
std::shared_ptr<World> compile(std::shared_ptr<const Scene> scene_pointer, const World* before,
                               const BuildOptions& options) {
    auto world = std::make_shared<World>();
    world->scene = std::move(scene_pointer);
    const Scene& scene = *world->scene;
    world->materials = scene.materials;
    world->materials.emplace_back();
    world->textures = make_texture_views(scene);

    // Give every placed primitive its surface, and its vertices to the accelerator.
    ShapeTable table(*world, before);
    AccelInput input;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.mesh(instance.mesh);
        if (mesh.primitives.empty()) continue;
        const TransformKind kind = classify_transform(instance.world_from_object);
        if (kind == TransformKind::unusable) {
            world->warnings.push_back(
                instance_name(scene, instance) +
                ": its transform is not finite, leads too far away or leaves no area, so it is not drawn");
            continue;
        }
        const ShapeTable::Place place = table.place(instance, kind);
        const bool in_world = place.vertices->world_from_object.has_value();
        const auto transform = static_cast<uint32_t>(world->transforms.size());
        world->transforms.push_back(make_surface_transform(instance.world_from_object));
        const auto first_surface = static_cast<uint32_t>(world->surfaces.size());
        if (place.shape != invalid_index)
            input.instances.push_back({place.shape, in_world ? Mat4(1.0f) : instance.world_from_object, first_surface});

        for (uint32_t k = 0; k < mesh.primitives.size(); ++k) {
            const Primitive& primitive = mesh.primitives[k];
            const MaterialId material = material_of(scene, primitive);
            Surface surface;
            surface.primitive = &primitive;
            surface.positions = place.vertices->positions[k].data();
            surface.material = material.valid() ? material.value : static_cast<uint32_t>(world->materials.size() - 1);
            surface.transform = transform;
            surface.instance = i;
            surface.positions_in_world = in_world;
            surface.filters_textures = filters_textures(*world, world->materials[surface.material]);
            if (place.shape == invalid_index) input.fixed_surfaces.push_back(first_surface + k);
            world->surfaces.push_back(surface);
            world->triangle_count += primitive.triangles.size();
        }
    }
    table.keep_hidden();
    table.describe(input);

    input.opacity = opacity_callback;
    input.transmittance = transmittance_callback;
    input.opacity_user = world.get();
    world->accel = Accel::build(input, options.progress, options.cancel);
    world->bounds = world->accel->bounds();
    gather_media(*world);
    return world;
}

}  // namespace

std::shared_ptr<const World> with_pictures(const std::shared_ptr<const World>& before,
                                           std::shared_ptr<const Scene> scene, bool keep_environment,
                                           const BuildOptions& options) {
    const std::shared_ptr<World> world = compile(std::move(scene), before.get(), options);
    world->warnings = before->warnings;
    world->lights.environment =
        keep_environment ? before->lights.environment
                         : make_environment(options.environment ? options.environment : world->scene->environment);
    gather_lights(*world, before.get());
    return world;
}

std::shared_ptr<const World> build_world(std::shared_ptr<const Scene> scene, const BuildOptions& options) {
    const std::shared_ptr<World> world = compile(std::move(scene), nullptr, options);
    warn_of_shared_faces(*world);
    world->lights.environment = make_environment(options.environment ? options.environment : world->scene->environment);
    gather_lights(*world, nullptr);
    return world;
}

std::shared_ptr<const World> with_pose(const std::shared_ptr<const World>& before, std::shared_ptr<const Scene> posed,
                                       const BuildOptions& options) {
    const std::shared_ptr<World> world = compile(std::move(posed), before.get(), options);
    world->lights.environment = before->lights.environment;
    gather_lights(*world, before.get());
    return world;
}

std::shared_ptr<const World> with_environment(const std::shared_ptr<const World>& world,
                                              const std::optional<Environment>& environment) {
    auto out = std::make_shared<World>(*world);
    out->accel = world->accel->with_user(out.get());
    out->lights.environment = make_environment(environment);
    weigh_lights(out->lights, out->bounds);
    return out;
}

}  // namespace candela
