// SPDX-License-Identifier: MIT
// An equirectangular environment, sampled by what it shines.
#pragma once

#include "renderer/sampling/distribution.h"
#include "renderer/scene/scene.h"

namespace candela {

class EnvironmentLight {
  public:
    explicit EnvironmentLight(const Environment& environment);

    // Radiance that arrives from the unit direction wi (bilinear, seam wrapped), intensity and rotation applied.
    Vec3 radiance(const Vec3& wi) const noexcept;
    // Draws wi; returns its pdf per solid angle (0: none).
    float sample(const Vec2& u, Vec3& wi) const noexcept;
    float pdf(const Vec3& wi) const noexcept;
    // Mean of the luminance over the sphere.
    float mean_luminance() const { return mean_luminance_; }
    // The radiance where it is one constant.
    bool is_constant() const { return image_.width() == 1 && image_.height() == 1; }

  private:
    ImageRgb32f image_;  // intensity applied
    float rotation_radians_ = 0;
    float mean_luminance_ = 0;
    Distribution2D distribution_;
};

}  // namespace candela
