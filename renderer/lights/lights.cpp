// SPDX-License-Identifier: MIT
#include "renderer/lights/lights.h"

#include "renderer/lights/spherical_triangle.h"

namespace candela {

namespace {

// Triangles that are small from where they are seen look the same by area; those between these solid angles are sampled
// uniformly in what the receiver sees; larger ones (the receiver all but touches them) are beyond the method's
// precision.
constexpr float small_size_squared = 0.5f;  // of the edges, in distances
constexpr double smallest_solid_angle = 1e-3;
constexpr double largest_solid_angle = 6.2;

bool looks_small(const EmissiveTriangle& light, const Vec3& from) {
    const Vec3 to_center = light.p0 + (light.edge1 + light.edge2) * (1.0f / 3.0f) - from;
    const float size_squared = glm::dot(light.edge1, light.edge1) + glm::dot(light.edge2, light.edge2);
    return size_squared < small_size_squared * glm::dot(to_center, to_center);
}

bool sampled_by_solid_angle(const SphericalTriangle& seen) {
    return seen.solid_angle > smallest_solid_angle && seen.solid_angle < largest_solid_angle;
}

// KHR_lights_punctual, "Inner and Outer Cone Angles".
float spot_attenuation(const PlacedLight& light, const Vec3& wi) {
    const float scale = 1.0f / std::max(0.001f, light.cos_inner - light.cos_outer);
    const float offset = -light.cos_outer * scale;
    const float attenuation = std::clamp(glm::dot(light.direction, -wi) * scale + offset, 0.0f, 1.0f);
    return attenuation * attenuation;
}

LightBounds bounds_of(const PlacedLight& light) {
    LightBounds out;
    out.box.extend(light.position);
    out.axis = light.direction;
    out.intensity = luminance(light.intensity);
    if (light.kind == LightKind::point) {
        out.cos_normals = -1.0f;
    } else {
        const float inner = std::acos(std::clamp(light.cos_inner, -1.0f, 1.0f));
        const float outer = std::acos(std::clamp(light.cos_outer, -1.0f, 1.0f));
        out.cos_normals = light.cos_inner;
        // A little beyond the edge, so that rounding cuts nothing off.
        out.cos_emission = std::cos(std::min(std::max(outer - inner, 0.0f) + 1e-3f, pi));
    }
    return out;
}

LightBounds bounds_of(const EmissiveTriangle& light) {
    LightBounds out;
    for (const Vec3& corner : {light.p0, light.p0 + light.edge1, light.p0 + light.edge2})
        out.box.extend(corner);
    if (!(light.doubled_area > 0.0f)) return out;
    out.axis = light.normal;
    out.intensity = 0.5f * light.doubled_area * light.mean_radiance;
    out.two_sided = light.two_sided;
    return out;
}

// Flux of the lights with a place, all kinds in one measure.
double placed_power(const Lights& lights) {
    double sum = 0;
    const auto add = [&](float power) {
        sum += std::isfinite(power) && power > 0.0f ? static_cast<double>(power) : 0.0;
    };
    for (const PlacedLight& light : lights.punctual) {
        const float intensity = luminance(light.intensity);
        if (light.kind == LightKind::point) add(4.0f * pi * intensity);
        if (light.kind == LightKind::spot) {
            add(2.0f * pi * (1.0f - 0.5f * (light.cos_inner + light.cos_outer)) * intensity);
        }
    }
    for (const EmissiveTriangle& light : lights.triangles)
        add(pi * bounds_of(light).intensity * (light.two_sided ? 2.0f : 1.0f));
    return sum;
}

// The probability of one group of lights beside another, by the flux each may bring, but so that neither starves.
float share_of(double power, double other) {
    if (!(power > 0)) return 0.0f;
    return other > 0 ? static_cast<float>(std::clamp(power / (power + other), 0.2, 0.8)) : 1.0f;
}

float environment_share(const Lights& lights, LightCoverage coverage) {
    return lights.environment_probability[static_cast<size_t>(coverage)];
}

LightSample sample_punctual(const Lights& lights, uint32_t index, const Vec3& from, float probability) {
    LightSample out;
    const PlacedLight& light = lights.punctual[index];
    out.punctual = index;
    out.is_delta = true;
    if (light.kind == LightKind::directional) {
        out.wi = -light.direction;
        out.distance = infinity;
        out.weight = light.intensity / probability;
    } else {
        const Vec3 to_light = light.position - from;
        const float distance2 = glm::dot(to_light, to_light);
        if (!(distance2 > 0.0f)) return out;
        out.distance = std::sqrt(distance2);
        out.wi = to_light / out.distance;
        const float ramp = light.kind == LightKind::spot ? spot_attenuation(light, out.wi) : 1.0f;
        out.weight = light.intensity * (ramp / (distance2 * probability));
        if (ramp == 0.0f) return out;
    }
    out.pdf = probability;
    return out;
}

// The cosine at the light, and whether the light shines that way.
float emitting_cosine(const EmissiveTriangle& light, const Vec3& wi) {
    const float cosine = -glm::dot(light.normal, wi);
    return light.two_sided ? std::abs(cosine) : cosine;
}

// Draws a direction within the triangle as it is seen, and where on it that leads; returns the pdf, 0 where the
// triangle is to be sampled by area.
float sample_solid_angle(const EmissiveTriangle& light, const Vec3& from, const Vec2& u, LightSample& out) {
    const SphericalTriangle seen(from, light.p0, light.edge1, light.edge2);
    if (!sampled_by_solid_angle(seen)) return 0.0f;
    // Möller and Trumbore 1997.
    const glm::dvec3 wi = sample_spherical_triangle(seen, u);
    const glm::dvec3 edge1(light.edge1), edge2(light.edge2);
    const glm::dvec3 p = glm::cross(wi, edge2);
    const double determinant = glm::dot(p, edge1);
    if (determinant == 0) return infinity;
    const glm::dvec3 s = glm::dvec3(from) - glm::dvec3(light.p0);
    out.u = static_cast<float>(std::clamp(glm::dot(s, p) / determinant, 0.0, 1.0));
    out.v = static_cast<float>(std::clamp(glm::dot(wi, glm::cross(s, edge1)) / determinant, 0.0, 1.0));
    if (out.u + out.v > 1.0f) {
        const float scale = 1.0f / (out.u + out.v);
        out.u *= scale;
        out.v *= scale;
    }
    return static_cast<float>(1.0 / seen.solid_angle);
}

LightSample sample_triangle_light(const EmissiveTriangle& light, const Vec3& from, const Vec2& u, float probability) {
    LightSample out;
    if (!(light.doubled_area > 0.0f)) return out;
    float pdf_solid_angle = looks_small(light, from) ? 0.0f : sample_solid_angle(light, from, u, out);
    if (!std::isfinite(pdf_solid_angle)) return out;
    if (pdf_solid_angle == 0.0f) {
        const float root = std::sqrt(u.x);
        out.u = root * (1.0f - u.y);
        out.v = root * u.y;
    }
    const Vec3 to_light = light.p0 + out.u * light.edge1 + out.v * light.edge2 - from;
    const float distance2 = glm::dot(to_light, to_light);
    if (!(distance2 > 0.0f)) return out;
    out.distance = std::sqrt(distance2);
    out.wi = to_light / out.distance;
    const float cosine = emitting_cosine(light, out.wi);
    if (!(cosine > 0.0f)) return out;
    // From area to solid angle: dω = cos dA / r².
    if (pdf_solid_angle == 0.0f) pdf_solid_angle = distance2 / (cosine * 0.5f * light.doubled_area);
    if (!std::isfinite(pdf_solid_angle)) return out;
    out.pdf = probability * pdf_solid_angle;
    out.weight = Vec3(1.0f / out.pdf);
    out.surface = light.surface;
    out.triangle = light.triangle;
    out.u = light.corner.x + light.scale * out.u;
    out.v = light.corner.y + light.scale * out.v;
    return out;
}

}  // namespace

uint32_t EmissiveCells::index_at(float u, float v) const {
    if (cells_per_edge == 1) return first;
    const auto n = static_cast<int>(cells_per_edge);
    const float x = u * static_cast<float>(n), y = v * static_cast<float>(n);
    const int i = std::clamp(static_cast<int>(x), 0, n - 1);
    const int j = std::clamp(static_cast<int>(y), 0, n - 1 - i);
    const bool upside_down = i + j < n - 1 && (x - static_cast<float>(i)) + (y - static_cast<float>(j)) > 1.0f;
    return first + static_cast<uint32_t>(i * (2 * n - i) + 2 * j + (upside_down ? 1 : 0));
}

void finish_lights(Lights& lights, const Bounds3& scene_bounds) {
    for (EmissiveTriangle& light : lights.triangles) {
        const Vec3 cross = glm::cross(light.edge1, light.edge2);
        light.doubled_area = glm::length(cross);
        light.normal = light.doubled_area > 0.0f ? cross / light.doubled_area : Vec3(0);
    }
    std::vector<LightBounds> bounds;
    bounds.reserve(lights.punctual.size() + lights.triangles.size());
    for (const PlacedLight& light : lights.punctual)
        bounds.push_back(light.kind == LightKind::directional ? LightBounds{} : bounds_of(light));
    for (const EmissiveTriangle& light : lights.triangles)
        bounds.push_back(bounds_of(light));
    lights.placed = std::make_shared<const LightTree>(bounds);
    weigh_lights(lights, scene_bounds);
}

void weigh_lights(Lights& lights, const Bounds3& scene_bounds) {
    // What reaches the scene's sphere from far away, against what its lamps send out.
    const double radius = std::max(static_cast<double>(scene_bounds.radius()), 1e-3);
    std::vector<float> irradiance(lights.punctual.size(), 0.0f);
    double directional = 0;
    for (size_t i = 0; i < lights.punctual.size(); ++i) {
        if (lights.punctual[i].kind != LightKind::directional) continue;
        const float value = luminance(lights.punctual[i].intensity);
        irradiance[i] = std::isfinite(value) && value > 0.0f ? value : 0.0f;
        directional += static_cast<double>(pi * irradiance[i]) * radius * radius;
    }
    const double placed = placed_power(lights);
    lights.directional = AliasTable(irradiance);
    lights.directional_probability = share_of(directional, placed);
    for (const LightCoverage coverage : {LightCoverage::complete, LightCoverage::beside_directions}) {
        float& share = lights.environment_probability[static_cast<size_t>(coverage)];
        share = 0.0f;
        if (!lights.environment) continue;
        const float luminance = coverage == LightCoverage::complete ? lights.environment->mean_luminance()
                                                                    : lights.environment->mean_excess();
        const double sky = 4.0 * static_cast<double>(pi * pi * luminance) * radius * radius;
        share = directional + placed > 0 ? share_of(sky, directional + placed) : (sky > 0 ? 1.0f : 0.0f);
    }
}

LightSample sample_light(const Lights& lights, const LightReceiver& receiver, LightCoverage coverage, float u_pick,
                         const Vec2& u) noexcept {
    // Environment, directional lights or one with a place; what is left of u_pick is uniform again.
    const float p_environment = environment_share(lights, coverage);
    if (u_pick < p_environment) {
        LightSample out;
        const float pdf = lights.environment->sample(u, coverage == LightCoverage::complete, out.wi);
        if (!(pdf > 0.0f) || !std::isfinite(pdf)) return out;
        out.pdf = pdf * p_environment;
        out.distance = infinity;
        out.weight = lights.environment->radiance(out.wi) / out.pdf;
        return out;
    }
    float u_rest = (u_pick - p_environment) / (1.0f - p_environment);
    const float p_directional = lights.directional_probability;
    if (u_rest < p_directional) {
        const AliasTable::Choice choice =
            lights.directional.sample(std::min(u_rest / p_directional, one_minus_epsilon));
        const float probability = choice.probability * (1.0f - p_environment) * p_directional;
        return probability > 0.0f ? sample_punctual(lights, choice.index, receiver.position, probability)
                                  : LightSample{};
    }
    if (!lights.placed) return {};
    u_rest = std::min((u_rest - p_directional) / (1.0f - p_directional), one_minus_epsilon);
    const LightTree::Choice choice = lights.placed->sample(receiver, u_rest);
    const float probability = choice.probability * (1.0f - p_environment) * (1.0f - p_directional);
    if (!(probability > 0.0f)) return {};
    if (choice.index < lights.punctual.size()) {
        return sample_punctual(lights, choice.index, receiver.position, probability);
    }
    const auto emissive = static_cast<uint32_t>(choice.index - lights.punctual.size());
    LightSample out = sample_triangle_light(lights.triangles[emissive], receiver.position, u, probability);
    out.emissive = emissive;
    return out;
}

float triangle_light_pdf(const Lights& lights, uint32_t emissive_index, const LightReceiver& receiver,
                         LightCoverage coverage, const Vec3& wi, float distance) noexcept {
    const EmissiveTriangle& light = lights.triangles[emissive_index];
    if (!(light.doubled_area > 0.0f) || !lights.placed) return 0.0f;
    const float cosine = emitting_cosine(light, wi);
    if (!(cosine > 0.0f)) return 0.0f;
    const auto index = static_cast<uint32_t>(lights.punctual.size()) + emissive_index;
    const float probability = (1.0f - environment_share(lights, coverage)) * (1.0f - lights.directional_probability) *
                              lights.placed->probability(index, receiver);
    if (!(probability > 0.0f)) return 0.0f;
    if (!looks_small(light, receiver.position)) {
        const SphericalTriangle seen(receiver.position, light.p0, light.edge1, light.edge2);
        if (sampled_by_solid_angle(seen)) return probability * static_cast<float>(1.0 / seen.solid_angle);
    }
    return probability * distance * distance / (cosine * 0.5f * light.doubled_area);
}

float environment_light_pdf(const Lights& lights, LightCoverage coverage, const Vec3& wi) noexcept {
    const float probability = environment_share(lights, coverage);
    return probability > 0.0f ? probability * lights.environment->pdf(wi, coverage == LightCoverage::complete) : 0.0f;
}

}  // namespace candela
