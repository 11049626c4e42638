// SPDX-License-Identifier: MIT
#include "renderer/bsdf/sheen_integral.h"

#include "renderer/bsdf/sheen.h"

namespace candela {

namespace {

// Nodes are denser towards grazing angles, and lie at equal steps of the sheen roughness.
float node_cosine(int i) {
    return std::max(sqr(static_cast<float>(i) / static_cast<float>(SheenTable::size - 1)), 1e-4f);
}

float node_alpha(int j) {
    return std::max(sqr(static_cast<float>(j) / static_cast<float>(SheenTable::size - 1)), min_sheen_alpha);
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

}  // namespace

float unscaled_sheen(const Vec3& wo, const Vec3& wi, float alpha) noexcept {
    const Vec3 h = glm::normalize(wo + wi);
    const float inverse = 1.0f / std::max(alpha, min_sheen_alpha);
    const float sine = safe_sqrt(1.0f - h.z * h.z);
    const float density = (2.0f + inverse) * std::pow(sine, inverse) * (0.5f * inv_pi);
    return density * wi.z / (4.0f * (wi.z + wo.z - wi.z * wo.z));
}

SheenTable SheenTable::integrated() {
    SheenTable out{};
    for (int j = 0; j < size; ++j) {
        for (int i = 0; i < size; ++i)
            out.albedo[static_cast<size_t>(j)][static_cast<size_t>(i)] = integrate(node_cosine(i), node_alpha(j));
    }
    return out;
}

}  // namespace candela
