// SPDX-License-Identifier: MIT
// What the table of sheen.h holds: the lobe before it is scaled, its integral, and where the nodes lie.
#pragma once

#include <array>

#include "renderer/math/math.h"

namespace candela {

// f·cos by Estevez and Kulla 2017, equation 2, and KHR_materials_sheen, "Sheen visibility".
float unscaled_sheen(const Vec3& wo, const Vec3& wi, float alpha) noexcept;

struct SheenTable {
    static constexpr int size = 32;

    std::array<std::array<float, size>, size> albedo;  // [roughness][cosine]

    static SheenTable integrated();
};

}  // namespace candela
