// SPDX-License-Identifier: MIT
// A picture with less noise, and with errors that nothing states: for a look at what it will be, never the truth.
//
// Non-local means with the variance that two replicates tell (Rousselle, Knaus and Zwicker 2012, "Adaptive Rendering
// with Non-Local Means Filtering"), joined with noise-free features (Rousselle, Manzi and Zwicker 2013, "Robust
// Denoising using Feature and Color Information"), over colours that are divided by the albedo.
#pragma once

#include <atomic>

#include "renderer/denoise/guides.h"
#include "renderer/film/film.h"

namespace candela {

// Linear radiance premultiplied by alpha, of the film's extent; the same to the bit for any number of threads. Runs on
// TBB's. guides: of the film's extent, of at least one pass. Empty once *cancel (may be null) is set.
ImageRgba32f denoise(const Film& film, const Guides& guides, const std::atomic<bool>* cancel = nullptr);

}  // namespace candela
