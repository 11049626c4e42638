// SPDX-License-Identifier: MIT
// The ray accelerator: the only room that includes Embree. What never moves lies in world space under one tree; shapes
// that are placed several times, or that move, are instances of a tree of their own. Trees are immutable and shared:
// the Accel of another pose builds only what is new in it, while rays still run through the old one.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "renderer/math/bounds.h"
#include "renderer/math/ray.h"

namespace candela {

inline constexpr uint32_t invalid_index = 0xffffffffu;

// The nearest hit. surface is the World-wide index of the placed primitive, triangle the index in its primitive;
// the point is (1-u-v)·p0 + u·p1 + v·p2.
struct Hit {
    float distance = infinity;
    float u = 0, v = 0;
    uint32_t surface = invalid_index;
    uint32_t triangle = 0;

    bool valid() const { return surface != invalid_index; }
};

// How opaque (0..1) the surface is at a point; called from many threads at once, during traversal.
using OpacityFunction = float (*)(const void* user, uint32_t surface, uint32_t triangle, float u, float v) noexcept;

// The share of light that passes the point in a straight line along the unit vector `direction`.
using TransmittanceFunction = Vec3 (*)(const void* user, uint32_t surface, uint32_t triangle, float u, float v,
                                       const Vec3& direction) noexcept;

// A tree over the triangles of one shape, and all that it needs to live.
struct AccelTree;

// One primitive. Buffers of positions have 16 readable bytes after the last one.
struct AccelGeometry {
    std::span<const Vec3> positions;
    std::span<const Vec3u> triangles;
    bool has_opacity = false;              // hits are offered to the two functions
    std::span<const Vec3> rest_positions;  // as many; only of a shape that deforms
};

// Primitives under one tree.
struct AccelShape {
    // The tree, where an earlier Accel has made it; all other members are ignored then.
    std::shared_ptr<const AccelTree> tree;
    std::vector<AccelGeometry> geometries;
    std::shared_ptr<const void> owner;  // keeps the positions alive, and the triangles
    // Set for a shape that deforms: keeps the positions at rest and the triangles alive, and is the same for all poses.
    // The tree is laid out for the rest and fitted to the pose, so that a pose has the same tree whatever was before.
    // All positions must be finite.
    std::shared_ptr<const void> rest;
};

// A shape placed in the world. Hits report first_surface + the index of the primitive in its shape.
struct AccelInstance {
    uint32_t shape = 0;
    Mat4 world_from_object{1.0f};
    uint32_t first_surface = 0;
};

class Accel;

struct AccelInput {
    AccelShape fixed;                      // in world space
    std::vector<uint32_t> fixed_surfaces;  // reported in hits, for each primitive of fixed
    std::vector<AccelShape> shapes;        // in object space
    std::vector<AccelInstance> instances;  // of shapes; invertible transforms only
    OpacityFunction opacity = nullptr;
    TransmittanceFunction transmittance = nullptr;  // null: 1 - opacity
    const void* opacity_user = nullptr;             // handed to both
    const Accel* relative = nullptr;                // the Accel that has made the trees named above
};

struct AccelError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Whether a transform may be that of an AccelInstance: finite, and with an inverse that single precision can hold.
// Other geometry must be moved to world space.
bool can_be_instanced(const Mat4& world_from_object) noexcept;

// What it took to make an Accel.
struct AccelWork {
    uint32_t trees_built = 0;     // from their triangles
    uint32_t trees_refitted = 0;  // fitted to a pose, counted in trees_built as well where they were laid out first
    uint32_t trees_shared = 0;
    bool placement_built = false;  // the tree over the instances
};

class Accel {
  public:
    struct Impl;  // private to the room

    // Builds with all cores. progress gets 0..1 from any thread. Throws AccelError; "cancelled" when *cancel was set.
    static std::unique_ptr<Accel> build(const AccelInput& input, const std::function<void(float)>& progress = {},
                                        const std::atomic<bool>* cancel = nullptr);
    ~Accel();
    Accel(const Accel&) = delete;
    Accel& operator=(const Accel&) = delete;

    // The same trees, whose functions are handed another user.
    std::unique_ptr<Accel> with_user(const void* opacity_user) const;

    // The nearest hit. A surface of opacity a is passed with probability 1-a, decided by a hash of alpha_seed and the
    // triangle, so that the decision does not depend on the order of traversal. A ray that is not finite hits nothing.
    Hit intersect(const Ray& ray, uint32_t alpha_seed) const noexcept;
    // The share of light that passes from origin to t_max: the product of the transmittances of the surfaces between.
    Vec3 transmittance(const Ray& ray) const noexcept;

    // The chance that intersect() passes all surfaces from origin to t_max: the product of what their opacities leave.
    float passage(const Ray& ray) const noexcept;
    // Whether it may be anything but 0 and 1.
    bool has_opacity() const noexcept;

    // The trees of AccelInput::fixed and of AccelInput::shapes, for the next Accel.
    std::shared_ptr<const AccelTree> fixed_tree() const;
    std::shared_ptr<const AccelTree> shape_tree(size_t shape) const;

    Bounds3 bounds() const;
    const AccelWork& work() const;
    // Of this Accel, its living relatives, and the trees that wait to be fitted to another pose.
    uint64_t memory_bytes() const;

  private:
    explicit Accel(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace candela
