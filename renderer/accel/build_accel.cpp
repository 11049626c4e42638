// SPDX-License-Identifier: MIT
// The build: one BVH for each group, in parallel, then one over the world's geometry and the placed groups.
#include <tbb/parallel_for.h>

#include "renderer/accel/accel_impl.h"

namespace candela {

namespace {

// The largest coordinate that Embree accepts is 1.844e18; squares of limits below must stay finite too.
constexpr double coordinate_limit = 1e18;
constexpr double inverse_limit = 1e12;

void on_device_error(void* user, RTCError code, const char* message) {
    // The cancellation of a build is asked for, not an error.
    if (code == RTC_ERROR_CANCELLED) return;
    auto& monitor = *static_cast<DeviceMonitor*>(user);
    const std::lock_guard lock(monitor.mutex);
    if (!monitor.first_error.empty()) return;
    if (code == RTC_ERROR_OUT_OF_MEMORY) {
        monitor.first_error = "not enough memory for the ray accelerator";
    } else {
        monitor.first_error = std::string("the ray accelerator failed: ") +
                              (message != nullptr && *message != 0 ? message : "no reason given by Embree");
    }
}

bool on_device_memory(void* user, ssize_t bytes, bool /*post*/) {
    static_cast<DeviceMonitor*>(user)->bytes.fetch_add(bytes, std::memory_order_relaxed);
    return true;
}

void throw_if_failed(DeviceMonitor& monitor) {
    const std::lock_guard lock(monitor.mutex);
    if (!monitor.first_error.empty()) throw AccelError(monitor.first_error);
}

// Adds up the progress of scenes that build at the same time, in triangles, and passes on whole percents in order.
class BuildProgress {
  public:
    BuildProgress(uint64_t total, const std::function<void(float)>& report, const std::atomic<bool>* cancel)
        : total_(std::max<uint64_t>(total, 1)), report_(report), cancel_(cancel) {}

    bool cancelled() const { return cancel_ != nullptr && cancel_->load(std::memory_order_relaxed); }

    void add(uint64_t triangles) {
        if (!report_) return;
        const uint64_t done = done_.fetch_add(triangles, std::memory_order_relaxed) + triangles;
        const auto percent = static_cast<int>(std::min<uint64_t>(100 * done / total_, 100));
        int last = last_percent_.load(std::memory_order_relaxed);
        while (percent > last) {
            if (last_percent_.compare_exchange_weak(last, percent, std::memory_order_relaxed)) {
                report_(static_cast<float>(percent) * 0.01f);
                return;
            }
        }
    }

  private:
    uint64_t total_;
    const std::function<void(float)>& report_;
    const std::atomic<bool>* cancel_;
    std::atomic<uint64_t> done_{0};
    std::atomic<int> last_percent_{-1};
};

// The share of one scene. Embree's fractions may step back and come from several threads.
struct SceneProgress {
    BuildProgress& all;
    uint64_t triangles = 0;
    std::atomic<uint64_t> done{0};

    void reach(uint64_t now) {
        uint64_t before = done.load(std::memory_order_relaxed);
        while (now > before) {
            if (done.compare_exchange_weak(before, now, std::memory_order_relaxed)) {
                all.add(now - before);
                return;
            }
        }
    }

    static bool monitor(void* user, double fraction) {
        auto& self = *static_cast<SceneProgress*>(user);
        const double reached = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(self.triangles);
        self.reach(static_cast<uint64_t>(reached));
        return !self.all.cancelled();
    }
};

uint64_t triangle_count(std::span<const AccelGeometry> geometries) {
    uint64_t count = 0;
    for (const AccelGeometry& geometry : geometries)
        count += geometry.triangles.size();
    return count;
}

void attach(RTCDevice device, RTCScene scene, uint32_t geometry_id, const AccelGeometry& source, bool filtered) {
    if (source.triangles.empty() || source.positions.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, source.positions.data(), 0,
                               sizeof(Vec3), source.positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, source.triangles.data(), 0,
                               sizeof(Vec3u), source.triangles.size());
    rtcSetGeometryMask(geometry, 0xffffffffu);
    if (filtered) {
        rtcSetGeometryIntersectFilterFunction(geometry, filter_stochastic_hit);
        rtcSetGeometryOccludedFilterFunction(geometry, filter_shadow_hit);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, geometry_id);
    rtcReleaseGeometry(geometry);
}

SceneHandle new_scene(RTCDevice device) {
    SceneHandle scene(rtcNewScene(device));
    if (!scene) throw AccelError("not enough memory for the ray accelerator");
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_MEDIUM);
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_NONE);
    return scene;
}

void commit(RTCScene scene, uint64_t triangles, BuildProgress& all) {
    if (all.cancelled()) return;
    SceneProgress progress{all, triangles};
    rtcSetSceneProgressMonitorFunction(scene, SceneProgress::monitor, &progress);
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    if (!all.cancelled()) progress.reach(triangles);
}

