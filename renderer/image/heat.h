// SPDX-License-Identifier: MIT
// Colours for numbers: from black over red to pale yellow, ever lighter, so that order is seen also in grey.
#pragma once

#include "renderer/math/math.h"

namespace candela {

// Display values (not linear light) for t in [0, 1]; beyond, the nearest of them. Matplotlib's "inferno", as the
// polynomial of Matt Zucker (public domain, shadertoy.com/view/WlfXRN).
Vec3 heat_color(float t);

// For differences: blue below 0 over dark grey at 0 to orange above, for t in [-1, 1]; beyond, the nearest of them.
Vec3 difference_color(float t);

// Which numbers the colours run over.
struct HeatScale {
    float low = 0, high = 1;
    bool logarithmic = false;  // low > 0 then

    float position(float value) const;  // 0 at low, 1 at high
};

}  // namespace candela
