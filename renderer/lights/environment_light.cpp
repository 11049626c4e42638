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

    // The mean of the bilinear picture's luminance over each cell, and over the sphere.
    const int width = image_.width(), height = image_.height();
    std::vector<float> weights(image_.size());
    const auto row_height = [height](int y) {
        return std::cos(glm::pi<double>() * y / height) - std::cos(glm::pi<double>() * (y + 1) / height);
    };
    double sum = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            constexpr float tap[3] = {0.125f, 0.75f, 0.125f};
            float mean = 0;
            for (int j = -1; j <= 1; ++j) {
                for (int i = -1; i <= 1; ++i) {
                    const Vec3& texel = image_((x + i + width) % width, std::clamp(y + j, 0, height - 1));
                    mean += tap[i + 1] * tap[j + 1] * luminance(texel);
                }
            }
            weights[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)] = mean;
            sum += static_cast<double>(mean) * row_height(y);
        }
    }
    mean_luminance_ = static_cast<float>(sum / (2.0 * width));

    // Cells weigh what they shine above the mean, times their solid angle.
    double excess = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            float& weight = weights[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
            const double part = static_cast<double>(std::max(weight - mean_luminance_, 0.0f)) * row_height(y);
            weight = static_cast<float>(part);
            excess += part;
        }
    }
    mean_excess_ = is_constant() ? 0.0f : static_cast<float>(excess / (2.0 * width));
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

float EnvironmentLight::sample(const Vec2& u, bool complete, Vec3& wi) const noexcept {
    Vec2 u_rest = u;
    if (complete) {
        if (!(mean_excess_ > 0.0f) || u.x < 0.5f) {
            wi = sample_sphere(mean_excess_ > 0.0f ? Vec2(2.0f * u.x, u.y) : u);
            return pdf(wi, true);
        }
        u_rest.x = std::min(2.0f * u.x - 1.0f, one_minus_epsilon);
    }
    if (!(mean_excess_ > 0.0f)) return 0.0f;
    float pdf_uv = 0;
    const Vec2 uv = distribution_.sample(u_rest, pdf_uv);
    const float phi = (uv.x - 0.5f) * 2.0f * pi - rotation_radians_;
    const float latitude = (0.5f - uv.y) * pi;
    const float cosine = std::cos(latitude);
    wi = {cosine * std::cos(phi), std::sin(latitude), cosine * std::sin(phi)};
    // d(solid angle) = 2π² cos(latitude) du dv
    const float density = cosine > 0.0f ? pdf_uv / (2.0f * pi * pi * cosine) : 0.0f;
    return complete ? 0.5f * (density + sphere_pdf()) : density;
}

float EnvironmentLight::pdf(const Vec3& wi, bool complete) const noexcept {
    if (!(mean_excess_ > 0.0f)) return complete ? sphere_pdf() : 0.0f;
    const float cosine = safe_sqrt(1.0f - wi.y * wi.y);
    const float density =
        cosine > 0.0f ? distribution_.pdf(uv_of(wi, rotation_radians_)) / (2.0f * pi * pi * cosine) : 0.0f;
    return complete ? 0.5f * (density + sphere_pdf()) : density;
}

}  // namespace candela
