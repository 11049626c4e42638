// SPDX-License-Identifier: MIT
#include "renderer/session/schedule.h"

#include <utility>

namespace candela {

namespace {

// Pixels along a tile's side.
uint32_t tile_step(uint32_t stride) {
    return (stride > 8 ? coarse_tile_side : tile_side) * stride;
}

uint32_t tiles_along(uint32_t size, uint32_t stride) {
    const uint32_t step = tile_step(stride);
    return (size + step - 1) / step;
}

}  // namespace

uint32_t tile_count(const Pass& pass, Vec2u extent) {
    return tiles_along(extent.x, pass.stride) * tiles_along(extent.y, pass.stride);
}

void list_tile(const Pass& pass, Vec2u extent, uint32_t tile, PathSharing sharing, std::vector<PixelSample>& out) {
    out.clear();
    const uint32_t across = tiles_along(extent.x, pass.stride);
    const uint32_t step = tile_step(pass.stride);
    const uint32_t left = tile % across * step, top = tile / across * step;
    const uint32_t right = std::min(left + step, extent.x), bottom = std::min(top + step, extent.y);
    for (uint32_t y = top; y < bottom; y += pass.stride) {
        for (uint32_t x = left; x < right; x += pass.stride) {
            if (pass.done_stride != 0 && x % pass.done_stride == 0 && y % pass.done_stride == 0) continue;
            out.push_back({static_cast<uint16_t>(x), static_cast<uint16_t>(y), pass.sample_index, sharing});
        }
    }
}

Schedule::Schedule(Vec2u extent, uint32_t first_stride, bool reuses) : extent_(extent), resolved_stride_(first_stride) {
    if (reuses) reuse_plan_ = ReusePlan(extent);
    pass_.stride = first_stride;
}

void Schedule::give_back(const Slice& slice, std::vector<uint32_t> tiles) {
    rest_ = slice;
    rest_.tiles = std::move(tiles);
}

Slice Schedule::next(uint32_t tiles) {
    if (!rest_.tiles.empty()) return std::exchange(rest_, {});
    const uint32_t count = tile_count(pass_, extent_);
    Slice slice{pass_, tile_, count};
    // The first samples of all pixels have shown where later ones share their paths.
    if (pass_.sample_index == ReusePlan::first_planned && tile_ == 0) reuse_plan_.decide();
    if (first_pass_done_) slice.end_tile = std::min(count, tile_ + std::max(tiles, 1u));
    tile_ = slice.end_tile;
    if (tile_ < count) return slice;

    // The pass is given out: the next one halves the stride, or takes the next sample.
    tile_ = 0;
    first_pass_done_ = true;
    resolved_stride_ = pass_.stride;
    if (pass_.stride > 1) {
        pass_.done_stride = pass_.stride;
        pass_.stride /= 2;
    } else {
        pass_.done_stride = 0;
        ++pass_.sample_index;
        complete_ = pass_.sample_index;
    }
    return slice;
}

void Schedule::list(const Slice& slice, uint32_t tile, std::vector<PixelSample>& out) const {
    list_tile(slice.pass, extent_, tile, reuse_plan_.sharing(slice.pass.sample_index, tile), out);
}

void Schedule::note(uint32_t tile, std::span<const PixelSample> samples, std::span<const RadianceSample> traced) {
    reuse_plan_.note(tile, samples, traced);
}

uint32_t choose_first_stride(Vec2u extent, double seconds_per_path, double target_seconds) {
    if (!(seconds_per_path > 0)) return 8;
    uint32_t stride = 1;
    const auto points = [&] {
        const Vec2u along = (extent + stride - 1u) / stride;
        return along.x * along.y;
    };
    while (stride < coarsest_stride && points() * seconds_per_path > target_seconds)
        stride *= 2;
    return stride;
}

}  // namespace candela
