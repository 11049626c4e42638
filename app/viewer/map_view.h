// SPDX-License-Identifier: MIT
// The error view: one of the frame's maps beside the picture, from the wipe to the right edge.
#pragma once

#include "app/gl/display.h"

namespace candela {

struct MapView {
    bool shown = false;
    PixelMap map = PixelMap::error;
    float wipe = 0.5f;  // 0: all map; 1: all picture
};

// "error of each pixel"
const char* title_of(PixelMap map);
// Which numbers its colours run over: errors from 0.1 % to 100 %, others from 0 to a round number above nearly all.
HeatScale scale_of(PixelMap map, const ImageRgba32f& maps);

}  // namespace candela
