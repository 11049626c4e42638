// SPDX-License-Identifier: MIT
// Every lobe and random stacks of them: what sample() draws follows pdf, sample and eval agree, and energy adds up.
#include "renderer/bsdf/dielectric.h"
#include "renderer/bsdf/fresnel.h"
#include "renderer/bsdf/interface_table.h"
#include "renderer/bsdf/sheen.h"
#include "renderer/bsdf/thin_film.h"
#include "tests/bsdf/layers.h"
#include "tests/bsdf/lobe_cells.h"
#include "tests/support/batch_means.h"
#include "tests/support/chi_squared.h"

namespace candela {
namespace {

using test::describe;
using test::direction;
using test::Random;

struct ChiSquared {
    double score = 0;
    double mass = 0;   // of the pdf over the sphere
    double drawn = 0;  // share of the samples that were not deltas and not nothing
};

// Draws from the BSDF and integrates its pdf over each cell. Deltas are left out of both.
ChiSquared compare_samples_with_pdf(const Bsdf& bsdf, const Vec3& wo, const test::LobeCells& cells, Random& random,
                                    int count) {
    std::vector<double> counts(cells.size(), 0.0);
    ChiSquared out;
    for (int i = 0; i < count; ++i) {
        const BsdfSample s = sample(bsdf, wo, random(), random.pair());
        if (!(s.pdf > 0.0f) || s.is_delta) continue;
        counts[cells.cell_of(s.wi)] += 1;
        out.drawn += 1.0 / count;
    }
    std::vector<double> expected = cells.integrate([&](const Vec3& wi) { return eval(bsdf, wo, wi).pdf; });
    for (double& mass : expected) {
        out.mass += mass;
        mass *= count;
    }
    out.score = test::chi_squared_score(counts, expected);
    return out;
}

// The cells that suit a material seen from wo: by the normal and the widths of its narrowest lobe.
test::LobeCells cells_for(const Bsdf& bsdf, const Vec3& wo) {
    const bool refracts = bsdf.transmission > 0.0f && !bsdf.thin_walled && std::abs(bsdf.eta - 1.0f) > 1e-3f;
    const bool rough_base = bsdf.alpha.x > 0.0f, rough_coat = bsdf.coat > 0.0f && bsdf.coat_alpha > 0.0f;
    const bool by_coat = rough_coat && (!rough_base || bsdf.coat_alpha < bsdf.alpha.y);
    const Vec2 alpha = by_coat ? Vec2(bsdf.coat_alpha) : rough_base ? bsdf.alpha : Vec2(1);
    return {wo, by_coat ? bsdf.coat_normal : Vec3(0, 0, 1), alpha,
            refracts && rough_base && !(bsdf.diffuse_transmission > 0.0f) ? bsdf.eta : 0.0f};
}

TEST(LayeredBsdf, SamplesFollowThePdfOfEveryLobe) {
    Random random(1);
    std::vector<std::pair<std::string, Bsdf>> lobes;
    // 0.001 is a mirror, 0.032 the narrowest lobe that is none.
    for (const float roughness : {0.001f, 0.032f, 0.1f, 0.2f, 0.4f, 0.7f, 1.0f}) {
        lobes.emplace_back("metal", make_bsdf(Vec3(0.9f), 1, roughness, 1.5f, 1, Vec3(1)));
        for (const float ior : {1.0f, 1.2f, 1.5f, 3.0f}) {
            Bsdf glass = make_bsdf(Vec3(0.9f, 0.8f, 0.7f), 0, roughness, ior, 1, Vec3(1));
            glass.transmission = 1;
            glass.thin_walled = true;
            lobes.emplace_back("thin glass", glass);
            // Index 1 does not bend: the transmitted lobe is a delta however rough.
            if (ior == 1.0f) continue;
            glass.thin_walled = false;
            lobes.emplace_back("glass from outside", glass);
            glass = make_bsdf(Vec3(0.9f, 0.8f, 0.7f), 0, roughness, 1 / ior, 1, Vec3(1));
            glass.transmission = 1;
            glass.thin_walled = false;
            lobes.emplace_back("glass from inside", glass);
        }
        Bsdf cloth = make_bsdf(Vec3(0.3f), 0, 0.8f, 1.5f, 1, Vec3(1));
        cloth.sheen_color = Vec3(0.9f, 0.5f, 0.1f);
        cloth.sheen_alpha = sqr(roughness);
        lobes.emplace_back("sheen", cloth);
        Bsdf coated = make_bsdf(Vec3(0.3f), 0, 0.8f, 1.5f, 1, Vec3(1));
        coated.coat = 1;
        coated.coat_alpha = ggx_alpha(roughness);
        coated.coat_normal = glm::normalize(Vec3(0.2f, -0.1f, 1));
        lobes.emplace_back("coat", coated);
        Bsdf brushed = make_bsdf(Vec3(0.9f), 1, roughness, 1.5f, 1, Vec3(1));
        brushed.alpha = anisotropic_alpha(roughness, 0.9f);
        lobes.emplace_back("anisotropic metal", brushed);
    }
    Bsdf leaf = make_bsdf(Vec3(0.3f, 0.6f, 0.1f), 0, 0.5f, 1.5f, 1, Vec3(1));
    leaf.diffuse_transmission = 0.6f;
    lobes.emplace_back("diffuse transmission", leaf);

    double score_sum = 0;
    int compared = 0;
    for (const auto& [name, bsdf] : lobes) {
        for (const float cosine : {0.03f, 0.1f, 0.5f, 0.95f}) {
            const Vec3 wo = direction(cosine);
            const ChiSquared result = compare_samples_with_pdf(bsdf, wo, cells_for(bsdf, wo), random, 30000);
            EXPECT_NEAR(result.mass, result.drawn, 0.012) << name << " cosine " << cosine << " " << describe(bsdf);
            EXPECT_LT(result.score, 4.5) << name << " cosine " << cosine << " " << describe(bsdf);
            if (result.drawn > 0) {
                score_sum += result.score;
                ++compared;
            }
        }
    }
    // Together they must look like chance as well: scores are about normal.
    EXPECT_GT(compared, 250);
    EXPECT_LT(std::abs(score_sum / compared), 4 / std::sqrt(compared));
}

TEST(LayeredBsdf, SamplesFollowThePdfOfRandomStacks) {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        Bsdf bsdf = test::random_material(random, false);
        // Together with round lobes, thin ellipses are needles in any cells; alone they are tested above.
        bsdf.alpha.y = std::max(bsdf.alpha.y, 0.125f * bsdf.alpha.x);
        const Vec3 wo = direction(0.05f + 0.95f * random(), 6 * random());
        const ChiSquared result = compare_samples_with_pdf(bsdf, wo, cells_for(bsdf, wo), random, 30000);
        EXPECT_NEAR(result.mass, result.drawn, 0.012) << describe(bsdf);
        EXPECT_LT(result.score, 4.5) << describe(bsdf);
    }
}

TEST(LayeredBsdf, SampleAndEvalAgree) {
    Random random(3);
    for (int i = 0; i < 30000; ++i) {
        const Bsdf bsdf = test::random_material(random, false);
        const Vec3 wo = direction(std::max(random(), 1e-3f), 6 * random());
        const BsdfSample s = sample(bsdf, wo, random(), random.pair());
        if (!(s.pdf > 0.0f)) continue;
        ASSERT_TRUE(is_finite(s.weight)) << describe(bsdf);
        ASSERT_NEAR(glm::length(s.wi), 1.0f, 1e-4f) << describe(bsdf);
        ASSERT_GE(std::min({s.weight.x, s.weight.y, s.weight.z}), 0.0f) << describe(bsdf);
        if (s.is_delta) continue;
        const BsdfEval e = eval(bsdf, wo, s.wi);
        ASSERT_NEAR(e.pdf, s.pdf, 1e-3f * s.pdf) << describe(bsdf);
        ASSERT_LT(glm::length(e.value - s.weight * s.pdf), 2e-3f * (1e-6f + glm::length(e.value))) << describe(bsdf);
    }
}

// The density of directions is the inverse of the area that the sampling map spreads out: its Jacobian by finite
// differences, for single lobes.
TEST(LayeredBsdf, PdfIsTheInverseJacobianOfTheSamplingMap) {
    Random random(4);
    int checked = 0;
    for (int i = 0; i < 4000; ++i) {
        Bsdf bsdf = make_bsdf(Vec3(1), 1, 0.3f + 0.7f * random(), 1.5f, 1, Vec3(1));
        const bool glass = random.chance(0.6f);
        if (glass) {
            bsdf = make_bsdf(Vec3(1), 0, 0.3f + 0.7f * random(), random.chance(0.5f) ? 1.5f : 1 / 1.5f, 1, Vec3(1));
            bsdf.transmission = 1;
            bsdf.thin_walled = false;
        }
        const Vec3 wo = direction(0.2f + 0.8f * random());
        const Vec2 u = 0.1f + 0.8f * random.pair();
        const float u_lobe = random();
        constexpr float h = 2e-3f;
        const auto at = [&](float x, float y) { return sample(bsdf, wo, u_lobe, Vec2(x, y)); };
        const BsdfSample center = at(u.x, u.y);
        const BsdfSample s[4] = {at(u.x + h, u.y), at(u.x - h, u.y), at(u.x, u.y + h), at(u.x, u.y - h)};
        bool same_branch = center.pdf > 0.0f;
        for (const BsdfSample& neighbour : s)
            same_branch = same_branch && neighbour.pdf > 0.0f && (neighbour.wi.z > 0.0f) == (center.wi.z > 0.0f);
        // The map bends too much for differences of this width where directions graze the surface.
        if (!same_branch || std::abs(center.wi.z) < 0.15f) continue;
        const Vec3 du = (s[0].wi - s[1].wi) / (2 * h), dv = (s[2].wi - s[3].wi) / (2 * h);
        const float area = glm::length(glm::cross(du, dv));
        // The branch at a facet was taken with its own probability, which is no part of the map of u.
        float branch = 1;
        if (glass) {
            const Vec3 half =
                center.wi.z > 0.0f ? glm::normalize(wo + center.wi) : glm::normalize(wo + bsdf.eta * center.wi);
            const float fresnel = fresnel_dielectric(std::abs(glm::dot(wo, half)), bsdf.eta);
            branch = fresnel / (fresnel + (1 - fresnel));
            if (center.wi.z < 0.0f) branch = 1 - branch;
        }
        EXPECT_NEAR(center.pdf * area / branch, 1.0f, 0.05f) << describe(bsdf) << " z " << center.wi.z;
        ++checked;
    }
    EXPECT_GT(checked, 2000);
}

TEST(LayeredBsdf, SingleScatteringIsReciprocal) {
    // Scaling by albedos depends on wo alone and is not; each lobe below it is. Refraction carries the factor eta².
    Random random(5);
    for (int i = 0; i < 3000; ++i) {
        const float ior = 1.05f + random();
        const float roughness = 0.2f + 0.8f * random();
        Bsdf outside = make_bsdf(Vec3(1), 0, roughness, ior, 1, Vec3(1));
        outside.transmission = 1;
        outside.thin_walled = false;
        Bsdf inside = make_bsdf(Vec3(1), 0, roughness, 1 / ior, 1, Vec3(1));
        inside.transmission = 1;
        inside.thin_walled = false;
        const Vec3 a = direction(0.1f + 0.9f * random(), 6 * random());
        const Vec3 b = direction(0.1f + 0.9f * random(), 6 * random());
        const float there = eval_dielectric(outside, a, b).value.x / b.z;
        const float back = eval_dielectric(outside, b, a).value.x / a.z;
        const auto energy = [](const Bsdf& bsdf, const Vec3& w) {
            return interface_albedo(w.z, bsdf.alpha.x, bsdf.eta);
        };
        EXPECT_NEAR(there * energy(outside, a), back * energy(outside, b), 1e-4f * (1e-3f + there));
        // From a through to -b, and from -b, seen from inside with the frame turned over, back to a.
        const Vec3 below(b.x, b.y, -b.z), turned_b(b.x, -b.y, b.z), turned_a(a.x, -a.y, -a.z);
        const float in = eval_dielectric(outside, a, below).value.x / b.z * energy(outside, a);
        const float out = eval_dielectric(inside, turned_b, turned_a).value.x / a.z * energy(inside, turned_b);
        EXPECT_NEAR(in * sqr(ior), out, 1e-3f * (1e-3f + out));
    }
}

// Mean over samples of the energy that comes back; refracted radiance is freed of its factor 1/eta².
test::BatchMeans measured_albedo(const Bsdf& bsdf, const Vec3& wo, Random& random, int batches, int batch) {
    test::BatchMeans means;
    for (int k = 0; k < batches; ++k) {
        double sum = 0;
        for (int i = 0; i < batch; ++i) {
            const BsdfSample s = sample(bsdf, wo, random(), random.pair());
            // eval-based samples do not say which way they went; z does.
            const float eta = s.wi.z < 0.0f && !bsdf.thin_walled && s.eta != 1.0f ? s.eta : 1.0f;
            if (s.pdf > 0.0f) sum += static_cast<double>(s.weight.y * sqr(eta));
        }
        means.add(sum / batch);
    }
    return means;
}

TEST(LayeredBsdf, LosslessLobesReturnAllLight) {
    Random random(6);
    for (const float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f}) {
        for (const float ior : {1.0f, 1.2f, 1.5f, 2.0f, 3.0f}) {
            for (const bool inside : {false, true}) {
                for (const bool thin : {false, true}) {
                    for (const float cosine : {0.05f, 0.3f, 0.7f, 1.0f}) {
                        Bsdf glass = make_bsdf(Vec3(1), 0, roughness, inside ? 1 / ior : ior, 1, Vec3(1));
                        glass.transmission = 1;
                        glass.thin_walled = thin;
                        const test::BatchMeans means = measured_albedo(glass, direction(cosine), random, 16, 1024);
                        EXPECT_NEAR(means.mean(), 1.0, 4 * means.standard_error() + 1e-2)
                            << describe(glass) << " cosine " << cosine;
                    }
                }
            }
        }
    }
}

