// SPDX-License-Identifier: MIT
// The firefly's ledger as words and figures: what a table of it shows, row by row.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "renderer/integrator/ledger.h"

namespace candela {

// "object 3" and the like where the file gives no name; "" of no instance.
std::string object_name(const Scene& scene, uint32_t instance);
std::string material_name(const Scene& scene, uint32_t material);

// First the surface that the path met, then each light that was found there.
struct LedgerRow {
    bool is_light = false;
    bool brings_nothing = false;       // a light that adds nothing to the sample
    std::string number;                // of a surface
    std::string what;                  // object and material; the light
    std::string how;                   // lobe; technique
    std::string pdf, other_pdf;        // of the direction as it was drawn, and as the other technique draws it; per sr
    std::string share;                 // the weight between the two
    std::array<std::string, 3> color;  // what the path carries on; what the light brings
    std::string note;                  // roulette, and why it ended; whether the light is hidden
};

std::vector<LedgerRow> rows_of(const World& world, const Ledger& ledger);

// Four digits that stand under each other, "0.318", "12.30"; what is far from 1 with a power of ten.
std::string figure_text(float value);

}  // namespace candela
