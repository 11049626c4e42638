// SPDX-License-Identifier: MIT
// The source of sample points: a pure function of (pixel, sample index, seed), so that a picture is the same to the bit
// whatever thread computes which sample.
#pragma once

#include "renderer/math/math.h"

namespace candela {

enum class SamplerKind : uint8_t { sobol, independent };

// Two statistically independent replicates run interleaved: sample i belongs to replicate i % replicate_count and is
// point i / replicate_count of that replicate's own sequence. Their difference is an honest error estimate.
inline constexpr uint32_t replicate_count = 2;

// So many pairs of dimensions, the first ones, are stratified together too: what the camera and the first surface want.
inline constexpr uint32_t joint_pairs = 5;

// A 16-byte value. sobol: Owen-scrambled Sobol points in pairs of dimensions (Burley 2020, "Practical Hash-based Owen
// Scrambling"). The first pairs walk through them in orders that make good points of higher dimension (joint_order.h),
// the later ones in random orders, each by its own hash; independent: hashed counter.
class Sampler {
  public:
    Sampler() = default;
    Sampler(SamplerKind kind, Vec2u pixel, uint32_t sample_index, uint32_t seed);

    // Uniform in [0, 1).
    float next_1d();
    // Uniform in [0, 1)²; the two numbers of one call are stratified together.
    Vec2 next_2d();

    // Continues at a fixed dimension, so that each vertex of a path owns its dimensions however many the one before
    // used.
    void start_dimension(uint32_t dimension) { dimension_ = dimension; }
    // A 32-bit hash of pixel, sample index and seed, for decisions outside the sequence (stochastic alpha).
    uint32_t hash() const;

  private:
    friend struct PointBatch;

    uint32_t pixel_hash_ = 0;
    uint32_t index_ = 0;
    uint32_t dimension_ = 0;
    SamplerKind kind_ = SamplerKind::sobol;
};
static_assert(sizeof(Sampler) == 16);

// Points of many samplers of one kind at once, to the bit what next_2d() of each gives: vector units do eight of them
// in the time of one.
struct PointBatch {
    static constexpr size_t capacity = 256;
    static constexpr size_t most_pairs = 4;

    // Where the points of sampler i come from: those of its next pairs of dimensions.
    void set(size_t i, const Sampler& sampler) {
        pixel_hash[i] = sampler.pixel_hash_;
        index[i] = sampler.index_;
        dimension[i] = sampler.dimension_;
        kind = sampler.kind_;
    }
    // Fills point(i, 0 … pairs - 1) for the first `count` samplers.
    void draw(size_t count, size_t pairs) noexcept;
    Vec2 point(size_t i, size_t pair) const { return {x[pair][i], y[pair][i]}; }

    alignas(64) uint32_t pixel_hash[capacity];
    alignas(64) uint32_t index[capacity];
    alignas(64) uint32_t dimension[capacity];
    alignas(64) uint32_t ordered[capacity];
    alignas(64) float x[most_pairs][capacity];
    alignas(64) float y[most_pairs][capacity];
    SamplerKind kind = SamplerKind::sobol;
};

}  // namespace candela
