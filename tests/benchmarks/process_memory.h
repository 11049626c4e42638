// SPDX-License-Identifier: MIT
// How much memory the process holds and has held, as Linux counts it.
#pragma once

namespace candela::bench {

double resident_bytes();
// The most since the start, or since forget_peak.
double peak_bytes();
void forget_peak();

}  // namespace candela::bench
