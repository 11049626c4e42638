// SPDX-License-Identifier: MIT
#include "tests/support/measure.h"

#include <gtest/gtest.h>

#include "renderer/integrator/path_reuse.h"

namespace candela::test {

View look_at_point(const Vec3& eye, const Vec3& target, const Vec3& up) {
    View view;
    view.camera.world_from_camera = look_at(eye, target, up);
    view.camera.projection = Projection::orthographic;
    view.camera.ortho_half_height_m = 1e-5f;
    return view;
}

std::string describe(const Technique& t) {
    const char* estimators[] = {"mis", "light", "bsdf"};
    return std::string(estimators[static_cast<int>(t.estimator)]) +
           (t.sampler == SamplerKind::sobol ? ", sobol" : ", independent") + (t.batched ? ", batched" : ", scalar") +
           (t.shares_paths ? ", shared paths" : "");
}

BatchMeans measure(const World& world, const View& view, const Technique& technique, uint32_t batches,
                   uint32_t samples_per_batch) {
    BatchMeans means;
    RayCounts counts;
    std::vector<PixelSample> samples(max_batch);
    std::vector<RadianceSample> radiance(max_batch);
    View split = view;
    if (technique.shares_paths) split.extent = Vec2u(reuse_tile);
    for (uint32_t b = 0; b < batches; ++b) {
        IntegratorSettings settings;
        settings.estimator = technique.estimator;
        settings.sampler = technique.sampler;
        settings.filter = PixelFilter::box;
        settings.seed = b;
        double sum = 0;
        for (uint32_t first = 0; first < samples_per_batch; first += max_batch) {
            for (uint32_t i = 0; i < max_batch; ++i) {
                samples[i] = {0, 0, first + i};
                if (technique.shares_paths) {
                    samples[i] = {static_cast<uint16_t>(i % reuse_tile), static_cast<uint16_t>(i / reuse_tile),
                                  first / static_cast<uint32_t>(max_batch), PathSharing::group};
                }
            }
            if (technique.batched) {
                trace_batch(world, split, settings, samples, radiance, counts);
            } else {
                trace_samples(world, split, settings, samples, radiance, counts);
            }
            for (const RadianceSample& r : radiance) {
                EXPECT_TRUE(is_finite(r.radiance));
                sum += static_cast<double>(luminance(r.radiance));
            }
        }
        means.add(sum / samples_per_batch);
    }
    return means;
}

void expect_exact(const BatchMeans& means, double exact, double largest_relative_error, const std::string& what) {
    EXPECT_LE(std::abs(means.mean() - exact), 4.0 * means.standard_error() + 2e-6 * exact)
        << what << ": estimate " << means.mean() << " exact " << exact << " standard error " << means.standard_error();
    EXPECT_LE(means.standard_error(), largest_relative_error * exact) << what;
}

const std::vector<Technique> all_techniques = {
    {Estimator::mis, SamplerKind::sobol, true},  {Estimator::light, SamplerKind::sobol, true},
    {Estimator::bsdf, SamplerKind::sobol, true}, {Estimator::mis, SamplerKind::independent, true},
    {Estimator::mis, SamplerKind::sobol, false}, {Estimator::mis, SamplerKind::sobol, true, true}};

}  // namespace candela::test
