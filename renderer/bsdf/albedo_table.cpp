// SPDX-License-Identifier: MIT
#include "renderer/bsdf/albedo_table.h"

#include <array>

#include "renderer/bsdf/bsdf.h"
#include "renderer/bsdf/microfacet.h"

namespace candela {

namespace {

constexpr int size = 32;

// Nodes are denser towards grazing angles (cosθ = t²) and lie at equal steps of perceptual roughness.
float node_cosine(int i) {
    const float t = static_cast<float>(i) / static_cast<float>(size - 1);
    return std::max(t * t, 1e-4f);
}

float node_alpha(int j) {
    return std::max(sqr(static_cast<float>(j) / static_cast<float>(size - 1)), min_ggx_alpha);
}

struct Axis {
    int index = 0;
    float offset = 0;
};

Axis locate(float t) {
    const float at = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(size - 1);
    const int index = std::min(static_cast<int>(at), size - 2);
    return {index, at - static_cast<float>(index)};
}

SpecularAlbedo mix(const SpecularAlbedo& a, const SpecularAlbedo& b, float t) {
    return {lerp(a.scale, b.scale, t), lerp(a.bias, b.bias, t)};
}

// Integrates over visible normals, whose weight is G2/G1, with a Hammersley point set.
SpecularAlbedo integrate(float cos_theta, float alpha) {
    constexpr uint32_t count = 1024;
    const Vec3 wo(safe_sqrt(1.0f - cos_theta * cos_theta), 0.0f, cos_theta);
    double scale = 0, bias = 0;
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t bits = 0;
        for (uint32_t b = 0; b < 10; ++b)
            bits |= ((i >> b) & 1u) << (9 - b);
        const Vec2 u((static_cast<float>(i) + 0.5f) / count, (static_cast<float>(bits) + 0.5f) / count);
        const Vec3 h = sample_visible_normal(wo, alpha, u);
        const float cos_h = glm::dot(wo, h);
        const Vec3 wi = 2.0f * cos_h * h - wo;
        if (wi.z <= 0.0f) continue;
        const float weight = 2.0f * wi.z * (wo.z + ggx_root(wo.z, alpha)) * ggx_visibility(wo.z, wi.z, alpha);
        const float schlick = schlick_weight(cos_h);
        scale += static_cast<double>(weight * (1.0f - schlick));
        bias += static_cast<double>(weight * schlick);
    }
    return {static_cast<float>(scale / count), static_cast<float>(bias / count)};
}

struct Tables {
    std::array<std::array<SpecularAlbedo, size>, size> albedo;  // [roughness][cosine]
    std::array<MeanSpecularAlbedo, size> mean;                  // [roughness]

    Tables() {
        for (int j = 0; j < size; ++j) {
            auto& row = albedo[static_cast<size_t>(j)];
            for (int i = 0; i < size; ++i)
                row[static_cast<size_t>(i)] = integrate(node_cosine(i), node_alpha(j));
        }
        // The means are those of the interpolated table, so that what the lobes share out adds up.
        constexpr int steps = 1024;
        for (int j = 0; j < size; ++j) {
            MeanSpecularAlbedo& m = mean[static_cast<size_t>(j)];
            for (int k = 0; k < steps; ++k) {
                const float cosine = (static_cast<float>(k) + 0.5f) / steps;
                const Axis x = locate(std::sqrt(cosine));
                const auto& row = albedo[static_cast<size_t>(j)];
                const SpecularAlbedo e =
                    mix(row[static_cast<size_t>(x.index)], row[static_cast<size_t>(x.index) + 1], x.offset);
                const float weight = 2.0f * cosine / steps;
                m.single.scale += weight * e.scale;
                m.single.bias += weight * e.bias;
                m.compensated.scale += weight * e.scale / e.total();
                m.compensated.bias += weight * e.bias / e.total();
            }
        }
    }
};

const Tables tables;

}  // namespace

SpecularAlbedo specular_albedo(float cos_theta, float alpha) noexcept {
    const Axis x = locate(std::sqrt(std::max(cos_theta, 0.0f)));
    const Axis y = locate(std::sqrt(alpha));
    const auto& low = tables.albedo[static_cast<size_t>(y.index)];
    const auto& high = tables.albedo[static_cast<size_t>(y.index) + 1];
    const auto i = static_cast<size_t>(x.index);
    return mix(mix(low[i], low[i + 1], x.offset), mix(high[i], high[i + 1], x.offset), y.offset);
}

MeanSpecularAlbedo mean_specular_albedo(float alpha) noexcept {
    const Axis y = locate(std::sqrt(alpha));
    const MeanSpecularAlbedo& low = tables.mean[static_cast<size_t>(y.index)];
    const MeanSpecularAlbedo& high = tables.mean[static_cast<size_t>(y.index) + 1];
    return {mix(low.single, high.single, y.offset), mix(low.compensated, high.compensated, y.offset)};
}

}  // namespace candela
