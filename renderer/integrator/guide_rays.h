// SPDX-License-Identifier: MIT
// Guides of a denoiser: the first surfaces that the samples of a picture meet.
#pragma once

#include "renderer/denoise/guides.h"
#include "renderer/integrator/integrator.h"

namespace candela {

// Adds samples guides.passes … passes - 1 of each pixel, those that the picture itself is made of. Runs on TBB's
// threads. False, with the guides unusable, once *cancel (may be null) is set.
bool add_guides(const World& world, const View& view, const IntegratorSettings& settings, uint32_t passes,
                Guides& guides, const std::atomic<bool>* cancel = nullptr);

}  // namespace candela
