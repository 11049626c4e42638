// SPDX-License-Identifier: MIT
#include "renderer/io/topology.h"

namespace candela {
namespace {

template <typename Corner>
std::vector<Vec3u> assemble(PrimitiveMode mode, uint64_t corner_count, const Corner& corner) {
    std::vector<Vec3u> triangles(triangle_count(mode, corner_count));
    for (uint64_t i = 0; i < triangles.size(); ++i) {
        switch (mode) {
            case PrimitiveMode::points:
                triangles[i] = Vec3u(corner(i));
                break;
            case PrimitiveMode::lines:
                triangles[i] = {corner(2 * i), corner(2 * i + 1), corner(2 * i + 1)};
                break;
            case PrimitiveMode::line_loop:
            case PrimitiveMode::line_strip:
                // p_i = {v_i, v_{i+1}}, and the loop closes
                triangles[i] = {corner(i), corner((i + 1) % corner_count), corner((i + 1) % corner_count)};
                break;
            case PrimitiveMode::triangle_strip:
                // p_i = {v_i, v_{i + (1 + i mod 2)}, v_{i + (2 - i mod 2)}}
                triangles[i] = {corner(i), corner(i + 1 + i % 2), corner(i + 2 - i % 2)};
                break;
            case PrimitiveMode::triangle_fan:
                // p_i = {v_{i+1}, v_{i+2}, v_0}
                triangles[i] = {corner(i + 1), corner(i + 2), corner(0)};
                break;
            case PrimitiveMode::triangles:
                triangles[i] = {corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)};
        }
    }
    return triangles;
}

}  // namespace

uint64_t triangle_count(PrimitiveMode mode, uint64_t corner_count) {
    switch (mode) {
        case PrimitiveMode::points:
            return corner_count;
        case PrimitiveMode::lines:
            return corner_count / 2;
        case PrimitiveMode::line_loop:
            return corner_count < 2 ? 0 : corner_count;
        case PrimitiveMode::line_strip:
            return corner_count < 2 ? 0 : corner_count - 1;
        case PrimitiveMode::triangles:
            return corner_count / 3;
        case PrimitiveMode::triangle_strip:
        case PrimitiveMode::triangle_fan:
            return corner_count < 3 ? 0 : corner_count - 2;
    }
    return 0;
}

std::vector<Vec3u> assemble_triangles(PrimitiveMode mode, std::span<const uint32_t> corners) {
    return assemble(mode, corners.size(), [corners](uint64_t i) { return corners[i]; });
}

std::vector<Vec3u> assemble_triangles(PrimitiveMode mode, uint32_t corner_count) {
    return assemble(mode, corner_count, [](uint64_t i) { return static_cast<uint32_t>(i); });
}

}  // namespace candela
