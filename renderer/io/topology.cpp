// SPDX-License-Identifier: MIT
#include "renderer/io/topology.h"

namespace candela {
namespace {

template <typename Corner>
std::vector<Vec3u> assemble(PrimitiveMode mode, uint64_t corner_count, const Corner& corner) {
    std::vector<Vec3u> triangles(triangle_count(mode, corner_count));
    for (uint64_t i = 0; i < triangles.size(); ++i) {
        switch (mode) {
            case PrimitiveMode::triangle_strip:
                // p_i = {v_i, v_{i + (1 + i mod 2)}, v_{i + (2 - i mod 2)}}
                triangles[i] = {corner(i), corner(i + 1 + i % 2), corner(i + 2 - i % 2)};
                break;
            case PrimitiveMode::triangle_fan:
                // p_i = {v_{i+1}, v_{i+2}, v_0}
                triangles[i] = {corner(i + 1), corner(i + 2), corner(0)};
                break;
            default:
                triangles[i] = {corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)};
        }
    }
    return triangles;
}

}  // namespace

const char* mode_name(PrimitiveMode mode) {
    switch (mode) {
        case PrimitiveMode::points:
            return "points";
        case PrimitiveMode::lines:
        case PrimitiveMode::line_loop:
        case PrimitiveMode::line_strip:
            return "lines";
        default:
            return "triangles";
    }
}

uint64_t triangle_count(PrimitiveMode mode, uint64_t corner_count) {
    switch (mode) {
        case PrimitiveMode::triangles:
            return corner_count / 3;
        case PrimitiveMode::triangle_strip:
        case PrimitiveMode::triangle_fan:
            return corner_count < 3 ? 0 : corner_count - 2;
        default:
            return 0;
    }
}

std::vector<Vec3u> assemble_triangles(PrimitiveMode mode, std::span<const uint32_t> corners) {
    return assemble(mode, corners.size(), [corners](uint64_t i) { return corners[i]; });
}

std::vector<Vec3u> assemble_triangles(PrimitiveMode mode, uint32_t corner_count) {
    return assemble(mode, corner_count, [](uint64_t i) { return static_cast<uint32_t>(i); });
}

}  // namespace candela
