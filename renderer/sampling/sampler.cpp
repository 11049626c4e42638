// SPDX-License-Identifier: MIT
#include "renderer/sampling/sampler.h"

#include "renderer/math/hash.h"

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

constexpr uint32_t owen_scramble(uint32_t x, uint32_t seed) {
    return reverse_bits(laine_karras(reverse_bits(x), seed));
}

// The second Sobol dimension: the generator matrix of the polynomial x + 1, whose columns are Pascal's triangle mod 2.
constexpr uint32_t sobol_second(uint32_t index) {
    uint32_t out = 0;
    for (uint32_t column = 0x80000000u; index != 0; index >>= 1, column ^= column >> 1) {
        if ((index & 1u) != 0) out ^= column;
    }
    return out;
}

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
    dimension_ += 2;
    if (kind_ == SamplerKind::independent) {
        const uint32_t a = hash_combine(seed, index_);
        return {unit_float(a), unit_float(hash_u32(a ^ 0x9e3779b9u))};
    }
    // Each pair of dimensions sees the sequence in an order of its own (Burley 2020, section 5), so that pairs are
    // independent.
    const uint32_t shuffled = owen_scramble(index_, seed);
    return {unit_float(owen_scramble(reverse_bits(shuffled), hash_u32(seed ^ 0xe6fe3bebu))),
            unit_float(owen_scramble(sobol_second(shuffled), hash_u32(seed ^ 0x2d15a2a7u)))};
}

uint32_t Sampler::hash() const {
    return hash_combine(pixel_hash_, index_);
}

}  // namespace candela
