// SPDX-License-Identifier: MIT
#include "renderer/bsdf/albedo_table.h"

#include <array>
#include <vector>

#include "renderer/bsdf/albedo_integral.h"
#include "renderer/bsdf/bsdf.h"

namespace candela {

namespace {

// Made by make_albedo_table.cpp.
constexpr AlbedoTables tables =
#include "renderer/bsdf/albedo_values.inc"
    ;

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
        return integrate_specular_albedo(table_direction(cosine, 0.5f * pi * static_cast<float>(p) / (azimuths - 1)),
                                         Vec2(wide, narrow), 8);
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
