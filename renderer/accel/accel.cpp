// SPDX-License-Identifier: MIT
// The queries: what every ray runs through.
#include "renderer/accel/accel.h"

#include "renderer/accel/accel_impl.h"
#include "renderer/math/hash.h"

namespace candela {

namespace {

// Embree's build in Debian asserts on rays it dislikes, and the others may loop or miss: only sane rays go there. Every
// comparison is false for NaN.
bool is_traceable(const Accel::Impl& accel, const Ray& ray) {
    return glm::dot(ray.origin, ray.origin) <= accel.origin_limit_squared &&
           glm::dot(ray.direction, ray.direction) <= accel.direction_limit_squared && ray.t_max >= 0.0f;
}

void fill_ray(RTCRay& out, const Ray& ray) {
    out.org_x = ray.origin.x;
    out.org_y = ray.origin.y;
    out.org_z = ray.origin.z;
    out.tnear = 0.0f;
    out.dir_x = ray.direction.x;
    out.dir_y = ray.direction.y;
    out.dir_z = ray.direction.z;
    out.time = 0.0f;
    out.tfar = ray.t_max;
    out.mask = 0xffffffffu;
    out.id = 0;
    out.flags = 0;
}

struct Candidate {
    uint32_t surface = 0, triangle = 0;
    float u = 0, v = 0;
};

// Single rays offer one candidate at a time.
Candidate candidate_of(const Accel::Impl& accel, const RTCFilterFunctionNArguments& arguments) {
    RTCHitN* hit = arguments.hit;
    return {accel.surface_of(RTCHitN_geomID(hit, 1, 0), RTCHitN_instID(hit, 1, 0, 0)), RTCHitN_primID(hit, 1, 0),
            RTCHitN_u(hit, 1, 0), RTCHitN_v(hit, 1, 0)};
}

}  // namespace

void filter_stochastic_hit(const RTCFilterFunctionNArguments* arguments) {
    if (arguments->valid[0] != -1) return;
    const auto& query = *reinterpret_cast<const OpacityQuery*>(arguments->context);
    const Candidate at = candidate_of(*query.accel, *arguments);
    const float opacity = query.accel->opacity(query.accel->opacity_user, at.surface, at.triangle, at.u, at.v);
    const uint32_t hash = hash_combine(hash_combine(query.alpha_seed, at.surface), at.triangle);
    // An opacity that is not a number counts as 0.
    if (!(unit_float(hash) < opacity)) arguments->valid[0] = 0;
}

void filter_shadow_hit(const RTCFilterFunctionNArguments* arguments) {
    if (arguments->valid[0] != -1) return;
    auto& query = *reinterpret_cast<OpacityQuery*>(arguments->context);
    const Candidate at = candidate_of(*query.accel, *arguments);
    const Accel::Impl& accel = *query.accel;
    const Vec3 passes =
        accel.transmittance != nullptr && !query.opacity_alone
            ? accel.transmittance(accel.opacity_user, at.surface, at.triangle, at.u, at.v, query.direction)
            : Vec3(1.0f - accel.opacity(accel.opacity_user, at.surface, at.triangle, at.u, at.v));
    for (int i = 0; i < 3; ++i)
        query.transmittance[i] *= passes[i] >= 0.0f ? std::min(passes[i], 1.0f) : 0.0f;
    if (max_component(query.transmittance) > 0.0f) arguments->valid[0] = 0;
}

Hit Accel::intersect(const Ray& ray, uint32_t alpha_seed) const noexcept {
    const Impl& accel = *impl_;
    Hit hit;
    if (!is_traceable(accel, ray)) return hit;

    OpacityQuery query;
    embree::init_context(query.embree);
    query.accel = &accel;
    query.alpha_seed = alpha_seed;
    RTCRayHit found;
    fill_ray(found.ray, ray);
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    // What is fixed shortens the ray for what is placed.
    if (accel.fixed_scene != nullptr) embree::intersect(accel.fixed_scene, query.embree, found);
    if (accel.placed_scene != nullptr) embree::intersect(accel.placed_scene, query.embree, found);

    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
    hit.distance = found.ray.tfar;
    hit.u = found.hit.u;
    hit.v = found.hit.v;
    hit.surface = accel.surface_of(found.hit.geomID, found.hit.instID[0]);
    hit.triangle = found.hit.primID;
    return hit;
}

namespace {

Vec3 trace_shadow(const Accel::Impl& accel, const Ray& ray, bool opacity_alone) {
    if (!is_traceable(accel, ray)) return Vec3(1);

    OpacityQuery query;
    embree::init_context(query.embree);
    query.accel = &accel;
    query.direction = ray.direction;
    query.opacity_alone = opacity_alone;
    RTCRay shadow;
    fill_ray(shadow, ray);
    // Embree marks an occluded ray by tfar = -infinity; surfaces that let light pass are only in the product.
    for (RTCScene scene : {accel.fixed_scene, accel.placed_scene}) {
        if (scene != nullptr) embree::occluded(scene, query.embree, shadow);
        if (shadow.tfar < 0.0f) return Vec3(0);
    }
    return query.transmittance;
}

}  // namespace

Vec3 Accel::transmittance(const Ray& ray) const noexcept {
    return trace_shadow(*impl_, ray, false);
}

float Accel::passage(const Ray& ray) const noexcept {
    return trace_shadow(*impl_, ray, true).x;
}

bool Accel::has_opacity() const noexcept {
    return impl_->has_opacity;
}

Accel::Accel(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Accel::~Accel() = default;

std::unique_ptr<Accel> Accel::build(const AccelInput& input, const std::function<void(float)>& progress,
                                    const std::atomic<bool>* cancel) {
    auto impl = std::make_unique<Impl>();
    impl->build(input, progress, cancel);
    return std::unique_ptr<Accel>(new Accel(std::move(impl)));
}

std::unique_ptr<Accel> Accel::with_user(const void* opacity_user) const {
    auto impl = std::make_unique<Impl>(*impl_);
    impl->opacity_user = opacity_user;
    impl->work = {};
    return std::unique_ptr<Accel>(new Accel(std::move(impl)));
}

std::shared_ptr<const AccelTree> Accel::fixed_tree() const {
    return impl_->fixed;
}

std::shared_ptr<const AccelTree> Accel::shape_tree(size_t shape) const {
    return impl_->shapes.at(shape);
}

Bounds3 Accel::bounds() const {
    return impl_->bounds;
}

const AccelWork& Accel::work() const {
    return impl_->work;
}

uint64_t Accel::memory_bytes() const {
    return impl_->family->memory_bytes();
}

}  // namespace candela
