// SPDX-License-Identifier: MIT
// Trees of single shapes: how they are built, fitted to a pose, and used again.
#include "renderer/accel/accel_impl.h"
#include "renderer/accel/build_progress.h"

namespace candela {

namespace {

// For each rest, at least; otherwise as many as are in use, since each of them may be followed by one.
constexpr size_t most_spares = 2;

void set_filters(RTCGeometry geometry, bool filtered) {
    rtcSetGeometryIntersectFilterFunction(geometry, filtered ? filter_stochastic_hit : nullptr);
    rtcSetGeometryOccludedFilterFunction(geometry, filtered ? filter_shadow_hit : nullptr);
}

void set_positions(RTCGeometry geometry, std::span<const Vec3> positions) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                               sizeof(Vec3), positions.size());
}

bool is_empty(const AccelGeometry& geometry) {
    return geometry.triangles.empty() || geometry.positions.empty();
}

// Whether all corners of some triangle are in one place, or so near that Embree's arithmetic takes them for it.
bool has_point(std::span<const Vec3> positions, std::span<const Vec3u> triangles) {
    constexpr float nothing = 1e-30f;
    return std::any_of(triangles.begin(), triangles.end(), [&](const Vec3u& t) {
        const Vec3& p = positions[t.x];
        return max_component(glm::max(glm::abs(positions[t.y] - p), glm::abs(positions[t.z] - p))) < nothing;
    });
}

// Embree joins the trees of a shape's geometries by their extent, and its assertions end the process where what it
// joins has none. Such a pose gets a tree made from its triangles.
bool can_be_refitted(const AccelShape& shape) {
    const auto count = std::count_if(shape.geometries.begin(), shape.geometries.end(),
                                     [](const AccelGeometry& geometry) { return !is_empty(geometry); });
    if (count < 2) return true;
    return std::none_of(shape.geometries.begin(), shape.geometries.end(), [](const AccelGeometry& geometry) {
        return has_point(geometry.positions, geometry.triangles) ||
               has_point(geometry.rest_positions, geometry.triangles);
    });
}

// Lays out a tree of its own for every shape that deforms, for only two-level scenes can be refitted.
std::unique_ptr<AccelTree> build_tree(AccelFamily& family, const AccelShape& shape, bool deforms, bool with_opacity,
                                      BuildProgress& progress) {
    auto tree = std::make_unique<AccelTree>();
    tree->owner = deforms ? nullptr : shape.owner;
    if (deforms) tree->rest = shape.rest;
    tree->scene = deforms ? new_scene(family, RTC_BUILD_QUALITY_LOW, RTC_SCENE_FLAG_DYNAMIC)
                          : new_scene(family, RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_NONE);
    for (uint32_t i = 0; i < shape.geometries.size(); ++i) {
        const AccelGeometry& source = shape.geometries[i];
        if (is_empty(source)) continue;
        tree->triangles += source.triangles.size();
        RTCGeometry geometry = rtcNewGeometry(family.device(), RTC_GEOMETRY_TYPE_TRIANGLE);
        set_positions(geometry, deforms ? source.rest_positions : source.positions);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, source.triangles.data(), 0,
                                   sizeof(Vec3u), source.triangles.size());
        rtcSetGeometryMask(geometry, 0xffffffffu);
        if (deforms) rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
        if (with_opacity && source.has_opacity) {
            set_filters(geometry, true);
            tree->has_opacity = true;
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(tree->scene.get(), geometry, i);
        rtcReleaseGeometry(geometry);
    }
    family.throw_if_failed();
    commit_scene(tree->scene.get(), tree->triangles, progress);
    family.throw_if_failed();
    return tree;
}

void refit_tree(AccelFamily& family, AccelTree& tree, const AccelShape& shape, bool with_opacity,
                BuildProgress& progress) {
    tree.has_opacity = false;
    for (uint32_t i = 0; i < shape.geometries.size(); ++i) {
        const AccelGeometry& source = shape.geometries[i];
        if (is_empty(source)) continue;
        RTCGeometry geometry = rtcGetGeometry(tree.scene.get(), i);
        set_positions(geometry, source.positions);
        rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
        const bool has_opacity = with_opacity && source.has_opacity;
        set_filters(geometry, has_opacity);
        tree.has_opacity |= has_opacity;
        rtcCommitGeometry(geometry);
    }
    family.throw_if_failed();
    commit_scene(tree.scene.get(), tree.triangles, progress);
    family.throw_if_failed();
    tree.owner = shape.owner;
}

}  // namespace

AccelFamily::AccelFamily() {
    device_.reset(rtcNewDevice(nullptr));
    if (!device_) throw AccelError("the ray accelerator can't start: Embree makes no device on this machine");
    rtcSetDeviceErrorFunction(device_.get(), on_error, this);
    rtcSetDeviceMemoryMonitorFunction(device_.get(), on_memory, this);
}

