// SPDX-License-Identifier: MIT
#include "renderer/bsdf/interface_table.h"

#include <vector>

#include "renderer/bsdf/fresnel.h"
#include "renderer/bsdf/microfacet.h"

namespace candela {

namespace {

constexpr int cosines = 24, alphas = 16, indices = 17;

struct Axis {
    size_t index = 0;
    float offset = 0;
};

Axis locate(float t, int size) {
    const float at = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(size - 1);
    const int index = std::min(static_cast<int>(at), size - 2);
    return {static_cast<size_t>(index), at - static_cast<float>(index)};
}

// The axis of indices runs from 1/3 to 3 in equal steps of (eta − 1)/(eta + 1), with 1 in the middle.
float position_of_index(float eta) {
    return (eta - 1.0f) / (eta + 1.0f) + 0.5f;
}

float index_at(float t) {
    return (1.0f + (t - 0.5f)) / (1.0f - (t - 0.5f));
}

// Over visible normals, whose weight is G2/G1, with a Hammersley point set; both branches of each facet are followed.
float integrate(float cos_theta, float alpha_scalar, float eta) {
    constexpr uint32_t count = 256;
    const Vec2 alpha(alpha_scalar);
    const Vec3 wo(safe_sqrt(1.0f - cos_theta * cos_theta), 0.0f, cos_theta);
    const float over_g1 = 2.0f * (wo.z + ggx_root(wo, alpha));
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t bits = 0;
        for (uint32_t b = 0; b < 8; ++b)
            bits |= ((i >> b) & 1u) << (7 - b);
        const Vec2 u((static_cast<float>(i) + 0.5f) / count, (static_cast<float>(bits) + 0.5f) / count);
        const Vec3 h = sample_visible_normal(wo, alpha, u);
        const float cos_h = glm::dot(wo, h);
        const float reflectance = fresnel_dielectric(cos_h, eta);
        const Vec3 reflected = 2.0f * cos_h * h - wo;
        if (reflected.z > 0.0f) {
            sum += static_cast<double>(reflectance * over_g1 * reflected.z * ggx_visibility(wo, reflected, alpha));
        }
        const Vec3 refracted = (cos_h / eta - refracted_cosine(cos_h, eta)) * h - wo / eta;
        if (reflectance < 1.0f && refracted.z < 0.0f) {
            sum += static_cast<double>((1.0f - reflectance) * over_g1 * -refracted.z *
                                       ggx_visibility(wo, refracted, alpha));
        }
    }
    return static_cast<float>(sum / count);
}

struct Table {
    std::vector<float> albedo;

    static size_t at(size_t x, size_t y, size_t z) { return (z * alphas + y) * cosines + x; }

    Table() : albedo(static_cast<size_t>(cosines) * alphas * indices) {
        for (int z = 0; z < indices; ++z) {
            for (int y = 0; y < alphas; ++y) {
                for (int x = 0; x < cosines; ++x) {
                    const float cosine = std::max(sqr(static_cast<float>(x) / (cosines - 1)), 1e-4f);
                    const float alpha = std::max(sqr(static_cast<float>(y) / (alphas - 1)), 1e-3f);
                    albedo[at(static_cast<size_t>(x), static_cast<size_t>(y), static_cast<size_t>(z))] =
                        integrate(cosine, alpha, index_at(static_cast<float>(z) / (indices - 1)));
                }
            }
        }
    }
};

}  // namespace

float interface_albedo(float cos_theta, float alpha, float eta) noexcept {
    static const Table table;
    const Axis x = locate(std::sqrt(std::max(cos_theta, 0.0f)), cosines);
    const Axis y = locate(std::sqrt(alpha), alphas);
    const Axis z = locate(position_of_index(eta), indices);
    const auto along_x = [&](size_t j, size_t k) {
        return lerp(table.albedo[Table::at(x.index, j, k)], table.albedo[Table::at(x.index + 1, j, k)], x.offset);
    };
    const auto along_xy = [&](size_t k) { return lerp(along_x(y.index, k), along_x(y.index + 1, k), y.offset); };
    return lerp(along_xy(z.index), along_xy(z.index + 1), z.offset);
}

}  // namespace candela
