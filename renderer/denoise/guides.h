// SPDX-License-Identifier: MIT
// What a denoiser knows of a picture beside its noisy colours: the first surfaces that its samples meet.
#pragma once

#include "renderer/image/image.h"

namespace candela {

// Of one sample. Where nothing was met: normal and depth 0.
struct Guide {
    Vec3 albedo{1};  // of the surface, with what it emits, at most 1; 1 where nothing was met
    Vec3 normal{0};  // unit, on the side of the eye
    float depth = 0;
};

// Sums over the first samples of each pixel, so that their edges and textures have the aliasing of the colours.
struct Guides {
    Guides() = default;
    explicit Guides(Vec2u extent)
        : albedo(static_cast<int>(extent.x), static_cast<int>(extent.y), Vec3(0)),
          normal(albedo),
          depth(albedo.width(), albedo.height(), 0.0f) {}

    void add(int x, int y, const Guide& guide) noexcept {
        albedo(x, y) += guide.albedo;
        normal(x, y) += guide.normal;
        depth(x, y) += guide.depth;
    }

    uint32_t passes = 0;  // samples in the sums
    ImageRgb32f albedo, normal;
    Image<float> depth;
};

}  // namespace candela
