// SPDX-License-Identifier: MIT
#include "renderer/bsdf/albedo_integral.h"

#include <algorithm>
#include <cmath>

#include "renderer/bsdf/bsdf.h"
#include "renderer/bsdf/fresnel.h"
#include "renderer/bsdf/microfacet.h"

namespace candela {

namespace {

// Nodes are denser towards grazing angles (cosθ = t²) and lie at equal steps of perceptual roughness.
float node_cosine(int i) {
    const float t = static_cast<float>(i) / static_cast<float>(AlbedoTables::size - 1);
    return std::max(t * t, 1e-4f);
}

float node_alpha(int j) {
    return std::max(sqr(static_cast<float>(j) / static_cast<float>(AlbedoTables::size - 1)), min_ggx_alpha);
}

}  // namespace

Vec3 table_direction(float cosine, float phi) {
    const float sine = safe_sqrt(1.0f - cosine * cosine);
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

SpecularAlbedo integrate_specular_albedo(const Vec3& wo, const Vec2& alpha, uint32_t digits) {
    const uint32_t points = 1u << digits;
    const auto count = static_cast<float>(points);
    double scale = 0, bias = 0;
    for (uint32_t i = 0; i < points; ++i) {
        uint32_t bits = 0;
        for (uint32_t b = 0; b < digits; ++b)
            bits |= ((i >> b) & 1u) << (digits - 1 - b);
        const Vec2 u((static_cast<float>(i) + 0.5f) / count, (static_cast<float>(bits) + 0.5f) / count);
        const Vec3 h = sample_visible_normal(wo, alpha, u);
        const float cos_h = glm::dot(wo, h);
        const Vec3 wi = 2.0f * cos_h * h - wo;
        if (wi.z <= 0.0f) continue;
        const float weight = 2.0f * wi.z * (wo.z + ggx_root(wo, alpha)) * ggx_visibility(wo, wi, alpha);
        const float schlick = schlick_weight(cos_h);
        scale += static_cast<double>(weight * (1.0f - schlick));
        bias += static_cast<double>(weight * schlick);
    }
    return {static_cast<float>(scale / points), static_cast<float>(bias / points)};
}

AlbedoTables AlbedoTables::integrated() {
    AlbedoTables out;
    for (int j = 0; j < size; ++j) {
        auto& row = out.albedo[static_cast<size_t>(j)];
        for (int i = 0; i < size; ++i)
            row[static_cast<size_t>(i)] =
                integrate_specular_albedo(table_direction(node_cosine(i), 0.0f), Vec2(node_alpha(j)), 10);
    }
    // The means are those of the interpolated table, so that what the lobes share out adds up.
    constexpr int steps = 1024;
    for (int j = 0; j < size; ++j) {
        MeanSpecularAlbedo& m = out.mean[static_cast<size_t>(j)];
        for (int k = 0; k < steps; ++k) {
            const float cosine = (static_cast<float>(k) + 0.5f) / steps;
            const TableAxis x = locate(std::sqrt(cosine), size);
            const auto& row = out.albedo[static_cast<size_t>(j)];
            const SpecularAlbedo e =
                mix(row[static_cast<size_t>(x.index)], row[static_cast<size_t>(x.index) + 1], x.offset);
            const float weight = 2.0f * cosine / steps;
            m.single.scale += weight * e.scale;
            m.single.bias += weight * e.bias;
            m.compensated.scale += weight * e.scale / e.total();
            m.compensated.bias += weight * e.bias / e.total();
        }
    }
    return out;
}

AnisotropicTable AnisotropicTable::integrated() {
    const auto integrate_node = [](int c, int p, int a, int s) {
        const float cosine = std::max(sqr(static_cast<float>(c) / (cosines - 1)), 1e-4f);
        const float narrow = std::max(sqr(static_cast<float>(a) / (alphas - 1)), min_ggx_alpha);
        const float wide = lerp(narrow, 1.0f, sqr(static_cast<float>(s) / (strengths - 1)));
        return integrate_specular_albedo(table_direction(cosine, 0.5f * pi * static_cast<float>(p) / (azimuths - 1)),
                                         Vec2(wide, narrow), 8);
    };
    AnisotropicTable out;
    size_t at = 0;
    for (int s = 0; s < strengths; ++s) {
        for (int a = 0; a < alphas; ++a) {
            for (int p = 0; p < azimuths; ++p) {
                for (int c = 0; c < cosines; ++c)
                    out.albedo[at++] = integrate_node(c, p, a, s);
            }
        }
    }
    return out;
}

}  // namespace candela
