// SPDX-License-Identifier: MIT
// What to trace next: pure logic, without threads or clocks. Sample 0 comes in lattices of halving stride, each leaving
// out the points of the one before, so that a coarse picture appears early and nothing is traced twice; then whole
// passes follow.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/integrator/integrator.h"

namespace candela {

// One sample for the pixels of a lattice. Tiles hold at most max_batch lattice points.
struct Pass {
    uint32_t sample_index = 0;
    uint32_t stride = 1;       // pixels whose coordinates are multiples of this
    uint32_t done_stride = 0;  // except multiples of this, which an earlier pass had; 0: none had
};

inline constexpr uint32_t tile_side = 16;  // lattice points
static_assert(tile_side * tile_side <= max_batch);

uint32_t tile_count(const Pass& pass, Vec2u extent);
// The pixels of tile number `tile`, row by row; appended to out, which is cleared first.
void list_tile(const Pass& pass, Vec2u extent, uint32_t tile, std::vector<PixelSample>& out);

// A part of a pass that workers share out among themselves; between slices they are parked.
struct Slice {
    Pass pass;
    uint32_t first_tile = 0;
    uint32_t end_tile = 0;
};

// Walks through one epoch.
class Schedule {
  public:
    // first_stride: 8 or 16.
    Schedule(Vec2u extent, uint32_t first_stride);

    // The next slice of about that many tiles (at least one), never beyond its pass. The first pass comes whole:
    // nothing is shown before it.
    Slice next(uint32_t tiles);
    // Passes of one sample for every pixel that are complete: the spp.
    uint32_t complete_samples() const { return complete_; }
    bool first_pass_done() const { return first_pass_done_; }
    uint32_t current_stride() const { return pass_.sample_index > 0 ? 1u : resolved_stride_; }

  private:
    Vec2u extent_;
    Pass pass_;
    uint32_t tile_ = 0;
    uint32_t complete_ = 0;
    uint32_t resolved_stride_;
    bool first_pass_done_ = false;
};

// The coarsest stride that promises a first picture in time: 8, or 16 where a path is expected to take so long that the
// pass of stride 8 would exceed target_seconds. seconds_per_path of all workers together; 0: unknown.
uint32_t choose_first_stride(Vec2u extent, double seconds_per_path, double target_seconds);

}  // namespace candela
