// SPDX-License-Identifier: MIT
#include "renderer/integrator/path_reuse.h"

#include <algorithm>
#include <tuple>

#include "renderer/sampling/mis.h"
#include "renderer/world/surface_point.h"

namespace candela {

namespace {

// The first vertex of one path connected to the second vertex of another.
struct Connection {
    uint16_t path = 0;
    float pdf = 0;      // with which the path's first vertex meets the second one: per area, visibility included
    Vec3 reflected{0};  // f·|cos| at the first vertex, times visibility, times the solid angle of the second's area
    BsdfEval light, onward;  // at the second vertex, for the directions to the light and onward
};

// The share of what a light sample finds, when the path that goes on could have found it with bsdf_pdf.
float sampled_light_share(const IntegratorSettings& settings, const ReusablePath& from, float bsdf_pdf) {
    if (from.light_is_delta || settings.estimator != Estimator::mis) return 1.0f;
    return mis_weight(from.light_pdf, bsdf_pdf);
}

// The share of what the path that went on has found.
float found_light_share(const IntegratorSettings& settings, float bsdf_pdf, float light_pdf) {
    if (settings.estimator == Estimator::bsdf) return 1.0f;
    if (settings.estimator == Estimator::light) return light_pdf > 0.0f ? 0.0f : 1.0f;
    return mis_weight(bsdf_pdf, light_pdf);
}

Vec3 leave(const PathVertex& vertex, bool below) {
    return offset_ray_origin(vertex.position, below ? -vertex.geometric_normal : vertex.geometric_normal,
                             vertex.error_m);
}

// The chance that the way is free. A path's own was, but what it passed by chance counts for it as for the others.
float passage_of(const World& world, const Ray& ray, bool own, uint32_t& rays) {
    if (own && !world.accel->has_opacity()) return 1.0f;
    ++rays;
    const float passage = world.accel->passage(ray);
    return own && !(passage > 0.0f) ? 1.0f : passage;
}

// The environment that `from` ended in, seen from the first vertex of `to`: f·|cos| and pdf per solid angle.
bool connect_escape(const World& world, const ReusablePath& to, const ReusablePath& from, Connection& out,
                    uint32_t& rays) {
    const bool own = &to == &from;
    const Vec3 wi = to.first.shading.local_from_world(from.escape_direction);
    const bool below = wi.z < 0.0f;
    if (!own && (glm::dot(from.escape_direction, to.first.geometric_normal) <= 0.0f) != below) return false;
    const BsdfEval first = eval(to.first.bsdf, to.first_stack, to.first_wo, wi);
    if (!(first.pdf > 0.0f) || !std::isfinite(first.pdf)) return false;
    const float passage = passage_of(world, {leave(to.first, below), from.escape_direction, infinity}, own, rays);
    out.pdf = first.pdf * passage;
    out.reflected = first.value * passage;
    // Here the light is found by the direction that left the first vertex.
    out.onward = {Vec3(1), first.pdf};
    return passage > 0.0f;
}

// False where the path `to` could not have met the second vertex of `from`.
bool connect_vertices(const World& world, const ReusablePath& to, const ReusablePath& from, Connection& out,
                      uint32_t& rays) {
    if (from.escapes) return connect_escape(world, to, from, out, rays);
    const bool own = &to == &from;
    const Vec3 between = from.second.position - to.first.position;
    const float squared_m2 = glm::dot(between, between);
    const Vec3 direction = between / std::sqrt(squared_m2);

    // At the first vertex: scattered to the side where the second lies, as the path's own directions have to be.
    const Vec3 wi = to.first.shading.local_from_world(direction);
    const bool below = wi.z < 0.0f;
    if (!own && (glm::dot(direction, to.first.geometric_normal) <= 0.0f) != below) return false;
    // At the second: on the side that was met, and where its shading normal needs no bending.
    const float cosine = -glm::dot(direction, from.second.geometric_normal);
    const Vec3 wo = from.second.shading.local_from_world(-direction);
    if (!(wo.z > 0.0f)) return false;
    if (!own &&
        (!(cosine > 0.0f) || bends_towards(from.second.shading.normal, from.second.geometric_normal, -direction)))
        return false;
    const BsdfEval first = eval(to.first.bsdf, to.first_stack, to.first_wo, wi);
    const float solid_angle_per_area = std::abs(cosine) / squared_m2;
    out.pdf = first.pdf * solid_angle_per_area;
    if (!(out.pdf > 0.0f) || !std::isfinite(out.pdf)) return false;

    const float passage =
        passage_of(world, segment_between(leave(to.first, below), leave(from.second, false)), own, rays);
    if (!(passage > 0.0f)) return false;
    out.pdf *= passage;
    out.reflected = first.value * (solid_angle_per_area * passage);
    const BsdfStack stack = make_stack(from.second.bsdf, wo);
    if (!is_black(from.light)) out.light = eval(from.second.bsdf, stack, wo, from.light_wi);
    if (from.goes_on) out.onward = eval(from.second.bsdf, stack, wo, from.onward_wi);
    return true;
}

bool brings_light(const ReusablePath& path) {
    return path.found_count > 0 || !is_black(path.light) || !is_black(path.later);
}

}  // namespace

uint32_t reuse_group(uint32_t x, uint32_t y) noexcept {
    const auto along = [](uint32_t at, uint32_t members) {
        constexpr uint32_t spacing = 2;
        return at % spacing + at % reuse_tile / (spacing * members) * spacing;
    };
    return along(y, reuse_rows) * reuse_tile + along(x, reuse_columns);
}

void ReuseGroups::form(std::span<const PixelSample> samples) noexcept {
    struct Key {
        uint32_t index = 0, tile = 0, group = 0;
        uint16_t position = 0;
        bool operator<(const Key& o) const {
            return std::tie(index, tile, group, position) < std::tie(o.index, o.tile, o.group, o.position);
        }
    };
    std::array<Key, max_batch> keys;
    size_t n = 0;
    for (size_t i = 0; i < samples.size(); ++i) {
        const PixelSample& s = samples[i];
        if (s.sharing == PathSharing::none) continue;
        const uint32_t tile = s.y / reuse_tile << 16 | s.x / reuse_tile;
        keys[n++] = {s.index, tile,
                     s.sharing == PathSharing::alone ? reuse_tile * reuse_tile + static_cast<uint32_t>(i)
                                                     : reuse_group(s.x, s.y),
                     static_cast<uint16_t>(i)};
    }
    std::sort(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(n));
    count = 0;
    for (size_t k = 0; k < n; ++k) {
        // A pixel that a caller names twice does not make its group larger.
        const bool same = k > 0 && keys[k].index == keys[k - 1].index && keys[k].tile == keys[k - 1].tile &&
                          keys[k].group == keys[k - 1].group && k - first[count - 1] < max_reuse_group;
        if (!same) first[count++] = static_cast<uint16_t>(k);
        members[k] = keys[k].position;
    }
    first[count] = static_cast<uint16_t>(n);
}

void reuse_paths(const World& world, const IntegratorSettings& settings, std::span<const uint16_t> members,
                 std::span<const ReusablePath> paths, std::span<RadianceSample> out, RayCounts& counts) noexcept {
    std::array<Connection, max_reuse_group> connections;
    for (const uint16_t lender : members) {
        const ReusablePath& from = paths[lender];
        if (!brings_light(from)) continue;

        // Connect the second vertex to all first vertices, and sum the pdfs of all that could have met it.
        size_t count = 0;
        float light_pdfs = 0, onward_pdfs = 0;
        for (const uint16_t borrower : members) {
            if (!paths[borrower].has_first) continue;
            Connection connection;
            connection.path = borrower;
            uint32_t rays = 0;
            const bool there = connect_vertices(world, paths[borrower], from, connection, rays);
            counts.shadow += rays;
            out[borrower].shadow_rays += rays;
            out[borrower].shared_with += borrower != lender ? 1 : 0;
            if (!there) continue;
            light_pdfs += connection.pdf;
            onward_pdfs += from.escapes ? connection.pdf : connection.pdf * connection.onward.pdf;
            connections[count++] = connection;
        }

        // Hand its light to each of them. The light sample does not depend on where one comes from, the way on does.
        for (const Connection& c : std::span(connections).first(count)) {
            Vec3 radiance(0);
            if (light_pdfs > 0.0f)
                radiance +=
                    c.light.value * from.light * (sampled_light_share(settings, from, c.light.pdf) / light_pdfs);
            if (onward_pdfs > 0.0f) {
                Vec3 arriving = from.later;
                for (const FoundLight& light : std::span(from.found).first(from.found_count))
                    arriving += light.radiance * found_light_share(settings, c.onward.pdf, light.light_pdf);
                radiance += c.onward.value * arriving / onward_pdfs;
            }
            out[c.path].radiance += c.reflected * radiance;
            out[c.path].shared_luminance += luminance(c.reflected * radiance);
        }
    }
}

}  // namespace candela
