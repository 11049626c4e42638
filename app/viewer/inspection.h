// SPDX-License-Identifier: MIT
// One pixel under the glass: what it shows, and the path of its brightest sample.
#pragma once

#include "app/viewer/background_task.h"
#include "app/viewer/ledger_text.h"
#include "renderer/integrator/aov.h"

namespace candela {

struct PixelLedger {
    Ledger path;
    std::vector<LedgerRow> rows;
    uint32_t samples = 0;  // among which it is the brightest
};

struct Inspection {
    Vec2u pixel{0};
    View view;     // in which it was clicked at
    FirstHit hit;  // through its centre
    // Of the frame that is shown.
    Vec4 value{0};
    float error = -1;  // relative; negative: unknown
    float samples = 0, rays = 0;
    std::optional<PixelLedger> ledger;  // none: still searched for
};

}  // namespace candela
