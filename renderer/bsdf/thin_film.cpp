// SPDX-License-Identifier: MIT
#include "renderer/bsdf/thin_film.h"

#include "renderer/bsdf/fresnel.h"

namespace candela {

namespace {

Vec3 schlick(const Vec3& f0, float cos_theta) {
    return glm::mix(f0, Vec3(1), schlick_weight(cos_theta));
}

// The index whose normal reflectance against `outside` is f0.
Vec3 index_of(const Vec3& f0, float outside) {
    const Vec3 root = glm::sqrt(glm::clamp(f0, 0.0f, 0.9999f));
    return outside * (1.0f + root) / (1.0f - root);
}

// Fourier transform of the CIE XYZ sensitivities at an optical path difference, as sRGB: section 4 and the fit in its
// supplement. path_difference_nm, phase in radians.
Vec3 sensitivity(float path_difference_nm, const Vec3& phase) {
    const float k = 2.0f * pi * path_difference_nm * 1e-9f;
    const Vec3 value(5.4856e-13f, 4.4201e-13f, 5.2481e-13f);
    const Vec3 position(1.6810e+06f, 1.7953e+06f, 2.2084e+06f);
    const Vec3 variance(4.3278e+09f, 9.3046e+09f, 6.6121e+09f);
    Vec3 xyz = value * glm::sqrt(2.0f * pi * variance) * glm::cos(position * k + phase) * glm::exp(-k * k * variance);
    xyz.x += 9.7470e-14f * std::sqrt(2.0f * pi * 4.5282e+09f) * std::cos(2.2399e+06f * k + phase.x) *
             std::exp(-4.5282e+09f * k * k);
    xyz /= 1.0685e-7f;
    return {3.2404542f * xyz.x - 1.5371385f * xyz.y - 0.4985314f * xyz.z,
            -0.9692660f * xyz.x + 1.8760108f * xyz.y + 0.0415560f * xyz.z,
            0.0556434f * xyz.x - 0.2040259f * xyz.y + 1.0572252f * xyz.z};
}

}  // namespace

Vec3 thin_film_reflectance(float outside_ior, float film_ior, float cos_theta, float thickness_nm,
                           const Vec3& base_f0) noexcept {
    // A vanishing film has the index of what lies outside.
    const float t = std::clamp(thickness_nm / 0.03f, 0.0f, 1.0f);
    const float ior = lerp(outside_ior, film_ior, t * t * (3.0f - 2.0f * t));
    const float sin2 = sqr(outside_ior / ior) * (1.0f - cos_theta * cos_theta);
    if (sin2 >= 1.0f) return Vec3(1);
    const float cos_film = std::sqrt(1.0f - sin2);

    // First interface: outside to film, exact, so that a film that vanishes reflects nothing.
    const float r12 = fresnel_dielectric(cos_theta, ior / outside_ior);
    const float t121 = 1.0f - r12;
    const float phase12 = ior < outside_ior ? pi : 0.0f;
    const float phase21 = pi - phase12;

    // Second interface: film to base.
    const Vec3 base_ior = index_of(base_f0, 1.0f);
    const Vec3 r0 = (base_ior - ior) / (base_ior + ior);
    const Vec3 r23 = schlick(r0 * r0, cos_film);
    const Vec3 phase23(base_ior.x < ior ? pi : 0.0f, base_ior.y < ior ? pi : 0.0f, base_ior.z < ior ? pi : 0.0f);

    // The Airy summation, its series cut after the second order: equations 8 to 10.
    const float path_difference = 2.0f * ior * thickness_nm * cos_film;
    const Vec3 phase = Vec3(phase21) + phase23;
    const Vec3 r123 = glm::clamp(r12 * r23, 1e-5f, 0.9999f);
    const Vec3 root = glm::sqrt(r123);
    const Vec3 rs = t121 * t121 * r23 / (1.0f - r123);
    Vec3 out = Vec3(r12) + rs;
    Vec3 amplitude = rs - t121;
    for (int order = 1; order <= 2; ++order) {
        amplitude *= root;
        const auto m = static_cast<float>(order);
        out += amplitude * 2.0f * sensitivity(m * path_difference, m * phase);
    }
    return glm::clamp(out, 0.0f, 1.0f);
}

Vec3 schlick_f0(const Vec3& reflectance, float cos_theta) noexcept {
    const float w = schlick_weight(cos_theta);
    return w > 0.9999f ? reflectance : glm::clamp((reflectance - w) / (1.0f - w), 0.0f, 1.0f);
}

}  // namespace candela
