// SPDX-License-Identifier: MIT
#include "renderer/bsdf/albedo_table.h"

#include "renderer/bsdf/albedo_integral.h"
#include "renderer/bsdf/bsdf.h"

namespace candela {

namespace {

// Made by make_tables.cpp.
constexpr AlbedoTables tables =
#include "renderer/bsdf/albedo_values.inc"
    ;

constexpr AnisotropicTable anisotropic =
#include "renderer/bsdf/anisotropic_values.inc"
    ;

SpecularAlbedo anisotropic_albedo(const Vec3& wo, const Vec2& alpha) {
    constexpr int cosines = AnisotropicTable::cosines, azimuths = AnisotropicTable::azimuths;
    constexpr int alphas = AnisotropicTable::alphas, strengths = AnisotropicTable::strengths;
    const float strength = safe_sqrt((alpha.x - alpha.y) / std::max(1.0f - alpha.y, 1e-6f));
    const TableAxis axes[4] = {locate(std::sqrt(std::max(wo.z, 0.0f)), cosines),
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
        sum.scale += weight * anisotropic.albedo[at].scale;
        sum.bias += weight * anisotropic.albedo[at].bias;
    }
    return sum;
}

}  // namespace

SpecularAlbedo specular_albedo(const Vec3& wo, const Vec2& alpha) noexcept {
    if (alpha.x == alpha.y) return specular_albedo(wo.z, alpha.x);
    return anisotropic_albedo(wo, alpha);
}

SpecularAlbedo specular_albedo(float cos_theta, float alpha) noexcept {
    const TableAxis x = locate(std::sqrt(std::max(cos_theta, 0.0f)), AlbedoTables::size);
    const TableAxis y = locate(std::sqrt(alpha), AlbedoTables::size);
    const auto& low = tables.albedo[static_cast<size_t>(y.index)];
    const auto& high = tables.albedo[static_cast<size_t>(y.index) + 1];
    const auto i = static_cast<size_t>(x.index);
    return mix(mix(low[i], low[i + 1], x.offset), mix(high[i], high[i + 1], x.offset), y.offset);
}

MeanSpecularAlbedo mean_specular_albedo(float alpha) noexcept {
    const TableAxis y = locate(std::sqrt(alpha), AlbedoTables::size);
    const MeanSpecularAlbedo& low = tables.mean[static_cast<size_t>(y.index)];
    const MeanSpecularAlbedo& high = tables.mean[static_cast<size_t>(y.index) + 1];
    return {mix(low.single, high.single, y.offset), mix(low.compensated, high.compensated, y.offset)};
}

}  // namespace candela
