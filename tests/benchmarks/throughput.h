// SPDX-License-Identifier: MIT
// What a path costs, and what it would cost if it were traced alone.
#pragma once

#include "renderer/integrator/integrator.h"

namespace candela::bench {

// Of this thread.
double cpu_seconds();

// Paths per CPU second that the accelerator alone traces: cosine-distributed bounces off every surface, at each a ray
// to a point of some lamp (straight up where there is none), and no shading at all. The median of five pictures.
double limit_paths_per_s(const World& world, const View& view, uint32_t max_depth);

}  // namespace candela::bench
