// SPDX-License-Identifier: MIT
// What an Accel holds: Embree's scenes, and the tables that turn its ids into surfaces. Private to this room.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "renderer/accel/accel.h"
#include "renderer/accel/embree.h"

namespace candela {

struct DeviceRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DeviceHandle = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using SceneHandle = std::unique_ptr<RTCSceneTy, SceneRelease>;

// Embree reports errors and memory by callbacks on the building threads. Outlives the device.
struct DeviceMonitor {
    std::atomic<int64_t> bytes{0};
    std::mutex mutex;
    std::string first_error;
};

struct Accel::Impl {
    // In the top scene, geometry i < world_count is world_geometry[i], and world_count + j is instances[j].
    struct PlacedGroup {
        uint32_t first_surface = 0;
        uint32_t first_offset = 0;  // of the group, in surface_offsets
    };

    DeviceMonitor monitor;
    DeviceHandle device;
    std::vector<SceneHandle> groups;
    SceneHandle top;

    std::vector<uint32_t> world_surfaces;   // by geometry id
    std::vector<PlacedGroup> placed;        // by instance id - world_count
    std::vector<uint32_t> surface_offsets;  // of all groups, one after the other, by geometry id
    uint32_t world_count = 0;

    OpacityFunction opacity = nullptr;
    TransmittanceFunction transmittance = nullptr;
    const void* opacity_user = nullptr;
    Bounds3 bounds;
    // Embree accepts coordinates up to 1.8e18, in object space too: squared limits for rays in world space.
    float origin_limit_squared = 0;
    float direction_limit_squared = 0;

    void build(const AccelInput& input, const std::function<void(float)>& progress, const std::atomic<bool>* cancel);

    uint32_t surface_of(uint32_t geometry_id, uint32_t instance_id) const noexcept {
        if (instance_id == RTC_INVALID_GEOMETRY_ID) return world_surfaces[geometry_id];
        const PlacedGroup& instance = placed[instance_id - world_count];
        return instance.first_surface + surface_offsets[instance.first_offset + geometry_id];
    }
};

// Embree's context of one query, extended by what the opacity filters need.
struct OpacityQuery {
    embree::QueryContext embree;  // first: Embree hands the filters a pointer to it
    const Accel::Impl* accel = nullptr;
    uint32_t alpha_seed = 0;
    Vec3 direction{0};
    Vec3 transmittance{1.0f};
};

// Filters of geometries with has_opacity.
void filter_stochastic_hit(const RTCFilterFunctionNArguments* arguments);
void filter_shadow_hit(const RTCFilterFunctionNArguments* arguments);

}  // namespace candela
