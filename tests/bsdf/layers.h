// SPDX-License-Identifier: MIT
// Random layered materials, and directions, for tests of scattering.
#pragma once

#include <random>
#include <string>

#include "renderer/bsdf/bsdf.h"

namespace candela::test {

struct Random {
    explicit Random(uint32_t seed) : engine(seed) {}
    std::mt19937 engine;
    float operator()() { return static_cast<float>(engine() >> 8) * 0x1p-24f; }
    Vec2 pair() {
        const float a = (*this)();
        return {a, (*this)()};
    }
    // One of some cases.
    bool chance(float p) { return (*this)() < p; }
};

inline Vec3 direction(float cosine, float phi = 0.6f) {
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

// A material of random layers. white: every colour is white and nothing is absorbed.
inline Bsdf random_material(Random& random, bool white) {
    const auto color = [&] { return white ? Vec3(1) : Vec3(random(), random(), random()); };
    const auto roughness = [&] { return random.chance(0.2f) ? 0.0f : 0.05f + 0.95f * random(); };
    const float ior = random.chance(0.2f) ? 1.0f : 1.0f + 2.0f * random();
    const bool inside = random.chance(0.3f);
    Bsdf bsdf = make_bsdf(color(), random.chance(0.5f) ? 0.0f : random(), roughness(), inside ? 1.0f / ior : ior,
                          white ? 1.0f : random(), Vec3(1));
    if (random.chance(0.3f)) bsdf.alpha = anisotropic_alpha(random(), random());
    if (random.chance(0.5f)) bsdf.transmission = random.chance(0.5f) ? 1.0f : random();
    bsdf.thin_walled = random.chance(0.5f);
    if (random.chance(0.3f) && (bsdf.thin_walled || bsdf.transmission == 0.0f)) {
        bsdf.diffuse_transmission = random();
        bsdf.diffuse_transmission_color = color();
    }
    if (random.chance(0.3f)) {
        bsdf.sheen_color = color();
        bsdf.sheen_alpha = random();
    }
    if (random.chance(0.3f)) {
        bsdf.coat = random();
        bsdf.coat_alpha = ggx_alpha(roughness());
    }
    return bsdf;
}

inline std::string describe(const Bsdf& b) {
    char text[400];
    std::snprintf(text, sizeof text,
                  "color %.2f metallic %.2f alpha %.4f %.4f transmission %.2f%s eta %.3f f0 %.3f f90 %.2f diffuse "
                  "transmission %.2f sheen %.2f alpha %.3f coat %.2f alpha %.4f",
                  static_cast<double>(b.base_color.x), static_cast<double>(b.metallic), static_cast<double>(b.alpha.x),
                  static_cast<double>(b.alpha.y), static_cast<double>(b.transmission), b.thin_walled ? " thin" : "",
                  static_cast<double>(b.eta), static_cast<double>(b.dielectric_f0.x),
                  static_cast<double>(b.dielectric_f90), static_cast<double>(b.diffuse_transmission),
                  static_cast<double>(b.sheen_color.x), static_cast<double>(b.sheen_alpha), static_cast<double>(b.coat),
                  static_cast<double>(b.coat_alpha));
    return text;
}

}  // namespace candela::test
