// SPDX-License-Identifier: MIT
// Wavelengths are drawn by their pdf, and together they are white.
#include "renderer/sampling/wavelength.h"

#include "tests/support/chi_squared.h"

namespace candela {
namespace {

TEST(Wavelength, ResponsesIntegrateToWhiteAndPdfToOne) {
    glm::dvec3 white(0);
    double total = 0;
    for (double nm = 380.05; nm < 780; nm += 0.1) {
        white += glm::dvec3(wavelength_response(static_cast<float>(nm))) * 0.1;
        total += static_cast<double>(wavelength_pdf(static_cast<float>(nm))) * 0.1;
    }
    EXPECT_NEAR(total, 1, 1e-3);
    EXPECT_NEAR(white.x, 1, 1e-3);
    EXPECT_NEAR(white.y, 1, 1e-3);
    EXPECT_NEAR(white.z, 1, 1e-3);
}

TEST(Wavelength, SamplesFollowThePdfAndCarryTheirWeight) {
    constexpr int count = 200000, cells = 80;
    std::vector<double> counts(cells, 0), expected(cells, 0);
    glm::dvec3 mean(0);
    for (int i = 0; i < count; ++i) {
        const WavelengthSample s = sample_wavelength((static_cast<float>(i) + 0.5f) / count);
        ASSERT_GE(s.wavelength_nm, 380.0f);
        ASSERT_LE(s.wavelength_nm, 780.0f);
        counts[static_cast<size_t>(std::min((s.wavelength_nm - 380) / 5, cells - 1.0f))] += 1;
        mean += glm::dvec3(s.weight) / static_cast<double>(count);
    }
    for (int c = 0; c < cells * 50; ++c) {
        const float nm = 380 + (static_cast<float>(c) + 0.5f) * 0.1f;
        expected[static_cast<size_t>(c / 50)] += static_cast<double>(wavelength_pdf(nm)) * 0.1 * count;
    }
    EXPECT_LT(test::chi_squared_score(counts, expected), 4);
    EXPECT_NEAR(mean.x, 1, 2e-3);
    EXPECT_NEAR(mean.y, 1, 2e-3);
    EXPECT_NEAR(mean.z, 1, 2e-3);
}

TEST(Wavelength, DispersionFollowsTheAbbeNumber) {
    // V = (n_d − 1) / (n_F − n_C), with the d, F and C lines of helium and hydrogen.
    const float dispersion = 20.0f / 36.0f;
    const float d = dispersed_ior(1.6f, dispersion, 587.6f);
    const float f = dispersed_ior(1.6f, dispersion, 486.1f), c = dispersed_ior(1.6f, dispersion, 656.3f);
    EXPECT_NEAR(d, 1.6f, 1e-4f);
    EXPECT_NEAR((d - 1) / (f - c), 36.0f, 0.1f);
}

}  // namespace
}  // namespace candela
