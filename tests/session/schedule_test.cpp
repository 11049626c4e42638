// SPDX-License-Identifier: MIT
#include <map>

#include "renderer/session/schedule.h"
#include "renderer/session/triple_buffer.h"

namespace candela {
namespace {

TEST(Schedule, LatticesCoverEveryPixelOnceThenPassesFollow) {
    for (const Vec2u extent : {Vec2u(1, 1), Vec2u(7, 130), Vec2u(257, 33), Vec2u(64, 64)}) {
        for (const uint32_t first_stride : {1u, 8u, 16u, 64u}) {
            Schedule schedule(extent, first_stride, false);
            std::vector<PixelSample> samples;
            std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> seen;
            while (schedule.complete_samples() < 3) {
                const Slice slice = schedule.next(3);
                ASSERT_LT(slice.first_tile, slice.end_tile);
                for (uint32_t tile = slice.first_tile; tile < slice.end_tile; ++tile) {
                    schedule.list(slice, tile, samples);
                    ASSERT_LE(samples.size(), max_batch);
                    for (const PixelSample& s : samples)
                        seen[{s.x, s.y}].push_back(s.index);
                }
            }
            ASSERT_EQ(seen.size(), size_t{extent.x} * extent.y);
            for (const auto& [pixel, indices] : seen)
                ASSERT_EQ(indices, (std::vector<uint32_t>{0, 1, 2}));
        }
    }
}

TEST(Schedule, TheFirstPassComesWholeAndIsCoarse) {
    Schedule schedule({1280, 720}, 8, false);
    const Slice slice = schedule.next(1);
    EXPECT_EQ(slice.first_tile, 0u);
    EXPECT_EQ(slice.end_tile, tile_count(slice.pass, {1280, 720}));
    EXPECT_EQ(slice.pass.stride, 8u);
    EXPECT_TRUE(schedule.first_pass_done());
    EXPECT_EQ(schedule.next(1).end_tile, 1u);
}

TEST(Schedule, WhatIsGivenBackComesNext) {
    const Vec2u extent(130, 70);
    Schedule schedule(extent, 2, false);
    schedule.next(1000);
    Slice slice = schedule.next(1000);
    EXPECT_EQ(slice.pass.stride, 1u);
    EXPECT_EQ(schedule.complete_samples(), 1u);
    schedule.give_back(slice, {3, 5});
    EXPECT_EQ(schedule.complete_samples(), 0u) << "some pixels have no sample";
    const Slice rest = schedule.next(1000);
    EXPECT_EQ(rest.pass.stride, 1u);
    ASSERT_EQ(rest.size(), 2u);
    EXPECT_EQ(rest.tile(0), 3u);
    EXPECT_EQ(rest.tile(1), 5u);
    EXPECT_EQ(schedule.complete_samples(), 1u);
    EXPECT_EQ(schedule.next(1000).pass.sample_index, 1u);
}

TEST(Schedule, TheFirstLatticeIsAsFineAsTimeAllows) {
    EXPECT_EQ(choose_first_stride({1280, 720}, 0, 0.012), 8u) << "nothing is known yet";
    EXPECT_EQ(choose_first_stride({1280, 720}, 1e-9, 0.012), 1u);
    EXPECT_EQ(choose_first_stride({512, 512}, 0.7e-6, 0.012), 4u);
    EXPECT_EQ(choose_first_stride({1280, 720}, 1e-6, 0.012), 16u);
    EXPECT_EQ(choose_first_stride({1280, 720}, 3e-6, 0.012), 16u);
    EXPECT_EQ(choose_first_stride({1280, 720}, 3e-6, 0.01), 32u);
    EXPECT_EQ(choose_first_stride({1280, 720}, 1, 0.012), coarsest_stride);
}

TEST(TripleBuffer, ReaderGetsTheNewestAndKeepsIt) {
    TripleBuffer<int> buffer;
    EXPECT_EQ(buffer.latest(), nullptr);
    for (int i = 1; i <= 3; ++i) {
        buffer.back() = i;
        buffer.publish();
    }
    ASSERT_NE(buffer.latest(), nullptr);
    EXPECT_EQ(*buffer.latest(), 3);
    buffer.back() = 4;
    EXPECT_EQ(*buffer.latest(), 3);
    buffer.publish();
    EXPECT_EQ(*buffer.latest(), 4);
}

}  // namespace
}  // namespace candela
