// SPDX-License-Identifier: MIT
// What rays see: an immutable compilation of a Scene. Only data; the queries are free functions (surface_point.h).
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <span>
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
    bool filters_textures = false;  // its material reads colours from textures with smaller levels
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

// The vertices of a mesh as the accelerator traverses them: as modelled, or moved to world space.
struct MeshVertices {
    std::shared_ptr<const Mesh> mesh;
    std::optional<Mat4> world_from_object;         // what moved them
    std::vector<std::span<const Vec3>> positions;  // of each primitive: the mesh's own, or some of `copies`
    std::vector<std::vector<Vec3>> copies;         // padded
    bool finite = true;                            // all of them
};

// What lies under one tree of the accelerator.
struct WorldShape {
    std::vector<std::shared_ptr<const MeshVertices>> parts;  // one, but for what is fixed
    std::vector<uint8_t> has_opacity;                        // by primitive of all parts
    std::shared_ptr<const MeshVertices> rest;                // of a mesh that deforms: what the tree is laid out for
};

struct World {
    std::shared_ptr<const Scene> scene;
    std::vector<Surface> surfaces;
    std::vector<SurfaceTransform> transforms;
    std::vector<Material> materials;  // the scene's, with the default material last
    std::vector<TextureView> textures;
    std::vector<Medium> media;
    Lights lights;
    // What the accelerator traverses: meshes placed once that do not move, in world space, and those that are placed
    // several times, move or deform. Shapes stand in the order of the accelerator's; of those that nothing shows in
    // this pose there are no surfaces.
    WorldShape fixed;
    std::vector<WorldShape> shapes;
    std::vector<ImageAlpha> image_alpha;  // of each image, where it was looked at
    std::shared_ptr<const Accel> accel;   // its functions look at this world
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

// Meshes placed once that no animation moves are placed in world space under one tree; others are instances of trees of
// their own. Instances whose transform is not finite, or collapses the mesh to a line or a point, are dropped with a
// warning. Throws AccelError.
std::shared_ptr<const World> build_world(std::shared_ptr<const Scene> scene, const BuildOptions& options = {});

// The world of another pose of its scene, under the same environment: what rays see is that of build_world to the bit,
// but only trees of meshes that deform are fitted anew, and where things moved the one over the instances. Shares the
// rest with the world, which stays as it is. options.environment is not looked at; bodies that share faces are not
// looked for again. Throws AccelError.
std::shared_ptr<const World> with_pose(const std::shared_ptr<const World>& world, std::shared_ptr<const Scene> posed,
                                       const BuildOptions& options = {});

// The world of a scene whose pictures have come, from one that was built without them (without_pictures.h): nothing of
// the geometry is built again, and what rays see is that of build_world to the bit. keep_environment: in place of
// options.environment and the scene's. Throws AccelError.
std::shared_ptr<const World> with_pictures(const std::shared_ptr<const World>& world,
                                           std::shared_ptr<const Scene> scene, bool keep_environment,
                                           const BuildOptions& options = {});

// A world that shares everything with another but the environment; nothing of the geometry is built again.
std::shared_ptr<const World> with_environment(const std::shared_ptr<const World>& world,
                                              const std::optional<Environment>& environment);

}  // namespace candela
