// SPDX-License-Identifier: MIT
// Sampling follows the density, the density integrates to one, energy adds up.
#include <random>

#include "renderer/bsdf/albedo_table.h"
#include "renderer/bsdf/bsdf.h"
#include "renderer/sampling/warp.h"
#include "tests/support/batch_means.h"
#include "tests/support/chi_squared.h"

namespace candela {
namespace {

struct Random {
    std::mt19937 engine{1};
    float operator()() { return static_cast<float>(engine() >> 8) * 0x1p-24f; }
    Vec2 pair() {
        const float a = (*this)();
        return {a, (*this)()};
    }
};

Vec3 direction(float cosine, float phi = 0.6f) {
    const float sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

const float roughnesses[] = {0.1f, 0.3f, 0.6f, 1.0f};
const float cosines[] = {0.05f, 0.3f, 0.7f, 1.0f};

TEST(MetallicRoughness, SamplesFollowThePdf) {
    Random random;
    constexpr int rings = 12, sectors = 24, count = 100000, fine = 48;
    for (const float metallic : {0.0f, 0.5f, 1.0f}) {
        for (const float roughness : {0.3f, 0.6f, 1.0f}) {
            for (const float cosine : cosines) {
                const Bsdf bsdf = make_bsdf(Vec3(0.5f), metallic, roughness, 1.5f, 1, Vec3(1));
                const Vec3 wo = direction(cosine);
                const auto cell_of = [&](const Vec3& wi) {
                    const int ring = std::min(static_cast<int>(wi.z * rings), rings - 1);
                    const float phi = std::atan2(wi.y, wi.x) * (0.5f * inv_pi) + 0.5f;
                    return static_cast<size_t>(ring * sectors + std::min(static_cast<int>(phi * sectors), sectors - 1));
                };
                std::vector<double> counts(rings * sectors, 0), expected(rings * sectors, 0);
                int drawn = 0;
                for (int i = 0; i < count; ++i) {
                    const BsdfSample s = sample(bsdf, wo, random(), random.pair());
                    if (s.pdf <= 0) continue;
                    ++drawn;
                    counts[cell_of(s.wi)] += 1;
                }
                // The pdf integrated over each cell by the midpoint rule, fine enough for the grazing peak.
                double total = 0;
                for (int r = 0; r < rings * fine; ++r) {
                    for (int c = 0; c < sectors * fine; ++c) {
                        const float z = (static_cast<float>(r) + 0.5f) / (rings * fine);
                        const float phi = 2 * pi * ((static_cast<float>(c) + 0.5f) / (sectors * fine) - 0.5f);
                        const Vec3 wi = direction(z, phi);
                        const double mass = static_cast<double>(eval(bsdf, wo, wi).pdf) * 2 * 3.14159265358979 /
                                            (rings * fine * sectors * fine);
                        expected[cell_of(wi)] += mass * count;
                        total += mass;
                    }
                }
                EXPECT_NEAR(total, static_cast<double>(drawn) / count, 0.01);
                EXPECT_LT(test::chi_squared_score(counts, expected), 4.5)
                    << "metallic " << metallic << " roughness " << roughness << " cosine " << cosine;
            }
        }
    }
}

TEST(MetallicRoughness, SampleWeightIsValueOverPdf) {
    Random random;
    for (int i = 0; i < 20000; ++i) {
        const Bsdf bsdf =
            make_bsdf(Vec3(random(), random(), random()), random(), random(), 1 + random(), random(), Vec3(1));
        const Vec3 wo = direction(std::max(random(), 1e-3f));
        const BsdfSample s = sample(bsdf, wo, random(), random.pair());
        if (s.pdf <= 0 || s.is_delta) continue;
        const BsdfEval e = eval(bsdf, wo, s.wi);
        ASSERT_TRUE(is_finite(s.weight));
        ASSERT_NEAR(e.pdf, s.pdf, 1e-4f * s.pdf);
        ASSERT_LT(glm::length(e.value - s.weight * s.pdf), 1e-3f * (1e-6f + glm::length(e.value)));
    }
}

TEST(MetallicRoughness, IsReciprocal) {
    // Compensation depends on wo alone (Turquin 2019) and is not reciprocal: the diffuse part is, and single scattering
    // is.
    Random random;
    for (int i = 0; i < 2000; ++i) {
        const Bsdf bsdf = make_bsdf(Vec3(0.8f, 0.5f, 0.2f), 0, random(), 1.5f, 0, Vec3(1));
        const Vec3 a = direction(0.05f + 0.95f * random(), 6 * random()),
                   b = direction(0.05f + 0.95f * random(), 6 * random());
        const Vec3 ab = eval(bsdf, a, b).value / b.z, ba = eval(bsdf, b, a).value / a.z;
        EXPECT_LT(glm::length(ab - ba), 1e-5f);
    }
}

TEST(MetallicRoughness, WhiteFurnaceReadsOneAndAlbedoIsTheIntegral) {
    Random random;
    for (const float metallic : {0.0f, 1.0f}) {
        for (const float roughness : roughnesses) {
            for (const float cosine : cosines) {
                for (const Vec3 color : {Vec3(1), Vec3(0.9f, 0.5f, 0.1f)}) {
                    const Bsdf bsdf = make_bsdf(color, metallic, roughness, 1.5f, 1, Vec3(1));
                    const Vec3 wo = direction(cosine);
                    test::BatchMeans means;
                    for (int batch = 0; batch < 32; ++batch) {
                        double sum = 0;
                        for (int i = 0; i < 1024; ++i) {
                            sum += static_cast<double>(luminance(sample(bsdf, wo, random(), random.pair()).weight));
                        }
                        means.add(sum / 1024);
                    }
                    // The table is within 3e-3 of the integral, most where it is steep: at grazing angles.
                    const double table = static_cast<double>(luminance(albedo(bsdf, wo)));
                    EXPECT_NEAR(means.mean(), table, 4 * means.standard_error() + 3e-3)
                        << "metallic " << metallic << " roughness " << roughness << " cosine " << cosine;
                    EXPECT_LE(table, 1.0 + 1e-5);
                    if (color == Vec3(1)) {
                        EXPECT_NEAR(table, 1.0, 1e-5);
                    }
                }
            }
        }
    }
}

TEST(MetallicRoughness, WithoutSpecularItIsExactlyLambert) {
    const Bsdf bsdf = make_bsdf(Vec3(0.5f), 0, 0.3f, 1.5f, 0, Vec3(1));
    for (const float cosine : cosines) {
        const BsdfEval e = eval(bsdf, direction(0.4f), direction(cosine, 2));
        EXPECT_FLOAT_EQ(e.value.x, 0.5f * inv_pi * cosine);
        EXPECT_FLOAT_EQ(e.pdf, inv_pi * cosine);
    }
}

}  // namespace
}  // namespace candela
