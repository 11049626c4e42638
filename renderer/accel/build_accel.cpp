// SPDX-License-Identifier: MIT
// The build: one tree for each new shape, in parallel, then one over the instances.
#include <tbb/parallel_for.h>

#include "renderer/accel/accel_impl.h"
#include "renderer/accel/build_progress.h"

namespace candela {

namespace {

constexpr double inverse_limit = 1e12;

uint64_t work_of(const AccelShape& shape) {
    uint64_t count = 0;
    if (shape.tree) return count;
    for (const AccelGeometry& geometry : shape.geometries)
        count += geometry.triangles.size();
    return count;
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

std::shared_ptr<const AccelPlacement> place(const std::shared_ptr<AccelFamily>& family,
                                            std::vector<AccelPlacement::Placed> placed, BuildProgress& progress) {
    auto out = std::make_shared<AccelPlacement>();
    out->family = family;
    out->placed = std::move(placed);
    SceneHandle scene = new_scene(*family, RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_NONE);
    uint64_t count = 0;
    for (uint32_t i = 0; i < out->placed.size(); ++i) {
        const auto& [tree, world_from_object] = out->placed[i];
        const InverseReach reach = inverse_reach(world_from_object);
        if (!reach.usable)
            throw AccelError("the transform of instance " + std::to_string(i) + " can't be inverted accurately enough");
        if (tree->triangles == 0) continue;
        out->origin_limit = std::min(out->origin_limit, (coordinate_limit - reach.offset) / reach.stretch);
        out->direction_limit = std::min(out->direction_limit, coordinate_limit / reach.stretch);
        RTCGeometry geometry = rtcNewGeometry(family->device(), RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, tree->scene.get());
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &world_from_object);
        rtcSetGeometryMask(geometry, 0xffffffffu);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene.get(), geometry, i);
        rtcReleaseGeometry(geometry);
        ++count;
    }
    family->throw_if_failed();
    if (count == 0) return out;
    commit_scene(scene.get(), out->placed.size(), progress);
    family->throw_if_failed();
    if (!progress.cancelled()) out->bounds = bounds_of_scene(scene.get());
    out->scene = std::move(scene);
    return out;
}

}  // namespace

bool can_be_instanced(const Mat4& world_from_object) noexcept {
    return inverse_reach(world_from_object).usable;
}

void Accel::Impl::build(const AccelInput& input, const std::function<void(float)>& progress,
                        const std::atomic<bool>* cancel) {
    if (cancel != nullptr && cancel->load(std::memory_order_relaxed)) throw AccelError("cancelled");
    family = input.relative != nullptr ? input.relative->impl_->family : std::make_shared<AccelFamily>();
    opacity = input.opacity;
    transmittance = input.transmittance;
    opacity_user = input.opacity_user;

    uint64_t total_work = work_of(input.fixed) + input.instances.size();
    for (const AccelShape& shape : input.shapes)
        total_work += work_of(shape);
    BuildProgress all(total_work, progress, cancel);

    // Each shape is a scene of its own; small ones fill the cores only when many build at once.
    std::atomic<uint32_t> built{0}, refitted{0}, shared{0};
    const auto tree_of = [&](const AccelShape& shape) {
        if (shape.tree) ++shared;
        return shape.tree ? shape.tree : make_tree(family, shape, opacity != nullptr, all, built, refitted);
    };
    shapes.resize(input.shapes.size());
    tbb::parallel_for(size_t{0}, shapes.size() + 1, [&](size_t i) {
        if (i > 0) {
            shapes[i - 1] = tree_of(input.shapes[i - 1]);
        } else if (input.fixed.tree || !input.fixed.geometries.empty()) {
            fixed = tree_of(input.fixed);
        }
    });
    if (all.cancelled()) throw AccelError("cancelled");

    // The instances, unless a relative has the very same.
    std::vector<AccelPlacement::Placed> placed;
    placed.reserve(input.instances.size());
    for (uint32_t i = 0; i < input.instances.size(); ++i) {
        const AccelInstance& instance = input.instances[i];
        if (instance.shape >= shapes.size())
            throw AccelError("instance " + std::to_string(i) + " names a shape that does not exist");
        placed.push_back({shapes[instance.shape], instance.world_from_object});
        first_surfaces.push_back(instance.first_surface);
    }
    if (input.relative != nullptr && input.relative->impl_->placement->placed == placed) {
        placement = input.relative->impl_->placement;
    } else {
        work.placement_built = !placed.empty();
        placement = place(family, std::move(placed), all);
    }
    if (all.cancelled()) throw AccelError("cancelled");

    has_opacity = (fixed && fixed->has_opacity) ||
                  std::any_of(shapes.begin(), shapes.end(), [](const auto& tree) { return tree->has_opacity; });
    fixed_surfaces = input.fixed_surfaces;
    fixed_scene = fixed && fixed->triangles > 0 ? fixed->scene.get() : nullptr;
    placed_scene = placement->scene.get();
    origin_limit_squared = static_cast<float>(placement->origin_limit * placement->origin_limit);
    direction_limit_squared = static_cast<float>(placement->direction_limit * placement->direction_limit);
    if (fixed) bounds = fixed->bounds;
    bounds.extend(placement->bounds);
    work.trees_built = built;
    work.trees_refitted = refitted;
    work.trees_shared = shared;
}

}  // namespace candela
