// SPDX-License-Identifier: MIT
// What an Accel holds: Embree's scenes, and the tables that turn its ids into surfaces. Private to this room.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "renderer/accel/accel.h"
#include "renderer/accel/embree.h"

namespace candela {

class BuildProgress;

// The largest coordinate that Embree accepts is 1.844e18; squares of limits below must stay finite too.
inline constexpr double coordinate_limit = 1e18;

struct DeviceRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DeviceHandle = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using SceneHandle = std::unique_ptr<RTCSceneTy, SceneRelease>;

struct AccelTree {
    std::shared_ptr<const void> owner, rest;
    uint64_t triangles = 0;
    Bounds3 bounds;
    bool has_opacity = false;  // a filter is set
    SceneHandle scene;         // last: dies before the buffers
};

// Accels that can share trees: they have one Embree device. Trees of shapes that deform come back here when the last
// Accel that used them is gone, and serve the next pose. Safe to use from several threads.
class AccelFamily : public std::enable_shared_from_this<AccelFamily> {
  public:
    AccelFamily();

    RTCDevice device() const { return device_.get(); }
    uint64_t memory_bytes() const;
    // Of the calls that this thread has made since the last time; a cancelled build is none.
    void throw_if_failed();

    // Null: none waits.
    std::unique_ptr<AccelTree> take_spare(const void* rest);
    // Hands the tree out; who lets go of it last gives it back.
    std::shared_ptr<const AccelTree> share(std::unique_ptr<AccelTree> tree);

  private:
    void give_back(std::unique_ptr<AccelTree> tree) noexcept;
    static void on_error(void* user, RTCError code, const char* message);
    static bool on_memory(void* user, ssize_t bytes, bool post);

    std::atomic<int64_t> bytes_{0};
    std::mutex mutex_;
    std::string last_message_;
    DeviceHandle device_;
    struct Pool {
        size_t in_use = 0;
        std::vector<std::unique_ptr<AccelTree>> spares;
    };
    std::map<const void*, Pool> pools_;  // by AccelTree::rest
};

SceneHandle new_scene(AccelFamily& family, RTCBuildQuality quality, RTCSceneFlags flags);
void commit_scene(RTCScene scene, uint64_t triangles, BuildProgress& progress);
Bounds3 bounds_of_scene(RTCScene scene);

// The tree of a shape that has none yet; null when the build was cancelled.
std::shared_ptr<const AccelTree> make_tree(const std::shared_ptr<AccelFamily>& family, const AccelShape& shape,
                                           bool with_opacity, BuildProgress& progress, std::atomic<uint32_t>& built,
                                           std::atomic<uint32_t>& refitted);

// The tree over the instances.
struct AccelPlacement {
    struct Placed {
        std::shared_ptr<const AccelTree> tree;
        Mat4 world_from_object{1.0f};

        bool operator==(const Placed&) const = default;
    };

    std::shared_ptr<AccelFamily> family;
    std::vector<Placed> placed;  // by Embree's instance id
    Bounds3 bounds;
    // How far from the origin and how long a ray may be for Embree to accept it in object space too.
    double origin_limit = coordinate_limit, direction_limit = coordinate_limit;
    SceneHandle scene;  // null: nothing is placed
};

struct Accel::Impl {
    std::shared_ptr<AccelFamily> family;
    std::vector<std::shared_ptr<const AccelTree>> shapes;
    std::shared_ptr<const AccelTree> fixed;
    std::shared_ptr<const AccelPlacement> placement;
    // What rays run through, one after the other; null: nothing there.
    RTCScene fixed_scene = nullptr, placed_scene = nullptr;

    std::vector<uint32_t> fixed_surfaces;  // by geometry id
    std::vector<uint32_t> first_surfaces;  // by instance id

    OpacityFunction opacity = nullptr;
    TransmittanceFunction transmittance = nullptr;
    const void* opacity_user = nullptr;
    Bounds3 bounds;
    bool has_opacity = false;  // a filter is set somewhere
    float origin_limit_squared = 0;
    float direction_limit_squared = 0;
    AccelWork work;

    void build(const AccelInput& input, const std::function<void(float)>& progress, const std::atomic<bool>* cancel);

    uint32_t surface_of(uint32_t geometry_id, uint32_t instance_id) const noexcept {
        return instance_id == RTC_INVALID_GEOMETRY_ID ? fixed_surfaces[geometry_id]
                                                      : first_surfaces[instance_id] + geometry_id;
    }
};

// Embree's context of one query, extended by what the opacity filters need.
struct OpacityQuery {
    embree::QueryContext embree;  // first: Embree hands the filters a pointer to it
    const Accel::Impl* accel = nullptr;
    uint32_t alpha_seed = 0;
    Vec3 direction{0};
    bool opacity_alone = false;  // clear glass is not passed
    Vec3 transmittance{1.0f};
};

// Filters of geometries with has_opacity.
void filter_stochastic_hit(const RTCFilterFunctionNArguments* arguments);
void filter_shadow_hit(const RTCFilterFunctionNArguments* arguments);

}  // namespace candela
