// SPDX-License-Identifier: MIT
// What the table of interface_table.h holds: the integral, and where its nodes lie.
#pragma once

#include <array>
#include <cstddef>

namespace candela {

struct InterfaceTable {
    static constexpr int cosines = 24, alphas = 16, indices = 17;

    std::array<float, size_t{cosines} * alphas * indices> albedo;  // by index, width and cosine, which runs fastest

    static constexpr size_t at(size_t cosine, size_t alpha, size_t index) {
        return (index * alphas + alpha) * cosines + cosine;
    }
    static InterfaceTable integrated();
};

}  // namespace candela
