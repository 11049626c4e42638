// SPDX-License-Identifier: MIT
// Weights of multiple importance sampling.
#pragma once

namespace candela {

// Power heuristic with exponent 2 for one sample of each of two techniques: the weight of the technique whose pdf is
// pdf_a (Veach 1997, equation 9.13). Both pdfs share one measure. Works for infinite pdf_a; 0 when pdf_a is 0.
inline float mis_weight(float pdf_a, float pdf_b) {
    if (!(pdf_a > 0.0f)) return 0.0f;
    const float ratio = pdf_b / pdf_a;
    return 1.0f / (1.0f + ratio * ratio);
}

}  // namespace candela
