// SPDX-License-Identifier: MIT
#include "renderer/bsdf/interface_table.h"

#include "renderer/bsdf/albedo_integral.h"
#include "renderer/bsdf/interface_integral.h"

namespace candela {

namespace {

// Made by make_tables.cpp.
constexpr InterfaceTable table =
#include "renderer/bsdf/interface_values.inc"
    ;

float position_of_index(float eta) {
    return (eta - 1.0f) / (eta + 1.0f) + 0.5f;
}

}  // namespace

float interface_albedo(float cos_theta, float alpha, float eta) noexcept {
    const TableAxis x = locate(std::sqrt(std::max(cos_theta, 0.0f)), InterfaceTable::cosines);
    const TableAxis y = locate(std::sqrt(alpha), InterfaceTable::alphas);
    const TableAxis z = locate(position_of_index(eta), InterfaceTable::indices);
    const auto along_x = [&](size_t j, size_t k) {
        const size_t at = InterfaceTable::at(static_cast<size_t>(x.index), j, k);
        return lerp(table.albedo[at], table.albedo[at + 1], x.offset);
    };
    const auto along_xy = [&](size_t k) {
        const auto j = static_cast<size_t>(y.index);
        return lerp(along_x(j, k), along_x(j + 1, k), y.offset);
    };
    const auto k = static_cast<size_t>(z.index);
    return lerp(along_xy(k), along_xy(k + 1), z.offset);
}

}  // namespace candela
