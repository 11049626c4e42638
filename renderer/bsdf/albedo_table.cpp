// SPDX-License-Identifier: MIT
#include "renderer/bsdf/albedo_table.h"

#include <array>
#include <vector>

#include "renderer/bsdf/bsdf.h"
#include "renderer/bsdf/fresnel.h"
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

Axis locate(float t, int nodes = size) {
    const float at = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(nodes - 1);
    const int index = std::min(static_cast<int>(at), nodes - 2);
    return {index, at - static_cast<float>(index)};
}

SpecularAlbedo mix(const SpecularAlbedo& a, const SpecularAlbedo& b, float t) {
    return {lerp(a.scale, b.scale, t), lerp(a.bias, b.bias, t)};
}

Vec3 direction(float cosine, float phi) {
    const float sine = safe_sqrt(1.0f - cosine * cosine);
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

// Integrates over visible normals, whose weight is G2/G1, with a Hammersley point set of 2^digits points.
SpecularAlbedo integrate(const Vec3& wo, const Vec2& alpha, uint32_t digits) {
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

struct Tables {
    std::array<std::array<SpecularAlbedo, size>, size> albedo;  // [roughness][cosine]
    std::array<MeanSpecularAlbedo, size> mean;                  // [roughness]

    Tables() {
        for (int j = 0; j < size; ++j) {
            auto& row = albedo[static_cast<size_t>(j)];
            for (int i = 0; i < size; ++i)
                row[static_cast<size_t>(i)] = integrate(direction(node_cosine(i), 0.0f), Vec2(node_alpha(j)), 10);
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

// Albedo by cosine, azimuth from the wide axis, narrow width and anisotropy: alpha.x = mix(alpha.y, 1, anisotropy²).
class AnisotropicTable {
  public:
    AnisotropicTable() : albedo_(static_cast<size_t>(cosines) * azimuths * alphas * strengths) {
        size_t at = 0;
        for (int s = 0; s < strengths; ++s) {
            for (int a = 0; a < alphas; ++a) {
                for (int p = 0; p < azimuths; ++p) {
                    for (int c = 0; c < cosines; ++c)
                        albedo_[at++] = integrate_node(c, p, a, s);
                }
            }
        }
    }

    SpecularAlbedo lookup(const Vec3& wo, const Vec2& alpha) const {
        const float strength = safe_sqrt((alpha.x - alpha.y) / std::max(1.0f - alpha.y, 1e-6f));
        const Axis axes[4] = {locate(std::sqrt(std::max(wo.z, 0.0f)), cosines),
                              locate(std::atan2(std::abs(wo.y), std::abs(wo.x)) * (2.0f * inv_pi), azimuths),
                              locate(std::sqrt(alpha.y), alphas), locate(strength, strengths)};
        constexpr size_t stride[4] = {1, cosines, cosines * azimuths, cosines * azimuths * alphas};
        SpecularAlbedo sum;
        for (unsigned corner = 0; corner < 16; ++corner) {
            size_t at = 0;
            float weight = 1;
            for (unsigned d = 0; d < 4; ++d) {
                const bool upper = (corner >> d & 1u) != 0;
                at += (static_cast<size_t>(axes[d].index) + (upper ? 1 : 0)) * stride[d];
                weight *= upper ? axes[d].offset : 1.0f - axes[d].offset;
            }
            sum.scale += weight * albedo_[at].scale;
            sum.bias += weight * albedo_[at].bias;
        }
        return sum;
    }

  private:
    static constexpr int cosines = 16, azimuths = 7, alphas = 10, strengths = 6;

    static SpecularAlbedo integrate_node(int c, int p, int a, int s) {
        const float cosine = std::max(sqr(static_cast<float>(c) / (cosines - 1)), 1e-4f);
        const float narrow = std::max(sqr(static_cast<float>(a) / (alphas - 1)), min_ggx_alpha);
        const float wide = lerp(narrow, 1.0f, sqr(static_cast<float>(s) / (strengths - 1)));
        return integrate(direction(cosine, 0.5f * pi * static_cast<float>(p) / (azimuths - 1)), Vec2(wide, narrow), 8);
    }

    std::vector<SpecularAlbedo> albedo_;
};

}  // namespace

SpecularAlbedo specular_albedo(const Vec3& wo, const Vec2& alpha) noexcept {
    if (alpha.x == alpha.y) return specular_albedo(wo.z, alpha.x);
    static const AnisotropicTable table;
    return table.lookup(wo, alpha);
}

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
