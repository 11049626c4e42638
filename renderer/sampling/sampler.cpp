// SPDX-License-Identifier: MIT
#include "renderer/sampling/sampler.h"

#include <algorithm>

#include "renderer/math/hash.h"
#include "renderer/sampling/joint_order.h"

namespace candela {

namespace {

constexpr uint32_t reverse_bits(uint32_t x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// A hash in which every bit depends on itself and lower bits only; on bit-reversed numbers it is a nested uniform
// (Owen) scramble. Laine and Karras 2011, constants of Vegdahl 2021.
constexpr uint32_t laine_karras(uint32_t x, uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// The second Sobol dimension with its bits reversed: the generator matrix is Pascal's triangle mod 2, so that bit k of
// the result is the sum of the index's bits j of which k is a subset (Lucas), which five doublings add up.
constexpr uint32_t reversed_sobol_second(uint32_t index) {
    index ^= (index & 0xaaaaaaaau) >> 1;
    index ^= (index & 0xccccccccu) >> 2;
    index ^= (index & 0xf0f0f0f0u) >> 4;
    index ^= (index & 0xff00ff00u) >> 8;
    return index ^ (index >> 16);
}

struct Point {
    float x = 0, y = 0;
};

// A random order of the sequence, so that pairs are independent (Burley 2020, section 5). An Owen scramble takes its
// number with the bits reversed and gives it so.
[[gnu::always_inline]] inline uint32_t shuffled(uint32_t seed, uint32_t index) {
    return reverse_bits(laine_karras(reverse_bits(index), seed));
}

static_assert(joint_pairs == 1 + joint_orders.size());

constexpr bool is_joint(uint32_t dimension) {
    return dimension < 2 * joint_pairs;
}

// Point number `ordered` of the scrambled sequence.
[[gnu::always_inline]] inline Point sobol_point(uint32_t seed, uint32_t ordered) {
    return {unit_float(reverse_bits(laine_karras(ordered, hash_u32(seed ^ 0xe6fe3bebu)))),
            unit_float(reverse_bits(laine_karras(reversed_sobol_second(ordered), hash_u32(seed ^ 0x2d15a2a7u))))};
}

[[gnu::always_inline]] inline Point independent_point(uint32_t seed, uint32_t index) {
    const uint32_t a = hash_combine(seed, index);
    return {unit_float(a), unit_float(hash_u32(a ^ 0x9e3779b9u))};
}

// The orders of samplers of which some are in the first pairs; most have the same index.
void find_order(PointBatch& batch, size_t count, uint32_t offset) {
    uint32_t last_index = 0, last_dimension = 0, last = 0;
    for (size_t i = 0; i < count; ++i) {
        const uint32_t dimension = batch.dimension[i] + offset;
        const uint32_t index = batch.index[i];
        if (!is_joint(dimension)) {
            batch.ordered[i] = shuffled(hash_combine(batch.pixel_hash[i], dimension), index);
            continue;
        }
        if (index != last_index || dimension != last_dimension) {
            last_index = index;
            last_dimension = dimension;
            last = joint_order(dimension / 2, index);
        }
        batch.ordered[i] = last;
    }
}

// The loops of PointBatch::draw, compiled for more than one instruction set.
[[gnu::always_inline]] inline void draw_all(PointBatch& batch, size_t count, size_t pairs) {
    // Whole vectors: what lies beyond count is computed in vain.
    constexpr size_t step = 8;
    const size_t end = (count + step - 1) / step * step;
    const uint32_t first = *std::min_element(batch.dimension, batch.dimension + count);
    for (size_t pair = 0; pair < pairs; ++pair) {
        float* const x = batch.x[pair];
        float* const y = batch.y[pair];
        const auto offset = static_cast<uint32_t>(2 * pair);
        const auto fill = [&](auto point) {
            for (size_t i = 0; i < end; i += step) {
                for (size_t k = i; k < i + step; ++k) {
                    const Point p = point(hash_combine(batch.pixel_hash[k], batch.dimension[k] + offset), k);
                    x[k] = p.x;
                    y[k] = p.y;
                }
            }
        };
        if (batch.kind == SamplerKind::independent) {
            fill([&](uint32_t seed, size_t k) { return independent_point(seed, batch.index[k]); });
        } else if (is_joint(first + offset)) {
            find_order(batch, count, offset);
            fill([&](uint32_t seed, size_t k) { return sobol_point(seed, batch.ordered[k]); });
        } else {
            fill([&](uint32_t seed, size_t k) { return sobol_point(seed, shuffled(seed, batch.index[k])); });
        }
    }
}

#ifdef __x86_64__
[[gnu::target("avx2")]] void draw_all_avx2(PointBatch& batch, size_t count, size_t pairs) {
    draw_all(batch, count, pairs);
}
#endif

}  // namespace

Sampler::Sampler(SamplerKind kind, Vec2u pixel, uint32_t sample_index, uint32_t seed)
    : pixel_hash_(hash_combine(hash_combine(hash_combine(hash_u32(seed ^ 0x68bc21ebu), pixel.x), pixel.y),
                               sample_index % replicate_count)),
      index_(sample_index / replicate_count),
      kind_(kind) {}

float Sampler::next_1d() {
    return next_2d().x;
}

Vec2 Sampler::next_2d() {
    const uint32_t seed = hash_combine(pixel_hash_, dimension_);
    const auto draw = [&] {
        if (kind_ == SamplerKind::independent) return independent_point(seed, index_);
        return sobol_point(seed, is_joint(dimension_) ? joint_order(dimension_ / 2, index_) : shuffled(seed, index_));
    };
    const Point point = draw();
    dimension_ += 2;
    return {point.x, point.y};
}

void PointBatch::draw(size_t count, size_t pairs) noexcept {
    if (count == 0) return;
#ifdef __x86_64__
    static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
    if (has_avx2) {
        draw_all_avx2(*this, count, pairs);
        return;
    }
#endif
    draw_all(*this, count, pairs);
}

uint32_t Sampler::hash() const {
    return hash_combine(pixel_hash_, index_);
}

}  // namespace candela
