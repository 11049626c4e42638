// SPDX-License-Identifier: MIT
// What the tables of albedo_table.h hold: the integrals, and where their nodes lie.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "renderer/bsdf/albedo_table.h"

namespace candela {

// Where a value in [0,1] lies between the nodes of an axis.
struct TableAxis {
    int index = 0;
    float offset = 0;
};
inline TableAxis locate(float t, int nodes) {
    const float at = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(nodes - 1);
    const int index = std::min(static_cast<int>(at), nodes - 2);
    return {index, at - static_cast<float>(index)};
}

inline SpecularAlbedo mix(const SpecularAlbedo& a, const SpecularAlbedo& b, float t) {
    return {lerp(a.scale, b.scale, t), lerp(a.bias, b.bias, t)};
}

Vec3 table_direction(float cosine, float phi);

// Over visible normals, whose weight is G2/G1, with a Hammersley point set of 2^digits points.
SpecularAlbedo integrate_specular_albedo(const Vec3& wo, const Vec2& alpha, uint32_t digits);

// Isotropic lobes. Filling these tables takes tens of milliseconds: the build does that (make_tables.cpp), not the
// program.
struct AlbedoTables {
    static constexpr int size = 32;

    std::array<std::array<SpecularAlbedo, size>, size> albedo;  // [roughness][cosine]
    std::array<MeanSpecularAlbedo, size> mean;                  // [roughness]

    static AlbedoTables integrated();
};

// Albedo by cosine, azimuth from the wide axis, narrow width and anisotropy: alpha.x = mix(alpha.y, 1, anisotropy²).
struct AnisotropicTable {
    static constexpr int cosines = 16, azimuths = 7, alphas = 10, strengths = 6;

    std::array<SpecularAlbedo, size_t{cosines} * azimuths * alphas * strengths> albedo;  // the cosine runs fastest

    static AnisotropicTable integrated();
};

}  // namespace candela
