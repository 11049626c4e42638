// SPDX-License-Identifier: MIT
// One pixel measured by any technique, with its standard error.
#pragma once

#include <string>
#include <vector>

#include "renderer/integrator/integrator.h"
#include "tests/support/batch_means.h"

namespace candela::test {

// A view of one pixel that sees one point.
View look_at_point(const Vec3& eye, const Vec3& target, const Vec3& up);

struct Technique {
    Estimator estimator = Estimator::mis;
    SamplerKind sampler = SamplerKind::sobol;
    bool batched = true;
    bool shares_paths = false;  // between pixels that all see the one point
};
extern const std::vector<Technique> all_techniques;
std::string describe(const Technique& t);

// Luminance of the pixel: one batch per seed, so that batches are independent whatever the sampler.
BatchMeans measure(const World& world, const View& view, const Technique& technique, uint32_t batches,
                   uint32_t samples_per_batch);

// Within four standard errors, which must be small enough to mean something.
void expect_exact(const BatchMeans& means, double exact, double largest_relative_error, const std::string& what);

}  // namespace candela::test
