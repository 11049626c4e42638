// SPDX-License-Identifier: MIT
// Tiles of pixels that may share their paths, and a view of the rooms that the tests of it look into.
#pragma once

#include <vector>

#include "renderer/integrator/path_reuse.h"

namespace candela::test {

inline View room_view(uint32_t side) {
    View view;
    view.camera.world_from_camera = look_at(Vec3(0, 1.8f, 5), Vec3(0, 1.6f, 0), Vec3(0, 1, 0));
    view.extent = Vec2u(side);
    return view;
}

// All pixels of a tile, one sample of each.
inline std::vector<PixelSample> tile_at(uint32_t left, uint32_t top, uint32_t index, PathSharing sharing) {
    std::vector<PixelSample> out;
    for (uint32_t y = 0; y < reuse_tile; ++y) {
        for (uint32_t x = 0; x < reuse_tile; ++x)
            out.push_back({static_cast<uint16_t>(left + x), static_cast<uint16_t>(top + y), index, sharing});
    }
    return out;
}

}  // namespace candela::test
