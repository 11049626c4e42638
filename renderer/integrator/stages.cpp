// SPDX-License-Identifier: MIT
#include "renderer/integrator/stages.h"

#include "renderer/bsdf/stack.h"
#include "renderer/integrator/boundary.h"
#include "renderer/math/hash.h"
#include "renderer/sampling/mis.h"
#include "renderer/sampling/warp.h"
#include "renderer/world/shaded_material.h"

namespace candela {

namespace {

// Which dimensions of the sample sequence belong to what: four for the camera, then eight for each vertex.
constexpr uint32_t camera_dimensions = 4;
constexpr uint32_t vertex_dimensions = 8;

// Radius of the Blackman-Harris window in pixels.
constexpr float filter_radius = 1.5f;

// Roulette starts after this many surfaces, is mild to paths that still carry a third of their light (a weak path that
// lives costs less than the noise of one that is made up for), and never lets a path survive with certainty: a closed
// scene without absorption must end too.
constexpr uint32_t roulette_depth = 3;
constexpr float survival_per_throughput = 3.0f;
constexpr float max_survival = 0.95f;

// The width of the cone around a sample of a lobe, in units of the root of the solid angle that it stands for.
constexpr float lobe_cone_share = 0.25f;

// A path that meets so many surfaces runs in circles between boundaries that no light leaves: rounding, not optics.
constexpr uint32_t most_segments = 1u << 16;

[[gnu::always_inline]] inline void gather(const IntegratorSettings& settings, const PathState& path, Vec3 contribution,
                                          uint32_t depth, Vec3& radiance) {
    contribution *= path.throughput;
    // The biased clamp, if asked for, holds for light that scattered more than once.
    if (settings.clamp_indirect > 0.0f && depth > 1) {
        const float largest = max_component(glm::abs(contribution));
        if (largest > settings.clamp_indirect) contribution *= settings.clamp_indirect / largest;
    }
    radiance += contribution;
}

// The weight of light that a BSDF sample found, when a light sample could have found it with light_pdf.
float found_light_weight(const IntegratorSettings& settings, const PathState& path, float light_pdf) {
    if (path.from_delta || settings.estimator == Estimator::bsdf) return 1.0f;
    if (settings.estimator == Estimator::light) return light_pdf > 0.0f ? 0.0f : 1.0f;
    return mis_weight(path.bsdf_pdf, light_pdf);
}

// With both techniques light samples need not cover what directions find.
LightCoverage coverage_of(const IntegratorSettings& settings) {
    return settings.estimator == Estimator::mis ? LightCoverage::beside_directions : LightCoverage::complete;
}

// Emission that the path ran into, weighted against the chance that a light sample finds it. Where others share the
// second vertex, the weight is for each of them to say.
template <bool recorded>
void gather_found(const IntegratorSettings& settings, const Vec3& emission, float light_pdf, uint32_t surface,
                  PathState& path, ReusablePath* reuse, VertexRecord* record) {
    if (path.shared && path.depth == 2 && reuse->found_count < reuse->found.size()) {
        reuse->found[reuse->found_count++] = {path.throughput * emission, light_pdf};
        return;
    }
    const float weight = found_light_weight(settings, path, light_pdf);
    if constexpr (recorded) {
        LightRecord& found = record->found.emplace();
        found.technique = path.depth == 0 ? LightTechnique::seen : LightTechnique::bsdf_sample;
        found.surface = surface;
        found.light = emission;
        found.light_pdf = light_pdf;
        found.bsdf_pdf = path.bsdf_pdf;
        found.is_delta = path.from_delta;
        found.share = weight;
    }
    if (weight > 0.0f) gather(settings, path, weight * emission, path.depth, path.radiance);
}

template <bool recorded>
void shade_miss(const World& world, const IntegratorSettings& settings, PathState& path, ReusablePath* reuse,
                VertexRecord* record) {
    path.alive = false;
    if constexpr (recorded) record->end = PathEnd::missed;
    if (path.depth == 0 && settings.background != BackgroundKind::environment) {
        if (settings.background == BackgroundKind::transparent) {
            path.alpha = 0.0f;
        } else {
            path.radiance += settings.background_color;
            if constexpr (recorded) {
                record->found.emplace().light = settings.background_color;
                record->found->is_background = true;
            }
        }
        return;
    }
    if (!world.lights.environment) return;
    const Vec3 wi = path.ray.direction;
    const float light_pdf = path.from_delta ? 0.0f : environment_light_pdf(world.lights, coverage_of(settings), wi);
    const Vec3 radiance = world.lights.environment->radiance(wi);
    if (reuse != nullptr && reuse->has_first && path.depth == 1 && path.segments == 1 && !path.from_delta) {
        reuse->escapes = true;
        reuse->escape_direction = wi;
        reuse->found[reuse->found_count++] = {radiance, light_pdf};
        return;
    }
    gather_found<recorded>(settings, radiance, light_pdf, invalid_index, path, reuse, record);
}

// What the path's bundle covers at the end of the segment, where its next segment starts.
[[gnu::always_inline]] inline RayFootprint footprint_at(float distance_m, PathState& path) {
    if (!(path.texture_share > 0.0f)) return {};
    path.cone.width_m = path.cone.width_at(distance_m);
    return {path.cone.width_m, path.texture_share,
            unit_float(hash_combine(path.sampler.hash() ^ 0x3c6ef372u, path.segments))};
}

// Sends the path on in its direction from the other side of the surface.
[[gnu::always_inline]] inline void pass_straight(const SurfacePoint& point, PathState& path) {
    path.ray.origin = offset_ray_origin(point.position, -point.geometric_normal, point.error_m);
    path.segments += 1;
}

// The segment from a surface point to a point on a light, moved off both surfaces.
Ray shadow_ray(const World& world, const SurfacePoint& point, const LightSample& light) {
    Ray ray;
    const float side = glm::dot(point.geometric_normal, light.wi) < 0.0f ? -1.0f : 1.0f;
    ray.origin = offset_ray_origin(point.position, side * point.geometric_normal, point.error_m);
    ray.direction = light.wi;
    ray.t_max = infinity;
    if (!std::isfinite(light.distance)) return ray;

    Vec3 target = point.position + light.distance * light.wi;
    if (light.surface != invalid_index) {
        const EmissiveTriangle& cell = world.lights.triangles[light.emissive];
        const Vec3& normal = cell.normal;
        const Vec2 at = (Vec2(light.u, light.v) - cell.corner) / cell.scale;
        // The intersector knows the whole triangle, not the cell.
        const float error_m = surface_error_m(
            glm::abs(cell.p0) + 2.0f * (glm::abs(cell.edge1) + glm::abs(cell.edge2)) / std::abs(cell.scale), normal);
        target = offset_ray_origin(cell.p0 + at.x * cell.edge1 + at.y * cell.edge2,
                                   glm::dot(normal, light.wi) < 0.0f ? normal : -normal, error_m);
    }
    return segment_between(ray.origin, target);
}

// Next-event estimation: one light, weighted against the chance that a BSDF sample finds it.
template <bool recorded>
ShadowRequest plan_connection(const World& world, const IntegratorSettings& settings, const SurfacePoint& point,
                              const LightReceiver& receiver, const Boundary& boundary, const Bsdf& bsdf,
                              const BsdfStack& stack, const Vec3& wo, float u_pick, const Vec2& u,
                              const PathState& path, ReusablePath* second_of, VertexRecord* record) {
    ShadowRequest request;
    const LightSample light = sample_light(world.lights, receiver, coverage_of(settings), u_pick, u);
    if (!(light.pdf > 0.0f)) return request;
    if (settings.estimator == Estimator::bsdf && !light.is_delta) return request;
    const Vec3 wi = point.shading.local_from_world(light.wi);
    // Light from behind the true surface does not reach its front, whatever the shading normal says.
    const bool transmitted = wi.z < 0.0f;
    if ((glm::dot(light.wi, point.geometric_normal) <= 0.0f) != transmitted) return request;

    Vec3 arriving = light.weight;
    if (light.surface != invalid_index) {
        arriving *= emitted_radiance(world, light.surface, light.triangle, light.u, light.v);
    }
    // How much of it those scatter who share the vertex, each of them has to find out.
    if (second_of != nullptr) {
        if (is_black(arriving)) return request;
        second_of->light_wi = wi;
        second_of->light_pdf = light.pdf;
        second_of->light_is_delta = light.is_delta;
        request.contribution = arriving;
        request.ray = shadow_ray(world, point, light);
        request.active = request.shared = true;
        return request;
    }
    const BsdfEval scattered = eval(bsdf, stack, wo, wi);
    if (is_black(scattered.value)) return request;
    Vec3 contribution = scattered.value * arriving;
    const MediumSet& media = transmitted ? boundary.far : boundary.near;
    if (!media.empty()) contribution *= transmittance_of(world, media.present(world), light.distance);
    if (!light.is_delta && settings.estimator == Estimator::mis) contribution *= mis_weight(light.pdf, scattered.pdf);
    if (is_black(contribution)) return request;

    gather(settings, path, contribution, path.depth + 1, request.contribution);
    request.ray = shadow_ray(world, point, light);
    request.active = true;
    request.light_surface = light.surface;
    request.punctual = light.punctual;
    if constexpr (recorded) {
        LightRecord& sampled = record->sampled.emplace();
        sampled.technique = LightTechnique::light_sample;
        sampled.surface = light.surface;
        sampled.punctual = light.punctual;
        sampled.light = arriving;
        sampled.scattered = scattered.value;
        if (!media.empty()) sampled.transmittance = transmittance_of(world, media.present(world), light.distance);
        sampled.light_pdf = light.pdf;
        sampled.bsdf_pdf = light.is_delta ? 0.0f : scattered.pdf;
        sampled.is_delta = light.is_delta;
        if (!light.is_delta && settings.estimator == Estimator::mis)
            sampled.share = mis_weight(light.pdf, scattered.pdf);
    }
    return request;
}

// Whether others can be connected to the first vertex of the path: light scatters there in no body, and not by deltas
// alone.
bool is_reusable_first(const World& world, const SurfacePoint& point, const BsdfStack& stack, const Bsdf& bsdf,
                       const PathState& path) {
    return path.depth == 0 && path.segments == 0 && path.media.empty() &&
           world.surfaces[point.surface].medium == invalid_index && scatters_broadly(bsdf, stack);
}

// Whether the second vertex looks the same to others: its frame and material must not depend on where they are.
bool is_reusable_second(const World& world, const SurfacePoint& point, const Bsdf& bsdf, const PathState& path) {
    return path.depth == 1 && path.segments == 1 && !path.from_delta && path.media.empty() &&
           world.surfaces[point.surface].medium == invalid_index && !point.bent && bsdf.coat == 0.0f &&
           world.materials[point.material].iridescence.factor == 0.0f;
}

PathVertex vertex_at(const SurfacePoint& point, const Bsdf& bsdf) {
    return {point.position, point.geometric_normal, point.error_m, point.shading, bsdf};
}

// The stage itself; recorded: *record says what it decided. That costs the drivers nothing, whose instance has no
// record.
template <bool recorded>
[[gnu::always_inline]] inline ShadowRequest shade_vertex(const World& world, const IntegratorSettings& settings,
                                                         const Hit& hit, const VertexPoints& u, PathState& path,
                                                         ReusablePath* reuse, VertexRecord* record) noexcept {
    ++path.traced;
    if (!hit.valid()) {
        shade_miss<recorded>(world, settings, path, reuse, record);
        return {};
    }
    const Vec3 wo_world = -path.ray.direction;
    const SurfacePoint point = make_surface_point(world, hit, wo_world, footprint_at(hit.distance, path));
    if (!path.media.empty()) path.throughput *= transmittance_of(world, path.media.present(world), hit.distance);
    if constexpr (recorded) {
        if (!path.media.empty())
            record->transmittance = transmittance_of(world, path.media.present(world), hit.distance);
    }
    [[maybe_unused]] const float wavelength_before_nm = path.wavelength_nm;

    // Bodies that meet here: their indices of refraction, or nothing at all where another body hides the boundary.
    const Boundary boundary =
        meet_boundary(world, world.surfaces[point.surface].medium, point.front_face, u.wavelength, path);
    if constexpr (recorded) {
        if (path.wavelength_nm != wavelength_before_nm) record->transmittance *= sample_wavelength(u.wavelength).weight;
    }
    if (boundary.is_hidden) {
        // To the rays that look for sampled lights it is opaque: what lies beyond, only this path can find.
        path.from_delta = true;
        path.media = boundary.far;
        pass_straight(point, path);
        path.alive = path.segments < most_segments;
        if constexpr (recorded) record->end = path.alive ? PathEnd::none : PathEnd::depth;
        return {};
    }
    const ShadedMaterial material = shade_material(world, point, wo_world, boundary.indices);

    // Emission that this segment ran into. Unlit surfaces are not in the light sampler, so nothing else can find them.
    if (!is_black(material.emission)) {
        float light_pdf = 0.0f;
        const uint32_t first_emissive = world.surfaces[point.surface].first_emissive;
        if (!path.from_delta && first_emissive != invalid_index) {
            const bool flips = world.transforms[world.surfaces[point.surface].transform].flips;
            const uint32_t cell = world.lights.cells[first_emissive + point.triangle].index_at(flips ? hit.v : hit.u,
                                                                                               flips ? hit.u : hit.v);
            light_pdf = triangle_light_pdf(world.lights, cell, path.vertex, coverage_of(settings), path.ray.direction,
                                           glm::length(point.position - path.vertex.position));
        }
        gather_found<recorded>(settings, material.emission, light_pdf, hit.surface, path, reuse, record);
    }
    if constexpr (recorded) record->end = PathEnd::absorbed;
    if (material.unlit) {
        path.alive = false;
        return {};
    }
    const Vec3 wo = point.shading.local_from_world(wo_world);
    const bool may_scatter = settings.max_depth == 0 || path.depth < settings.max_depth;

    // Plan the connection to a light.
    ShadowRequest request;
    if (!(wo.z > 0.0f)) {
        path.alive = false;
        return request;
    }
    const BsdfStack stack = make_stack(material.bsdf, wo);
    const LightReceiver receiver{point.position, point.shading.normal, material.bsdf.transmits()};
    if (reuse != nullptr && may_scatter && is_reusable_first(world, point, stack, material.bsdf, path)) {
        reuse->has_first = true;
        reuse->first = vertex_at(point, material.bsdf);
        reuse->first_stack = stack;
        reuse->first_wo = wo;
    }
    const bool is_second =
        reuse != nullptr && reuse->has_first && may_scatter && is_reusable_second(world, point, material.bsdf, path);
    if (is_second) {
        reuse->has_second = true;
        reuse->second = vertex_at(point, material.bsdf);
    }
    if (may_scatter && !world.lights.empty()) {
        request = plan_connection<recorded>(world, settings, point, receiver, boundary, material.bsdf, stack, wo,
                                            u.light_choice, u.light, path, is_second ? reuse : nullptr, record);
    }

    // Draw the next direction. Going straight through thin glass is no scattering: sampled lights shine through it too.
    const BsdfSample scattered = sample(material.bsdf, stack, wo, u.lobe_choice, u.direction);
    const Vec3 wi = point.shading.world_from_local(scattered.wi);
    const bool transmitted = scattered.wi.z < 0.0f;
    path.alive = scattered.pdf > 0.0f && !is_black(scattered.weight) &&
                 (glm::dot(wi, point.geometric_normal) < 0.0f) == transmitted &&
                 (may_scatter || scattered.is_straight) && path.segments < most_segments;
    if constexpr (recorded) {
        if (scattered.pdf > 0.0f) {
            record->lobe = choose_lobe(stack, u.lobe_choice).lobe;
            record->transmitted = transmitted;
            record->is_delta = scattered.is_delta;
            record->is_straight = scattered.is_straight;
            record->pdf = scattered.pdf;
            record->weight = scattered.weight;
            if (!may_scatter && !scattered.is_straight) record->end = PathEnd::depth;
        }
        if (path.alive) record->end = PathEnd::none;
    }
    if (!path.alive) return request;
    if (is_second && !scattered.is_delta) {
        // From here on light is gathered for all who share the vertex.
        reuse->goes_on = true;
        reuse->onward_wi = scattered.wi;
        reuse->own = path.radiance;
        path.radiance = Vec3(0);
        path.shared_throughput = path.throughput * scattered.weight;
        path.throughput = Vec3(1);
        path.shared = true;
    } else {
        path.throughput *= scattered.weight;
    }
    if (scattered.is_straight) {
        pass_straight(point, path);
    } else {
        // What a sample of a lobe stands for is the solid angle 1/pdf, of which the cone takes a careful part.
        if (!scattered.is_delta) {
            path.cone.spread_radians = std::max(path.cone.spread_radians, lobe_cone_share / std::sqrt(scattered.pdf));
        }
        path.bsdf_pdf = scattered.pdf;
        path.from_delta = scattered.is_delta;
        path.eta_scale *= sqr(scattered.eta);
        path.depth += 1;
        path.segments += 1;
        path.media = transmitted ? boundary.far : boundary.near;
        path.vertex = receiver;
        path.ray.origin = offset_ray_origin(
            point.position, transmitted ? -point.geometric_normal : point.geometric_normal, point.error_m);
        path.ray.direction = glm::normalize(wi);
        path.ray.t_max = infinity;
    }

    // Russian roulette: a path lives on by the share of light that it still carries.
    if (settings.russian_roulette && path.segments >= roulette_depth) {
        const float carried = max_component(glm::abs(path.shared_throughput * path.throughput)) * path.eta_scale;
        const float survival = std::min(survival_per_throughput * carried, max_survival);
        if constexpr (recorded) {
            record->survival = survival;
            if (u.roulette >= survival) record->end = PathEnd::roulette;
        }
        if (u.roulette >= survival) {
            path.alive = false;
        } else {
            path.throughput /= survival;
        }
    }
    return request;
}

}  // namespace

PathState begin_path(const View& view, const IntegratorSettings& settings, PixelSample sample) noexcept {
    PathState path;
    path.sampler = Sampler(settings.sampler, Vec2u(sample.x, sample.y), sample.index, settings.seed);
    // The filter is sampled, not weighted: every sample belongs to its pixel alone.
    const Vec2 u_filter = path.sampler.next_2d();
    const Vec2 offset =
        settings.filter == PixelFilter::box ? u_filter - 0.5f : sample_blackman_harris(u_filter, filter_radius);
    const Vec2 extent(view.extent);
    const Vec2 film_uv = (Vec2(sample.x, sample.y) + 0.5f + offset) / extent;
    path.ray = generate_ray(view.camera, extent.x / extent.y, film_uv, path.sampler.next_2d());
    if (settings.filter_textures) {
        path.cone = pixel_cone(view.camera, view.extent.y, path.ray);
        const auto n = static_cast<float>(sample.index + 1);
        path.texture_share = 1.0f / (n * std::sqrt(n));
    }
    return path;
}

Hit extend(const World& world, const PathState& path, RayCounts& counts) noexcept {
    ++(path.depth == 0 ? counts.camera : counts.bounce);
    return world.accel->intersect(path.ray, hash_combine(path.sampler.hash(), path.segments));
}

void start_vertex(PathState& path) noexcept {
    path.sampler.start_dimension(camera_dimensions + vertex_dimensions * path.segments);
}

VertexPoints draw_vertex(PathState& path) noexcept {
    start_vertex(path);
    VertexPoints out;
    out.direction = path.sampler.next_2d();
    const Vec2 choices = path.sampler.next_2d();
    out.light = path.sampler.next_2d();
    const Vec2 rare = path.sampler.next_2d();
    out.lobe_choice = choices.x;
    out.light_choice = choices.y;
    out.roulette = rare.x;
    out.wavelength = rare.y;
    return out;
}

VertexPoints vertex_points(const PointBatch& batch, size_t i) noexcept {
    return {batch.point(i, 0), batch.x[1][i], batch.y[1][i], batch.point(i, 2), batch.x[3][i], batch.y[3][i]};
}

ShadowRequest shade(const World& world, const IntegratorSettings& settings, const Hit& hit, const VertexPoints& u,
                    PathState& path, ReusablePath* reuse) noexcept {
    return shade_vertex<false>(world, settings, hit, u, path, reuse, nullptr);
}

ShadowRequest shade_recorded(const World& world, const IntegratorSettings& settings, const Hit& hit,
                             const VertexPoints& u, PathState& path, VertexRecord& record) noexcept {
    return shade_vertex<true>(world, settings, hit, u, path, nullptr, &record);
}

void connect(const World& world, const ShadowRequest& request, PathState& path, ReusablePath* reuse,
             RayCounts& counts) noexcept {
    ++counts.shadow;
    ++path.shadow_rays;
    (request.shared ? reuse->light : path.radiance) += world.accel->transmittance(request.ray) * request.contribution;
}

RadianceSample finish(const PathState& path, ReusablePath* reuse) noexcept {
    RadianceSample out{path.radiance, path.alpha, path.traced, path.shadow_rays};
    if (path.shared) {
        reuse->later = path.radiance;
        out.radiance = reuse->own;
    }
    return out;
}

}  // namespace candela