TEST(LayeredBsdf, WhiteFurnaceOfRandomStacks) {
    Random random(7);
    double worst = 0;
    for (int i = 0; i < 300; ++i) {
        const Bsdf white = test::random_material(random, true);
        const Vec3 wo = direction(0.05f + 0.95f * random(), 6 * random());
        const test::BatchMeans means = measured_albedo(white, wo, random, 16, 1024);
        EXPECT_LT(means.mean(), 1.0 + 4 * means.standard_error() + 1e-2) << describe(white);
        EXPECT_GT(means.mean(), 1.0 - 4 * means.standard_error() - 3e-2) << describe(white);
        worst = std::max(worst, std::abs(means.mean() - 1.0) - 4 * means.standard_error());
    }
    RecordProperty("worst_deviation_beyond_noise", std::to_string(worst));
}

TEST(LayeredBsdf, ColouredStacksNeverGainLight) {
    Random random(8);
    for (int i = 0; i < 300; ++i) {
        const Bsdf bsdf = test::random_material(random, false);
        const Vec3 wo = direction(0.05f + 0.95f * random(), 6 * random());
        const test::BatchMeans means = measured_albedo(bsdf, wo, random, 8, 512);
        EXPECT_LT(means.mean(), 1.0 + 4 * means.standard_error() + 1e-2) << describe(bsdf);
        const double stated = static_cast<double>(albedo(bsdf, wo).y);
        EXPECT_LE(stated, 1.0 + 1e-4) << describe(bsdf);
    }
}

