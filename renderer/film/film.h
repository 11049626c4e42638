// SPDX-License-Identifier: MIT
// Per-pixel accumulation of radiance samples. A pixel is written by one worker at a time; the caller sees to that.
#pragma once

#include <span>
#include <vector>

#include "renderer/film/frame.h"
#include "renderer/math/math.h"

namespace candela {

// 32 bytes. Sums are of finite samples; others only count in non_finite.
struct FilmPixel {
    Vec3 radiance_sum{0};
    float alpha_sum = 0;
    float even_luminance_sum = 0;  // luminance of the samples of replicate 0, for the error estimate
    float luminance_sq_sum = 0;    // sum of squared sample luminances
    uint32_t count = 0;
    uint32_t non_finite = 0;
};
static_assert(sizeof(FilmPixel) == 32);

class Film {
  public:
    Film() = default;
    explicit Film(Vec2u extent);

    Vec2u extent() const { return extent_; }
    void clear();
    void clear_rows(uint32_t row_begin, uint32_t row_end) noexcept;
    // Adds one sample; samples of one pixel must come in the order of their index (a float sum depends on it).
    void add(Vec2u pixel, uint32_t sample_index, const Vec3& radiance, float alpha) noexcept;

    const FilmPixel& at(Vec2u pixel) const noexcept { return pixels_[size_t{pixel.y} * extent_.x + pixel.x]; }
    std::span<const FilmPixel> pixels() const { return pixels_; }

  private:
    Vec2u extent_{0};
    std::vector<FilmPixel> pixels_;
};

// Writes rows [row_begin, row_end) of the resolved picture. A pixel without samples takes the value of the nearest
// coarser lattice point (strides 2, 4, 8, 16) that has one, so that a stride-8 pass fills the whole frame.
void resolve_rows(const Film& film, uint32_t row_begin, uint32_t row_end, Frame& frame) noexcept;

// What the film says of its own error; one pass over the pixels.
FilmStatistics measure(const Film& film);

// The per-pixel estimate of the standard error of the luminance (from replicate differences, pooled over a small
// neighbourhood).
std::vector<float> standard_error_map(const Film& film);

}  // namespace candela
