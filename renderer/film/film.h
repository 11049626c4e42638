// SPDX-License-Identifier: MIT
// Per-pixel accumulation of radiance samples. A pixel is written by one worker at a time; the caller sees to that.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "renderer/film/frame.h"
#include "renderer/math/math.h"

namespace candela {

// What a sample cost.
struct PathCost {
    uint32_t segments = 0;     // camera and bounce rays
    uint32_t shadow_rays = 0;  // connections to lights
};

// 36 bytes. Sums are of finite samples; others only count in non_finite and in the cost.
struct FilmPixel {
    Vec3 radiance_sum{0};
    float alpha_sum = 0;
    float even_luminance_sum = 0;  // luminance of the samples of replicate 0, for the error estimate
    uint32_t count = 0;
    uint32_t non_finite = 0;
    uint32_t segments = 0;
    uint32_t shadow_rays = 0;
};
static_assert(sizeof(FilmPixel) == 36);

class Film {
  public:
    Film() = default;
    // light_groups: into how many parts samples are divided by where their light comes from; 0: they are not.
    explicit Film(Vec2u extent, size_t light_groups = 0);

    Vec2u extent() const { return extent_; }
    void clear();
    void clear_rows(uint32_t row_begin, uint32_t row_end) noexcept;
    // Adds one sample; samples of one pixel must come in the order of their index (a float sum depends on it).
    // by_light: its parts, one for each light group.
    void add(Vec2u pixel, uint32_t sample_index, const Vec3& radiance, float alpha, PathCost cost = {},
             std::span<const Vec3> by_light = {}) noexcept;

    const FilmPixel& at(Vec2u pixel) const noexcept { return pixels_[size_t{pixel.y} * extent_.x + pixel.x]; }
    std::span<const FilmPixel> pixels() const { return pixels_; }

    size_t light_groups() const { return light_groups_; }
    // Mean radiance and alpha of a pixel; weights for the light groups, as many as there are, or none for the plain
    // sum.
    Vec4 mean(const FilmPixel& pixel, std::span<const Vec3> weights) const noexcept;
    // The same film as if the lights had been so bright. What the replicates say of its error is scaled, not weighted.
    Film reweighted(std::span<const Vec3> weights) const;
    uint64_t bytes() const { return pixels_.size() * sizeof(FilmPixel) + by_light_.size() * sizeof(Vec3); }

  private:
    Vec2u extent_{0};
    Vec3 weighted_sum(size_t index, std::span<const Vec3> weights) const noexcept;

    std::vector<FilmPixel> pixels_;
    size_t light_groups_ = 0;
    std::vector<Vec3> by_light_;  // sums, light_groups_ of each pixel
};

// Writes rows [row_begin, row_end) of the resolved picture. A pixel without samples takes the value of the nearest
// coarser lattice point (strides 2, 4, … 64) that has one, so that a stride-8 pass fills the whole frame.
// weights: as for Film::mean.
void resolve_rows(const Film& film, uint32_t row_begin, uint32_t row_end, Frame& frame,
                  std::span<const Vec3> weights = {}) noexcept;

// Shares the rows [0, height) out by calls of work(begin, end), on any threads, and returns when all are done.
using RowWork = std::function<void(uint32_t, uint32_t)>;
using RowRunner = std::function<void(uint32_t height, const RowWork& work)>;
inline void run_in_one_go(uint32_t height, const RowWork& work) {
    work(0, height);
}

// What the film says of its own error; two passes over the pixels. The same to the bit for any runner.
FilmStatistics measure(const Film& film, const RowRunner& run = run_in_one_go);

// Writes rows [row_begin, row_end) of frame.maps, which has the film's extent. mean_luminance: of the picture.
void map_rows(const Film& film, double mean_luminance, uint32_t row_begin, uint32_t row_end, Frame& frame);

// The per-pixel estimate of the standard error of the luminance (from replicate differences, pooled over a small
// neighbourhood).
std::vector<float> standard_error_map(const Film& film);

}  // namespace candela
