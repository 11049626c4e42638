// SPDX-License-Identifier: MIT
#include "renderer/sampling/warp.h"

#include <array>

namespace candela {

Vec2 sample_disc(const Vec2& u) noexcept {
    const Vec2 square = 2.0f * u - 1.0f;
    if (square.x == 0.0f && square.y == 0.0f) return Vec2(0);
    float radius, angle;
    if (std::abs(square.x) > std::abs(square.y)) {
        radius = square.x;
        angle = pi / 4.0f * (square.y / square.x);
    } else {
        radius = square.y;
        angle = pi / 2.0f - pi / 4.0f * (square.x / square.y);
    }
    return radius * Vec2(std::cos(angle), std::sin(angle));
}

Vec3 sample_cosine_hemisphere(const Vec2& u) noexcept {
    const Vec2 disc = sample_disc(u);
    return {disc.x, disc.y, safe_sqrt(1.0f - disc.x * disc.x - disc.y * disc.y)};
}

Vec3 sample_sphere(const Vec2& u) noexcept {
    const float z = 1.0f - 2.0f * u.x;
    const float radius = safe_sqrt(1.0f - z * z);
    const float phi = 2.0f * pi * u.y;
    return {radius * std::cos(phi), radius * std::sin(phi), z};
}

Vec2 sample_triangle(const Vec2& u) noexcept {
    const float root = std::sqrt(u.x);
    return {root * (1.0f - u.y), root * u.y};
}

namespace {

// The 4-term Blackman-Harris window on [-1, 1], scaled to integrate to 1 (Harris 1978, minimum 4-term): only the
// constant term survives the integral.
constexpr double a0 = 0.35875, a1 = 0.48829, a2 = 0.14128, a3 = 0.01168;
constexpr double pi_d = 3.14159265358979323846;

double window_pdf(double x) {
    const double t = pi_d * (x + 1.0);
    return (a0 - a1 * std::cos(t) + a2 * std::cos(2 * t) - a3 * std::cos(3 * t)) / (2.0 * a0);
}

double window_cdf(double x) {
    const double t = pi_d * (x + 1.0);
    return (a0 * t - a1 * std::sin(t) + a2 / 2 * std::sin(2 * t) - a3 / 3 * std::sin(3 * t)) / (2.0 * a0 * pi_d);
}

// The inverse distribution function at equal steps of u, by Newton's method within a bracket; between them it is close
// to linear except at the ends, where the window itself is almost 0.
constexpr int window_steps = 4096;
using WindowTable = std::array<float, window_steps + 1>;

WindowTable make_window_table() {
    WindowTable table{};
    for (int i = 0; i <= window_steps; ++i) {
        const double u = static_cast<double>(i) / window_steps;
        double low = -1.0, high = 1.0, x = 0.0;
        for (double step = 1.0; std::abs(step) > 1e-10;) {
            const double excess = window_cdf(x) - u;
            (excess < 0.0 ? low : high) = x;
            const double next = x - excess / window_pdf(x);
            const double inside = next > low && next < high ? next : 0.5 * (low + high);
            step = inside - x;
            x = inside;
        }
        table[static_cast<size_t>(i)] = static_cast<float>(x);
    }
    return table;
}

const WindowTable window_table = make_window_table();

float sample_window(float u) {
    const float at = u * static_cast<float>(window_steps);
    const int i = std::min(static_cast<int>(at), window_steps - 1);
    const auto k = static_cast<size_t>(i);
    return lerp(window_table[k], window_table[k + 1], at - static_cast<float>(i));
}

}  // namespace

Vec2 sample_blackman_harris(const Vec2& u, float radius) noexcept {
    return radius * Vec2(sample_window(u.x), sample_window(u.y));
}

float blackman_harris_pdf(const Vec2& offset, float radius) noexcept {
    const Vec2 x = offset / radius;
    if (std::abs(x.x) >= 1.0f || std::abs(x.y) >= 1.0f) return 0.0f;
    return static_cast<float>(window_pdf(static_cast<double>(x.x)) * window_pdf(static_cast<double>(x.y))) /
           (radius * radius);
}

}  // namespace candela
