// SPDX-License-Identifier: MIT
// The ray accelerator: the only room that includes Embree. Two levels at most: meshes used once are given in world
// space, meshes used several times as instances of one shared BVH.
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

// One placed primitive. The buffers must outlive the Accel and have 16 readable bytes after the last position.
struct AccelGeometry {
    std::span<const Vec3> positions;
    std::span<const Vec3u> triangles;
    bool has_opacity = false;  // hits are offered to the two functions
    uint32_t surface = 0;      // reported in hits; for shared groups: added to the instance's first_surface
};

// A group of primitives with one BVH, placed one or more times.
struct AccelInstance {
    uint32_t group = 0;
    Mat4 world_from_object{1.0f};
    uint32_t first_surface = 0;
};

struct AccelInput {
    std::vector<AccelGeometry> world_geometry;       // already in world space
    std::vector<std::vector<AccelGeometry>> groups;  // in object space
    std::vector<AccelInstance> instances;            // of groups; invertible transforms only
    OpacityFunction opacity = nullptr;
    TransmittanceFunction transmittance = nullptr;  // null: 1 - opacity
    const void* opacity_user = nullptr;             // handed to both
};

struct AccelError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Whether a transform may be that of an AccelInstance: finite, and with an inverse that single precision can hold.
// Other geometry must be moved to world space.
bool can_be_instanced(const Mat4& world_from_object) noexcept;

class Accel {
  public:
    struct Impl;  // private to the room

    // Builds with all cores. progress gets 0..1 from any thread. Throws AccelError; "cancelled" when *cancel was set.
    static std::unique_ptr<Accel> build(const AccelInput& input, const std::function<void(float)>& progress = {},
                                        const std::atomic<bool>* cancel = nullptr);
    ~Accel();
    Accel(const Accel&) = delete;
    Accel& operator=(const Accel&) = delete;

    // The nearest hit. A surface of opacity a is passed with probability 1-a, decided by a hash of alpha_seed and the
    // triangle, so that the decision does not depend on the order of traversal. A ray that is not finite hits nothing.
    Hit intersect(const Ray& ray, uint32_t alpha_seed) const noexcept;
    // The share of light that passes from origin to t_max: the product of the transmittances of the surfaces between.
    Vec3 transmittance(const Ray& ray) const noexcept;

    Bounds3 bounds() const;
    uint64_t memory_bytes() const;

  private:
    explicit Accel(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace candela
