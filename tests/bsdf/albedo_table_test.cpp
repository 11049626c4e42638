// SPDX-License-Identifier: MIT
// The table that the build fills against the integrals that it is filled with, at its nodes.
#include "renderer/bsdf/albedo_integral.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

void expect_near(const SpecularAlbedo& a, const SpecularAlbedo& b, int roughness) {
    EXPECT_NEAR(a.scale, b.scale, 2e-5f) << roughness;
    EXPECT_NEAR(a.bias, b.bias, 2e-5f) << roughness;
}

TEST(AlbedoTable, HoldsWhatIsIntegrated) {
    const AlbedoTables expected = AlbedoTables::integrated();
    constexpr int last = AlbedoTables::size - 1;
    for (int j = 0; j <= last; ++j) {
        const float alpha = sqr(static_cast<float>(j) / last);
        for (int i = 0; i <= last; ++i) {
            const float cosine = sqr(static_cast<float>(i) / last);
            expect_near(specular_albedo(cosine, alpha), expected.albedo[static_cast<size_t>(j)][static_cast<size_t>(i)],
                        j);
        }
        const MeanSpecularAlbedo mean = mean_specular_albedo(alpha);
        expect_near(mean.single, expected.mean[static_cast<size_t>(j)].single, j);
        expect_near(mean.compensated, expected.mean[static_cast<size_t>(j)].compensated, j);
    }
}

}  // namespace
}  // namespace candela