void AccelFamily::on_error(void* user, RTCError code, const char* message) {
    // The cancellation of a build is asked for, not an error.
    if (code == RTC_ERROR_CANCELLED) return;
    auto& family = *static_cast<AccelFamily*>(user);
    const std::lock_guard lock(family.mutex_);
    family.last_message_ = message != nullptr && *message != 0 ? message : "no reason given by Embree";
}

bool AccelFamily::on_memory(void* user, ssize_t bytes, bool /*post*/) {
    static_cast<AccelFamily*>(user)->bytes_.fetch_add(bytes, std::memory_order_relaxed);
    return true;
}

uint64_t AccelFamily::memory_bytes() const {
    return static_cast<uint64_t>(std::max<int64_t>(bytes_.load(std::memory_order_relaxed), 0));
}

void AccelFamily::throw_if_failed() {
    const RTCError code = rtcGetDeviceError(device_.get());
    if (code == RTC_ERROR_NONE || code == RTC_ERROR_CANCELLED) return;
    if (code == RTC_ERROR_OUT_OF_MEMORY) throw AccelError("not enough memory for the ray accelerator");
    const std::lock_guard lock(mutex_);
    throw AccelError("the ray accelerator failed: " + last_message_);
}

std::unique_ptr<AccelTree> AccelFamily::take_spare(const void* rest) {
    const std::lock_guard lock(mutex_);
    const auto pool = pools_.find(rest);
    if (pool == pools_.end() || pool->second.spares.empty()) return nullptr;
    std::unique_ptr<AccelTree> tree = std::move(pool->second.spares.back());
    pool->second.spares.pop_back();
    return tree;
}

std::shared_ptr<const AccelTree> AccelFamily::share(std::unique_ptr<AccelTree> tree) {
    if (!tree->rest) return {tree.release(), [family = shared_from_this()](AccelTree* last) { delete last; }};
    {
        // Room to come back to is made now, when a lack of memory can still be said.
        const std::lock_guard lock(mutex_);
        Pool& pool = pools_[tree->rest.get()];
        ++pool.in_use;
        pool.spares.reserve(std::max(most_spares, pool.in_use));
    }
    return {tree.release(),
            [family = shared_from_this()](AccelTree* last) { family->give_back(std::unique_ptr<AccelTree>(last)); }};
}

void AccelFamily::give_back(std::unique_ptr<AccelTree> tree) noexcept {
    // The pose's vertices are needed no longer.
    tree->owner.reset();
    const std::lock_guard lock(mutex_);
    Pool& pool = pools_.find(tree->rest.get())->second;
    --pool.in_use;
    if (pool.spares.size() < std::max(most_spares, pool.in_use) && pool.spares.size() < pool.spares.capacity())
        pool.spares.push_back(std::move(tree));
}

SceneHandle new_scene(AccelFamily& family, RTCBuildQuality quality, RTCSceneFlags flags) {
    SceneHandle scene(rtcNewScene(family.device()));
    if (!scene) throw AccelError("not enough memory for the ray accelerator");
    rtcSetSceneBuildQuality(scene.get(), quality);
    rtcSetSceneFlags(scene.get(), flags);
    return scene;
}

void commit_scene(RTCScene scene, uint64_t triangles, BuildProgress& progress) {
    if (progress.cancelled()) return;
    SceneProgress share{progress, triangles};
    rtcSetSceneProgressMonitorFunction(scene, SceneProgress::monitor, &share);
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    if (!progress.cancelled()) share.reach(triangles);
}

Bounds3 bounds_of_scene(RTCScene scene) {
    Bounds3 out;
    RTCBounds box;
    rtcGetSceneBounds(scene, &box);
    if (box.lower_x <= box.upper_x) {
        out.lower = {box.lower_x, box.lower_y, box.lower_z};
        out.upper = {box.upper_x, box.upper_y, box.upper_z};
    }
    return out;
}

std::shared_ptr<const AccelTree> make_tree(const std::shared_ptr<AccelFamily>& family, const AccelShape& shape,
                                           bool with_opacity, BuildProgress& progress, std::atomic<uint32_t>& built,
                                           std::atomic<uint32_t>& refitted) {
    for (const AccelGeometry& geometry : shape.geometries) {
        if (shape.rest && geometry.rest_positions.size() != geometry.positions.size())
            throw AccelError("a shape that deforms has not as many vertices at rest as in its pose");
    }
    const bool refits = shape.rest != nullptr && can_be_refitted(shape);
    std::unique_ptr<AccelTree> tree = refits ? family->take_spare(shape.rest.get()) : nullptr;
    if (!tree) {
        tree = build_tree(*family, shape, refits, with_opacity, progress);
        ++built;
    }
    if (refits && !progress.cancelled()) {
        refit_tree(*family, *tree, shape, with_opacity, progress);
        ++refitted;
    }
    if (progress.cancelled()) return nullptr;
    tree->bounds = bounds_of_scene(tree->scene.get());
    return family->share(std::move(tree));
}

}  // namespace candela
