// SPDX-License-Identifier: MIT
#include "renderer/lights/lights.h"

#include "renderer/lights/spherical_triangle.h"

namespace candela {

namespace {

// Triangles between these solid angles are sampled uniformly in what the receiver sees; smaller ones look the same by
// area, larger ones (the receiver all but touches them) are beyond the method's precision.
constexpr double smallest_solid_angle = 1e-3;
constexpr double largest_solid_angle = 6.2;

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

float power_of(const PlacedLight& light, float scene_radius) {
    const float intensity = luminance(light.intensity);
    switch (light.kind) {
        case LightKind::point:
            return 4.0f * pi * intensity;
        case LightKind::spot:
            return 2.0f * pi * (1.0f - 0.5f * (light.cos_inner + light.cos_outer)) * intensity;
        case LightKind::directional:
            return pi * scene_radius * scene_radius * intensity;
    }
    return 0.0f;
}

float power_of(const EmissiveTriangle& light) {
    const float area = 0.5f * glm::length(glm::cross(light.edge1, light.edge2));
    return pi * area * light.mean_radiance * (light.two_sided ? 2.0f : 1.0f);
}

LightSample sample_punctual(const PlacedLight& light, const Vec3& from, float probability) {
    LightSample out;
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
float emitting_cosine(const EmissiveTriangle& light, const Vec3& normal, const Vec3& wi) {
    const float cosine = -glm::dot(normal, wi);
    return light.two_sided ? std::abs(cosine) : cosine;
}

LightSample sample_triangle_light(const EmissiveTriangle& light, const Vec3& from, const Vec2& u, float probability) {
    LightSample out;
    const Vec3 cross = glm::cross(light.edge1, light.edge2);
    const float doubled_area = glm::length(cross);
    if (!(doubled_area > 0.0f)) return out;
    const SphericalTriangle seen(from, light.p0, light.edge1, light.edge2);
    float pdf_solid_angle = 0;
    if (sampled_by_solid_angle(seen)) {
        // Draw a direction, then find where on the triangle it leads (Möller and Trumbore 1997).
        const glm::dvec3 wi = sample_spherical_triangle(seen, u);
        const glm::dvec3 edge1(light.edge1), edge2(light.edge2);
        const glm::dvec3 p = glm::cross(wi, edge2);
        const double determinant = glm::dot(p, edge1);
        if (determinant == 0) return out;
        const glm::dvec3 s = glm::dvec3(from) - glm::dvec3(light.p0);
        out.u = static_cast<float>(std::clamp(glm::dot(s, p) / determinant, 0.0, 1.0));
        out.v = static_cast<float>(std::clamp(glm::dot(wi, glm::cross(s, edge1)) / determinant, 0.0, 1.0));
        if (out.u + out.v > 1.0f) {
            const float scale = 1.0f / (out.u + out.v);
            out.u *= scale;
            out.v *= scale;
        }
        pdf_solid_angle = static_cast<float>(1.0 / seen.solid_angle);
    } else {
        const float root = std::sqrt(u.x);
        out.u = root * (1.0f - u.y);
        out.v = root * u.y;
    }
    const Vec3 to_light = light.p0 + out.u * light.edge1 + out.v * light.edge2 - from;
    const float distance2 = glm::dot(to_light, to_light);
    if (!(distance2 > 0.0f)) return out;
    out.distance = std::sqrt(distance2);
    out.wi = to_light / out.distance;
    const float cosine = emitting_cosine(light, cross / doubled_area, out.wi);
    if (!(cosine > 0.0f)) return out;
    // From area to solid angle: dω = cos dA / r².
    if (pdf_solid_angle == 0.0f) pdf_solid_angle = distance2 / (cosine * 0.5f * doubled_area);
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
    const float radius = std::max(scene_bounds.radius(), 1e-3f);
    std::vector<float> powers;
    powers.reserve(lights.punctual.size() + lights.triangles.size());
    double local = 0;
    for (const PlacedLight& light : lights.punctual)
        powers.push_back(power_of(light, radius));
    for (const EmissiveTriangle& light : lights.triangles)
        powers.push_back(power_of(light));
    for (float& power : powers) {
        if (!std::isfinite(power) || power < 0.0f) power = 0.0f;
        local += static_cast<double>(power);
    }
    lights.local = AliasTable(powers);

    // Share the choice between environment and local lights by the flux each may bring to the scene, but starve
    // neither.
    lights.environment_probability = 0.0f;
    if (!lights.environment) return;
    lights.environment_probability = 1.0f;
    if (local > 0) {
        const double sky = 4.0 * static_cast<double>(pi * pi * radius * radius * lights.environment->mean_luminance());
        lights.environment_probability = static_cast<float>(sky > 0 ? std::clamp(sky / (sky + local), 0.2, 0.8) : 0.0);
    }
}

LightSample sample_light(const Lights& lights, const Vec3& from, float u_pick, const Vec2& u) noexcept {
    const float p_environment = lights.environment_probability;
    if (u_pick < p_environment) {
        LightSample out;
        const float pdf = lights.environment->sample(u, out.wi);
        if (!(pdf > 0.0f) || !std::isfinite(pdf)) return out;
        out.pdf = pdf * p_environment;
        out.distance = infinity;
        out.weight = lights.environment->radiance(out.wi) / out.pdf;
        return out;
    }
    if (lights.local.size() == 0) return {};
    const AliasTable::Choice choice = lights.local.sample((u_pick - p_environment) / (1.0f - p_environment));
    const float probability = choice.probability * (1.0f - p_environment);
    if (!(probability > 0.0f)) return {};
    if (choice.index < lights.punctual.size()) return sample_punctual(lights.punctual[choice.index], from, probability);
    const auto emissive = static_cast<uint32_t>(choice.index - lights.punctual.size());
    LightSample out = sample_triangle_light(lights.triangles[emissive], from, u, probability);
    out.emissive = emissive;
    return out;
}

float triangle_light_pdf(const Lights& lights, uint32_t emissive_index, const Vec3& from, const Vec3& wi,
                         float distance) noexcept {
    const EmissiveTriangle& light = lights.triangles[emissive_index];
    const float probability = (1.0f - lights.environment_probability) *
                              lights.local.probability(static_cast<uint32_t>(lights.punctual.size()) + emissive_index);
    const Vec3 cross = glm::cross(light.edge1, light.edge2);
    const float doubled_area = glm::length(cross);
    if (!(probability > 0.0f) || !(doubled_area > 0.0f)) return 0.0f;
    const float cosine = emitting_cosine(light, cross / doubled_area, wi);
    if (!(cosine > 0.0f)) return 0.0f;
    const SphericalTriangle seen(from, light.p0, light.edge1, light.edge2);
    if (sampled_by_solid_angle(seen)) return probability * static_cast<float>(1.0 / seen.solid_angle);
    return probability * distance * distance / (cosine * 0.5f * doubled_area);
}

float environment_light_pdf(const Lights& lights, const Vec3& wi) noexcept {
    if (!lights.environment) return 0.0f;
    return lights.environment_probability * lights.environment->pdf(wi);
}

}  // namespace candela
