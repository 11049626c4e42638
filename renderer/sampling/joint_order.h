// SPDX-License-Identifier: MIT
// In which order each of the first pairs of dimensions walks through the two-dimensional Sobol sequence, so that the
// pairs together are well stratified in four dimensions and more ("Cascaded Sobol' sampling", Paulin, Coeurjolly,
// Iehl, Bonneel, Keller and Ostromoukhov 2021).
//
// An order is linear over the bits of the index and maps [0, 2^m) onto itself, so that every pair by itself stays the
// (0, 2)-sequence that it is. The matrices were found column by column: of thousands of random columns the one whose
// points have the least t as nets with those of the pairs before, the pixel's counting twice. Sequences of 2^20 points
// were looked at; the columns beyond are random.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace candela {

// Columns of the matrices, for bit 0 of the index and on: the camera's lens, then of the first surface the direction,
// the choices of lobe and light, and the point on the light. The first pair, the pixel's, keeps the order.
inline constexpr std::array<std::array<uint32_t, 32>, 4> joint_orders{{
    {0x1u,       0x2u,       0x4u,       0x9u,       0x16u,       0x3eu,       0x7cu,       0xe4u,
     0x17fu,     0x219u,     0x66bu,     0xb7cu,     0x1f0bu,     0x2b66u,     0x408au,     0xfd3eu,
     0x1e5c8u,   0x225a4u,   0x79bb3u,   0xad930u,   0x1f2ee7u,   0x2c6c2bu,   0x67e2a0u,   0xe00d18u,
     0x13c6d99u, 0x2ed90ccu, 0x73fc0fdu, 0xfb141e4u, 0x1a9d3e14u, 0x2dff98f9u, 0x513ada49u, 0xb8790017u},
    {0x1u,       0x2u,       0x5u,       0xbu,       0x10u,       0x21u,       0x43u,       0xfeu,
     0x16du,     0x306u,     0x424u,     0xa0cu,     0x1a81u,     0x392fu,     0x55d9u,     0xf027u,
     0x11160u,   0x3e4ebu,   0x5ea2fu,   0xab44au,   0x143292u,   0x39e7beu,   0x648fdbu,   0xa2befeu,
     0x1f66c61u, 0x2af76e7u, 0x5fbd351u, 0xe5d186au, 0x116cd4e3u, 0x339ee0b2u, 0x4e34dbaau, 0x9647807cu},
    {0x1u,       0x2u,       0x5u,       0xcu,       0x16u,       0x2bu,       0x53u,       0x94u,
     0x1cdu,     0x259u,     0x4c7u,     0x8d0u,     0x13e0u,     0x21f2u,     0x4302u,     0xe001u,
     0x1813fu,   0x211bcu,   0x48a86u,   0xf2697u,   0x12f250u,   0x32a4b7u,   0x79ec6eu,   0xf3ffd6u,
     0x1475b01u, 0x2381fa1u, 0x74144dfu, 0xc061107u, 0x185f8ee9u, 0x3217e44eu, 0x4048bf2au, 0x846b4094u},
    {0x1u,       0x2u,       0x5u,       0xbu,       0x17u,       0x28u,       0x51u,       0xc2u,
     0x112u,     0x38fu,     0x60fu,     0xae4u,     0x111bu,     0x37a3u,     0x5676u,     0x9278u,
     0x18498u,   0x38707u,   0x79fe4u,   0xae199u,   0x1aa77au,   0x31e384u,   0x68e694u,   0xc2b325u,
     0x1420688u, 0x2f154e1u, 0x77e2097u, 0xf5f1e1au, 0x149b30b3u, 0x315cf55cu, 0x64eca7deu, 0xbbfb676au},
}};

// The number in the sequence of the point that a pair takes for its sample `index`.
constexpr uint32_t joint_order(uint32_t pair, uint32_t index) {
    if (pair == 0) return index;
    uint32_t order = 0;
    for (; index != 0; index &= index - 1)
        order ^= joint_orders[pair - 1][static_cast<size_t>(std::countr_zero(index))];
    return order;
}

}  // namespace candela