TEST(Fresnel, KnownReflectances) {
    EXPECT_NEAR(fresnel_dielectric(1, 1.5f), 0.04f, 1e-6f);
    EXPECT_NEAR(fresnel_dielectric(1, 1 / 1.5f), 0.04f, 1e-6f);
    EXPECT_NEAR(fresnel_dielectric(0, 1.5f), 1, 1e-6f);
    EXPECT_EQ(fresnel_dielectric(0.5f, 1 / 1.5f), 1);  // 60° is beyond the critical angle of 41.8°
    // At Brewster's angle only the s-polarised half is reflected: ((n² − 1)/(n² + 1))² / 2.
    const float brewster = std::cos(std::atan(1.5f));
    EXPECT_NEAR(fresnel_dielectric(brewster, 1.5f), 0.5f * sqr(1.25f / 3.25f), 1e-6f);
}

TEST(Sheen, AlbedoIsTheIntegral) {
    Random random(9);
    for (const float alpha : {0.02f, 0.1f, 0.4f, 1.0f}) {
        for (const float cosine : {0.05f, 0.2f, 0.6f, 1.0f}) {
            test::BatchMeans means;
            for (int batch = 0; batch < 16; ++batch) {
                double sum = 0;
                for (int i = 0; i < 4096; ++i)
                    sum += static_cast<double>(eval_sheen(direction(cosine), sample_sheen(random.pair()), alpha) /
                                               sheen_pdf());
                means.add(sum / 4096);
            }
            EXPECT_NEAR(means.mean(), static_cast<double>(sheen_albedo(cosine, alpha)),
                        4 * means.standard_error() + 1e-2)
                << alpha << " " << cosine;
            EXPECT_LE(sheen_albedo(cosine, alpha), 1.0f);
        }
    }
}

TEST(ThinFilm, VanishesWithItsThicknessAndStaysPhysical) {
    for (const float cosine : {0.1f, 0.5f, 1.0f}) {
        const Vec3 none = thin_film_reflectance(1, 1.3f, cosine, 0, Vec3(0.04f));
        const float bare = lerp(0.04f, 1.0f, schlick_weight(cosine));
        EXPECT_NEAR(none.y, bare, 0.02f) << cosine;
        for (int thickness = 0; thickness <= 1200; thickness += 50) {
            const Vec3 f =
                thin_film_reflectance(1, 1.3f, cosine, static_cast<float>(thickness), Vec3(0.04f, 0.5f, 0.9f));
            EXPECT_GE(std::min({f.x, f.y, f.z}), 0.0f);
            EXPECT_LE(max_component(f), 1.0f);
        }
    }
    // A quarter-wave film of the square root of the base's index reflects nothing at its wavelength: MgF2-like 1.225 on
    // glass 1.5, green 550 nm → 112 nm.
    const Vec3 coated = thin_film_reflectance(1, 1.2247f, 1, 112.3f, Vec3(0.04f));
    EXPECT_LT(coated.y, 0.01f);
}

}  // namespace
}  // namespace candela
