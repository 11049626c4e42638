// SPDX-License-Identifier: MIT
// What rays see: an immutable compilation of a Scene. Only data; the queries are free functions.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "renderer/accel/accel.h"
#include "renderer/bsdf/bsdf.h"
#include "renderer/lights/lights.h"
#include "renderer/math/frame.h"
#include "renderer/scene/scene.h"
#include "renderer/texture/texture.h"

namespace candela {

// A placed primitive: what Hit::surface counts.
struct Surface {
    const Primitive* primitive = nullptr;
    uint32_t material = 0;                    // index in World::materials
    uint32_t transform = 0;                   // index in World::transforms
    uint32_t first_emissive = invalid_index;  // Lights::triangles index of its triangle 0; invalid: does not emit
    uint32_t instance = 0;                    // Scene::instances index
};

struct SurfaceTransform {
    glm::mat4x3 world_from_object{1.0f};
    Mat3 world_from_normal{1.0f};  // inverse transpose, up to scale
    bool flips = false;            // negative determinant: winding is reversed
};

struct World {
    std::shared_ptr<const Scene> scene;
    std::vector<Surface> surfaces;
    std::vector<SurfaceTransform> transforms;
    std::vector<Material> materials;  // the scene's, with the default material last
    std::vector<TextureView> textures;
    Lights lights;
    std::vector<std::vector<Vec3>> baked_positions;  // world-space vertices of meshes placed once
    std::unique_ptr<Accel> accel;
    Bounds3 bounds;
    uint64_t triangle_count = 0;        // as placed
    std::vector<std::string> warnings;  // dropped instances and the like
};

struct BuildOptions {
    // Used when the scene has no environment of its own; none: black.
    std::optional<Environment> environment;
    std::function<void(float)> progress;        // 0..1, any thread
    const std::atomic<bool>* cancel = nullptr;  // set: the build ends soon with AccelError "cancelled"
};

// Instances whose transform is singular or not finite are dropped with a warning.
std::shared_ptr<const World> build_world(std::shared_ptr<const Scene> scene, const BuildOptions& options = {});

// A world that shares everything with another but the environment (geometry and BVH are not built again).
// (World holds the shareable part behind shared_ptr where that needs it.)

// A hit turned into something to shade.
struct SurfacePoint {
    Vec3 position{0};          // on the triangle
    Vec3 geometric_normal{0};  // unit, on the side of wo
    OrthonormalFrame shading;  // normal on the side of wo, normal map applied
    Vec2 uv[2]{};
    Vec4 color{1};  // vertex colour
    uint32_t material = 0;
    uint32_t surface = 0, triangle = 0;
    bool front_face = true;  // wo is on the front side of the triangle
};

// wo: unit, back along the ray.
SurfacePoint make_surface_point(const World& world, const Hit& hit, const Vec3& wo) noexcept;

// Evaluates all textures of the material once.
struct ShadedMaterial {
    Bsdf bsdf;
    Vec3 emission{0};  // radiance towards wo; 0 on the side that does not emit
    bool unlit = false;
    Vec3 unlit_color{0};
};
ShadedMaterial shade_material(const World& world, const SurfacePoint& point) noexcept;

// Radiance that a point of an emissive surface sends towards a receiver; cos_on_light is the cosine between the
// light's front normal and the direction to the receiver (negative: from the back).
Vec3 emitted_radiance(const World& world, uint32_t surface, uint32_t triangle, float u, float v,
                      float cos_on_light) noexcept;

// Opacity 0..1 of a surface at a point: 1, the mask's decision, or the blend's alpha.
float surface_opacity(const World& world, uint32_t surface, uint32_t triangle, float u, float v) noexcept;

}  // namespace candela
