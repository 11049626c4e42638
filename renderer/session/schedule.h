// SPDX-License-Identifier: MIT
// What to trace next: pure logic, without threads or clocks. Sample 0 comes in lattices of halving stride, each leaving
// out the points of the one before, so that a coarse picture appears early and nothing is traced twice; then whole
// passes follow.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/integrator/path_reuse.h"
#include "renderer/session/reuse_plan.h"

namespace candela {

// One sample for the pixels of a lattice. Tiles hold at most max_batch lattice points.
struct Pass {
    uint32_t sample_index = 0;
    uint32_t stride = 1;       // pixels whose coordinates are multiples of this
    uint32_t done_stride = 0;  // except multiples of this, which an earlier pass had; 0: none had
};

// Of a coarse lattice they hold less, so that all workers have some of them.
inline constexpr uint32_t tile_side = 16, coarse_tile_side = 8;  // lattice points
static_assert(tile_side * tile_side <= max_batch && tile_side == reuse_tile);
inline constexpr uint32_t coarsest_stride = 64;

uint32_t tile_count(const Pass& pass, Vec2u extent);
// The pixels of tile number `tile`, row by row, in out.
void list_tile(const Pass& pass, Vec2u extent, uint32_t tile, PathSharing sharing, std::vector<PixelSample>& out);

// A part of a pass that workers share out among themselves; between slices they are parked.
struct Slice {
    Pass pass;
    uint32_t first_tile = 0;
    uint32_t end_tile = 0;
    std::vector<uint32_t> tiles = {};  // unless empty: these in place of the range

    uint32_t size() const { return tiles.empty() ? end_tile - first_tile : static_cast<uint32_t>(tiles.size()); }
    uint32_t tile(uint32_t i) const { return tiles.empty() ? first_tile + i : tiles[i]; }
};

// Walks through one epoch.
class Schedule {
  public:
    // first_stride: a power of two up to coarsest_stride. reuses: paths may be shared.
    Schedule(Vec2u extent, uint32_t first_stride, bool reuses);

    // The next slice of about that many tiles (at least one), never beyond its pass. The first pass comes whole:
    // nothing is shown before it.
    Slice next(uint32_t tiles);
    // Of the slice that was given out last, these tiles were left undone: they come next.
    void give_back(const Slice& slice, std::vector<uint32_t> tiles);
    // The samples of a tile of a slice.
    void list(const Slice& slice, uint32_t tile, std::vector<PixelSample>& out) const;
    // To be told what a tile's samples were, before the slice after it is asked for. For different tiles from any
    // threads.
    void note(uint32_t tile, std::span<const PixelSample> samples, std::span<const RadianceSample> traced);
    // Passes of one sample for every pixel that are complete: the spp.
    uint32_t complete_samples() const {
        return rest_.tiles.empty() ? complete_ : std::min(complete_, rest_.pass.sample_index);
    }
    bool first_pass_done() const { return first_pass_done_; }
    uint32_t current_stride() const { return pass_.sample_index > 0 ? 1u : resolved_stride_; }

  private:
    Vec2u extent_;
    Pass pass_;
    Slice rest_;  // given back; nothing where it has no tiles
    uint32_t tile_ = 0;
    uint32_t complete_ = 0;
    uint32_t resolved_stride_;
    bool first_pass_done_ = false;
    ReusePlan reuse_plan_;
};

// The finest stride whose lattice is traced within target_seconds. seconds_per_path of all workers together; 0:
// unknown, and 8 is taken.
uint32_t choose_first_stride(Vec2u extent, double seconds_per_path, double target_seconds);

}  // namespace candela
