// SPDX-License-Identifier: MIT
// An equirectangular environment, sampled by what it shines above its mean: beside BSDF samples, which find the even
// part as well, that is where light samples help (Karlík et al. 2019, "MIS Compensation: Optimizing Sampling Techniques
// in Multiple Importance Sampling").
#pragma once

#include "renderer/sampling/distribution.h"
#include "renderer/scene/scene.h"

namespace candela {

class EnvironmentLight {
  public:
    explicit EnvironmentLight(const Environment& environment);

    // Radiance that arrives from the unit direction wi (bilinear, seam wrapped), intensity and rotation applied.
    Vec3 radiance(const Vec3& wi) const noexcept;
    // Draws wi; returns its pdf per solid angle (0: none). complete: half of the samples go everywhere alike, so that
    // they miss nothing; else all go to what stands out, and a constant environment has none.
    float sample(const Vec2& u, bool complete, Vec3& wi) const noexcept;
    float pdf(const Vec3& wi, bool complete) const noexcept;
    // Means over the sphere of the luminance, and of its part above that mean.
    float mean_luminance() const { return mean_luminance_; }
    float mean_excess() const { return mean_excess_; }
    // The radiance where it is one constant.
    bool is_constant() const { return image_.width() == 1 && image_.height() == 1; }

  private:
    ImageRgb32f image_;  // intensity applied
    float rotation_radians_ = 0;
    float mean_luminance_ = 0;
    float mean_excess_ = 0;
    Distribution2D distribution_;
};

}  // namespace candela
