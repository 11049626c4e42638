// SPDX-License-Identifier: MIT
// What the other side of a comparison does differently.
#pragma once

#include <string>
#include <vector>

#include "renderer/integrator/settings.h"

namespace candela {

struct ComparedSettings {
    Estimator estimator = Estimator::bsdf;
    SamplerKind sampler = SamplerKind::sobol;
    uint32_t max_depth = 0;

    // The settings with these in their place.
    IntegratorSettings in(IntegratorSettings settings) const;
    bool operator==(const ComparedSettings&) const = default;
};

// What a comparison begins with: the other technique where one alone is in use, else directions alone.
ComparedSettings opposite_of(const IntegratorSettings& settings);
// The settings with each of the words in their place: mis, light, bsdf, sobol, independent, depth=N. Returns the first
// word that is none of them in *unknown.
ComparedSettings compared_settings(const IntegratorSettings& settings, const std::vector<std::string>& words,
                                   std::string* unknown);

// "light points, depth 1": how one differs from the other; of the estimator where they do not differ.
std::string words_of(const IntegratorSettings& settings, const IntegratorSettings& other);

}  // namespace candela
