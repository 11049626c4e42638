// SPDX-License-Identifier: MIT
// What rays see: an immutable compilation of a Scene. Only data; the queries are free functions (surface_point.h).
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/accel/accel.h"
#include "renderer/lights/lights.h"
#include "renderer/scene/scene.h"
#include "renderer/texture/texture.h"

namespace candela {

// A placed primitive: what Hit::surface counts.
struct Surface {
    const Primitive* primitive = nullptr;
    const Vec3* positions = nullptr;          // in world space if positions_in_world, else in object space
    uint32_t material = 0;                    // index in World::materials
    uint32_t transform = 0;                   // index in World::transforms
    uint32_t first_emissive = invalid_index;  // Lights::cells index of its triangle 0; invalid: does not emit
    uint32_t instance = 0;                    // Scene::instances index
    uint32_t medium = invalid_index;          // World::media index of what the surface encloses; invalid: nothing
    bool positions_in_world = false;
};

// What fills a body: a placed material with KHR_materials_volume.
struct Medium {
    float ior = 1;
    float dispersion = 0;  // 20 / Abbe number
    Vec3 absorption{0};    // per metre: Beer-Lambert
    // Where bodies overlap, the one of the highest rank is there: the smaller body, as ice in a drink and the drink in
    // its glass.
    uint32_t rank = 0;
};

struct SurfaceTransform {
    glm::mat4x3 world_from_object{1.0f};
    Mat3 world_from_normal{1.0f};  // inverse transpose up to a positive scale
    bool flips = false;            // negative determinant: the winding is reversed, as glTF demands
};

struct World {
    std::shared_ptr<const Scene> scene;
    std::vector<Surface> surfaces;
    std::vector<SurfaceTransform> transforms;
    std::vector<Material> materials;  // the scene's, with the default material last
    std::vector<TextureView> textures;
    std::vector<Medium> media;
    Lights lights;
    // What the accelerator traverses: world-space vertices of meshes placed once, object-space ones of shared meshes.
    std::vector<std::vector<Vec3>> positions;
    std::shared_ptr<const Accel> accel;
    // Set when another world built the accelerator, whose opacity function looks at that world.
    std::shared_ptr<const World> geometry_owner;
    Bounds3 bounds;
    uint64_t triangle_count = 0;        // as placed
    std::vector<std::string> warnings;  // dropped instances and the like
};

struct BuildOptions {
    // In place of the one that the scene brings along; none of either: black.
    std::optional<Environment> environment;
    std::function<void(float)> progress;        // 0..1, any thread
    const std::atomic<bool>* cancel = nullptr;  // set: the build ends soon with AccelError "cancelled"
};

// Meshes placed once are moved to world space; meshes placed several times share one BVH. Instances whose transform is
// not finite, or collapses the mesh to a line or a point, are dropped with a warning. Throws AccelError.
std::shared_ptr<const World> build_world(std::shared_ptr<const Scene> scene, const BuildOptions& options = {});

// A world that shares everything with another but the environment; nothing of the geometry is built again.
std::shared_ptr<const World> with_environment(const std::shared_ptr<const World>& world,
                                              const std::optional<Environment>& environment);

}  // namespace candela
