// SPDX-License-Identifier: MIT
// Where sharing paths pays: inside it may quarter the noise, under an open sky it adds some, for each path's own
// directions are better chosen there. It is tried: two samples of each pixel are made alone, two in groups, and
// the difference of each two in what can be shared, times what they cost, decides for the tile, before the samples that
// it is for are traced. Light that is not shared does not count: most of its noise goes as samples fill their
// strata.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/integrator/integrator.h"

namespace candela {

class ReusePlan {
  public:
    // The first index that is not a trial.
    static constexpr uint32_t first_planned = 4;

    ReusePlan() = default;
    explicit ReusePlan(Vec2u extent);

    // How the samples of that index share their paths in a tile of reuse_tile² pixels, counted row by row.
    PathSharing sharing(uint32_t index, uint32_t tile) const;
    // What samples of one index were: of a whole tile, or, of sample 0, of any pixels. For different pixels from any
    // threads.
    void note(uint32_t tile, std::span<const PixelSample> samples, std::span<const RadianceSample> traced);
    // To be called once, when all tiles have noted the samples before first_planned; the notes are dropped.
    void decide();

  private:
    struct Trial {
        double noise = 0, cost = 0;
    };
    Vec2u extent_{0}, tiles_{0};
    std::vector<float> before_;                 // of each pixel's last sample, what can be shared
    std::array<std::vector<Trial>, 2> trials_;  // of each tile: alone, in groups
    std::vector<uint8_t> shares_;
};

}  // namespace candela
