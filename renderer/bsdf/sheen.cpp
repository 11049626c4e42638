// SPDX-License-Identifier: MIT
#include "renderer/bsdf/sheen.h"

#include "renderer/bsdf/sheen_integral.h"

namespace candela {

namespace {

// Made by make_tables.cpp.
constexpr SheenTable table =
#include "renderer/bsdf/sheen_values.inc"
    ;

// Nodes lie as in sheen_integral.cpp.
float tabulated(float cos_theta, float alpha) {
    constexpr int size = SheenTable::size;
    const float x = std::sqrt(std::clamp(cos_theta, 0.0f, 1.0f)) * (size - 1);
    const float y = std::sqrt(std::clamp(alpha, min_sheen_alpha, 1.0f)) * (size - 1);
    const int i = std::min(static_cast<int>(x), size - 2), j = std::min(static_cast<int>(y), size - 2);
    const auto row = [&](int k) {
        const auto& values = table.albedo[static_cast<size_t>(k)];
        return lerp(values[static_cast<size_t>(i)], values[static_cast<size_t>(i) + 1], x - static_cast<float>(i));
    };
    return lerp(row(j), row(j + 1), y - static_cast<float>(j));
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
