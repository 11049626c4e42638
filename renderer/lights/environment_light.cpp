// SPDX-License-Identifier: MIT
#include "renderer/lights/environment_light.h"

#include <glm/gtc/constants.hpp>

#include "renderer/sampling/warp.h"

namespace candela {

namespace {

// Directions to the unit square: interface.md's convention, the picture turned by the rotation.
Vec2 uv_of(const Vec3& wi, float rotation_radians) {
    const float turned = (std::atan2(wi.z, wi.x) + rotation_radians) * (0.5f * inv_pi) + 0.5f;
    const float u = turned - std::floor(turned);
    const float v = 0.5f - std::asin(std::clamp(wi.y, -1.0f, 1.0f)) * inv_pi;
    return {std::min(u, one_minus_epsilon), std::clamp(v, 0.0f, one_minus_epsilon)};
}

}  // namespace

EnvironmentLight::EnvironmentLight(const Environment& environment)
    : image_(environment.radiance), rotation_radians_(environment.rotation_radians) {
    for (Vec3& texel : image_.pixels()) {
        texel *= environment.intensity;
        // A texel that is no radiance would poison every picture: it gives none.
        if (!is_finite(texel)) texel = Vec3(0);
        texel = glm::max(texel, Vec3(0));
    }
    if (image_.empty()) image_ = ImageRgb32f(1, 1, Vec3(0));

    // Weigh each cell by the integral of the bilinear picture's luminance over it, so that no light lies where the
    // density is 0.
    const int width = image_.width(), height = image_.height();
    std::vector<float> weights(image_.size());
    double sum = 0;
    for (int y = 0; y < height; ++y) {
        const double top = std::cos(glm::pi<double>() * y / height);
        const double bottom = std::cos(glm::pi<double>() * (y + 1) / height);
        for (int x = 0; x < width; ++x) {
            constexpr float tap[3] = {0.125f, 0.75f, 0.125f};
            float mean = 0;
            for (int j = -1; j <= 1; ++j) {
                for (int i = -1; i <= 1; ++i) {
                    const Vec3& texel = image_((x + i + width) % width, std::clamp(y + j, 0, height - 1));
                    mean += tap[i + 1] * tap[j + 1] * luminance(texel);
                }
            }
            const double weight = static_cast<double>(mean) * (top - bottom);
            weights[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)] =
                static_cast<float>(weight);
            sum += weight;
        }
    }
    mean_luminance_ = static_cast<float>(sum / (2.0 * width));
    distribution_ = Distribution2D(weights, width, height);
}

Vec3 EnvironmentLight::radiance(const Vec3& wi) const noexcept {
    if (is_constant()) return image_(0, 0);
    const int width = image_.width(), height = image_.height();
    const Vec2 at = uv_of(wi, rotation_radians_) * Vec2(static_cast<float>(width), static_cast<float>(height)) - 0.5f;
    const Vec2 base = glm::floor(at);
    const Vec2 t = at - base;
    const int x0 = (static_cast<int>(base.x) + width) % width;
    const int x1 = (x0 + 1) % width;
    const int y0 = std::clamp(static_cast<int>(base.y), 0, height - 1);
    const int y1 = std::clamp(static_cast<int>(base.y) + 1, 0, height - 1);
    return (1 - t.y) * ((1 - t.x) * image_(x0, y0) + t.x * image_(x1, y0)) +
           t.y * ((1 - t.x) * image_(x0, y1) + t.x * image_(x1, y1));
}

float EnvironmentLight::sample(const Vec2& u, Vec3& wi) const noexcept {
    if (is_constant()) {
        wi = sample_sphere(u);
        return sphere_pdf();
    }
    float pdf_uv = 0;
    const Vec2 uv = distribution_.sample(u, pdf_uv);
    const float phi = (uv.x - 0.5f) * 2.0f * pi - rotation_radians_;
    const float latitude = (0.5f - uv.y) * pi;
    const float cosine = std::cos(latitude);
    wi = {cosine * std::cos(phi), std::sin(latitude), cosine * std::sin(phi)};
    // d(solid angle) = 2π² cos(latitude) du dv
    return cosine > 0.0f ? pdf_uv / (2.0f * pi * pi * cosine) : 0.0f;
}

float EnvironmentLight::pdf(const Vec3& wi) const noexcept {
    if (is_constant()) return sphere_pdf();
    const float cosine = safe_sqrt(1.0f - wi.y * wi.y);
    if (!(cosine > 0.0f)) return 0.0f;
    return distribution_.pdf(uv_of(wi, rotation_radians_)) / (2.0f * pi * pi * cosine);
}

}  // namespace candela