// The largest factor by which the inverse of the transform stretches a vector, and how far it moves the origin.
struct InverseReach {
    double stretch = 0, offset = 0;
    bool usable = false;
};

InverseReach inverse_reach(const Mat4& world_from_object) {
    InverseReach out;
    const glm::dmat3 linear(world_from_object);
    const double determinant = glm::determinant(linear);
    // Embree inverts in single precision: the determinant must survive there.
    if (!(std::abs(determinant) > 1e-37) || !(std::abs(determinant) < 1e37)) return out;
    const glm::dmat3 inverse = glm::inverse(linear);
    for (int c = 0; c < 3; ++c)
        out.stretch += glm::dot(inverse[c], inverse[c]);
    out.stretch = std::sqrt(out.stretch);
    out.offset = glm::length(inverse * glm::dvec3(world_from_object[3]));
    out.usable = out.stretch < inverse_limit && out.offset < 0.5 * coordinate_limit;
    return out;
}

}  // namespace

bool can_be_instanced(const Mat4& world_from_object) noexcept {
    return inverse_reach(world_from_object).usable;
}

void Accel::Impl::build(const AccelInput& input, const std::function<void(float)>& progress,
                        const std::atomic<bool>* cancel) {
    if (cancel != nullptr && cancel->load(std::memory_order_relaxed)) throw AccelError("cancelled");
    device.reset(rtcNewDevice(nullptr));
    if (!device) throw AccelError("the ray accelerator can't start: Embree makes no device on this machine");
    rtcSetDeviceErrorFunction(device.get(), on_device_error, &monitor);
    rtcSetDeviceMemoryMonitorFunction(device.get(), on_device_memory, &monitor);
    opacity = input.opacity;
    transmittance = input.transmittance;
    opacity_user = input.opacity_user;
    const bool with_opacity = opacity != nullptr;

    const uint64_t world_triangles = triangle_count(input.world_geometry);
    const uint64_t top_work = world_triangles + input.instances.size();
    uint64_t total_work = top_work;
    for (const auto& group : input.groups)
        total_work += triangle_count(group);
    BuildProgress all(total_work, progress, cancel);

    // Each group is a scene of its own; small ones fill the cores only when many build at once.
    std::vector<uint32_t> first_offsets;
    first_offsets.reserve(input.groups.size());
    for (const auto& group : input.groups) {
        first_offsets.push_back(static_cast<uint32_t>(surface_offsets.size()));
        groups.push_back(new_scene(device.get()));
        for (uint32_t i = 0; i < group.size(); ++i) {
            surface_offsets.push_back(group[i].surface);
            attach(device.get(), groups.back().get(), i, group[i], with_opacity && group[i].has_opacity);
        }
    }
    tbb::parallel_for(size_t{0}, groups.size(),
                      [&](size_t i) { commit(groups[i].get(), triangle_count(input.groups[i]), all); });
    throw_if_failed(monitor);
    if (all.cancelled()) throw AccelError("cancelled");

    // The top level: geometry in world space first, then the placed groups.
    top = new_scene(device.get());
    world_count = static_cast<uint32_t>(input.world_geometry.size());
    for (uint32_t i = 0; i < world_count; ++i) {
        world_surfaces.push_back(input.world_geometry[i].surface);
        attach(device.get(), top.get(), i, input.world_geometry[i],
               with_opacity && input.world_geometry[i].has_opacity);
    }
    double origin_limit = coordinate_limit;
    double direction_limit = coordinate_limit;
    for (uint32_t i = 0; i < input.instances.size(); ++i) {
        const AccelInstance& instance = input.instances[i];
        if (instance.group >= groups.size())
            throw AccelError("instance " + std::to_string(i) + " names a group that does not exist");
        const InverseReach reach = inverse_reach(instance.world_from_object);
        if (!reach.usable)
            throw AccelError("the transform of instance " + std::to_string(i) + " can't be inverted accurately enough");
        placed.push_back({instance.first_surface, first_offsets[instance.group]});
        if (triangle_count(input.groups[instance.group]) == 0) continue;
        origin_limit = std::min(origin_limit, (coordinate_limit - reach.offset) / reach.stretch);
        direction_limit = std::min(direction_limit, coordinate_limit / reach.stretch);
        RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, groups[instance.group].get());
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &instance.world_from_object);
        rtcSetGeometryMask(geometry, 0xffffffffu);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(top.get(), geometry, world_count + i);
        rtcReleaseGeometry(geometry);
    }
    throw_if_failed(monitor);
    origin_limit_squared = static_cast<float>(origin_limit * origin_limit);
    direction_limit_squared = static_cast<float>(direction_limit * direction_limit);
    commit(top.get(), top_work, all);
    throw_if_failed(monitor);
    if (all.cancelled()) throw AccelError("cancelled");

    RTCBounds box;
    rtcGetSceneBounds(top.get(), &box);
    if (box.lower_x <= box.upper_x) {
        bounds.lower = {box.lower_x, box.lower_y, box.lower_z};
        bounds.upper = {box.upper_x, box.upper_y, box.upper_z};
    }
}

}  // namespace candela
