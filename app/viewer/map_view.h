// SPDX-License-Identifier: MIT
// The error view: one of the frame's maps beside the picture, from the wipe to the right edge.
#pragma once

#include "app/gl/display.h"

namespace candela {

struct MapView {
    bool shown = false;
    PixelMap map = PixelMap::error;
    float wipe = 0.5f;  // 0: all map; 1: all picture
    // In place of the map: how far the picture is from the reference.
    std::optional<ReferenceMetric> metric = std::nullopt;
};

// "error of each pixel"
const char* title_of(PixelMap map);
// "difference from the reference"
const char* title_of(const MapView& view);
// Which numbers its colours run over: errors from 0.1 % to 100 %, others from 0 to a round number above nearly all.
HeatScale scale_of(PixelMap map, const ImageRgba32f& maps);
HeatScale scale_of(ReferenceMetric metric);

}  // namespace candela
