// SPDX-License-Identifier: MIT
#include "renderer/bsdf/sheen.h"

#include <array>

namespace candela {

namespace {

constexpr int size = 32;

// Nodes are denser towards grazing angles, and lie at equal steps of the sheen roughness.
float node_cosine(int i) {
    return std::max(sqr(static_cast<float>(i) / static_cast<float>(size - 1)), 1e-4f);
}

float node_alpha(int j) {
    return std::max(sqr(static_cast<float>(j) / static_cast<float>(size - 1)), min_sheen_alpha);
}

// Estevez and Kulla 2017, equation 2, and KHR_materials_sheen, "Sheen visibility".
float unscaled_sheen(const Vec3& wo, const Vec3& wi, float alpha) {
    const Vec3 h = glm::normalize(wo + wi);
    const float inverse = 1.0f / std::max(alpha, min_sheen_alpha);
    const float sine = safe_sqrt(1.0f - h.z * h.z);
    const float density = (2.0f + inverse) * std::pow(sine, inverse) * (0.5f * inv_pi);
    return density * wi.z / (4.0f * (wi.z + wo.z - wi.z * wo.z));
}

float integrate(float cos_theta, float alpha) {
    constexpr int rings = 64, sectors = 64;
    const Vec3 wo(safe_sqrt(1.0f - cos_theta * cos_theta), 0.0f, cos_theta);
    double sum = 0;
    for (int r = 0; r < rings; ++r) {
        for (int s = 0; s < sectors; ++s) {
            const float z = (static_cast<float>(r) + 0.5f) / rings;
            // The lobe is symmetric about wo's plane: half a turn is enough.
            const float phi = pi * (static_cast<float>(s) + 0.5f) / sectors;
            const float sine = safe_sqrt(1.0f - z * z);
            sum += static_cast<double>(unscaled_sheen(wo, Vec3(sine * std::cos(phi), sine * std::sin(phi), z), alpha));
        }
    }
    return static_cast<float>(sum * 2.0 * static_cast<double>(pi) / (rings * sectors));
}

struct Table {
    std::array<std::array<float, size>, size> albedo;  // [roughness][cosine]

    Table() {
        for (int j = 0; j < size; ++j) {
            for (int i = 0; i < size; ++i)
                albedo[static_cast<size_t>(j)][static_cast<size_t>(i)] = integrate(node_cosine(i), node_alpha(j));
        }
    }

    float lookup(float cos_theta, float alpha) const {
        const float x = std::sqrt(std::clamp(cos_theta, 0.0f, 1.0f)) * (size - 1);
        const float y = std::sqrt(std::clamp(alpha, min_sheen_alpha, 1.0f)) * (size - 1);
        const int i = std::min(static_cast<int>(x), size - 2), j = std::min(static_cast<int>(y), size - 2);
        const auto row = [&](int k) {
            const auto& values = albedo[static_cast<size_t>(k)];
            return lerp(values[static_cast<size_t>(i)], values[static_cast<size_t>(i) + 1], x - static_cast<float>(i));
        };
        return lerp(row(j), row(j + 1), y - static_cast<float>(j));
    }
};

// Made when the first cloth is met.
float tabulated(float cos_theta, float alpha) {
    static const Table table;
    return table.lookup(cos_theta, alpha);
}

}  // namespace

// Ashikhmin's visibility gives more light than it got at grazing angles of rough cloth; there the lobe is scaled down.
float eval_sheen(const Vec3& wo, const Vec3& wi, float alpha) noexcept {
    if (!(wi.z > 0.0f)) return 0.0f;
    return unscaled_sheen(wo, wi, alpha) / std::max(1.0f, tabulated(wo.z, alpha));
}

float sheen_albedo(float cos_theta, float alpha) noexcept {
    return std::min(1.0f, tabulated(cos_theta, alpha));
}

Vec3 sample_sheen(const Vec2& u) noexcept {
    const float sine = safe_sqrt(1.0f - u.x * u.x);
    return {sine * std::cos(2.0f * pi * u.y), sine * std::sin(2.0f * pi * u.y), u.x};
}

float sheen_pdf() noexcept {
    return 0.5f * inv_pi;
}

}  // namespace candela
