// SPDX-License-Identifier: MIT
// Triangles out of glTF's primitive modes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/math/math.h"

namespace candela {

enum class PrimitiveMode : uint8_t { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };

// Triangles that corner_count corners make, or points, or segments; the incomplete last one of a list does not count.
uint64_t triangle_count(PrimitiveMode mode, uint64_t corner_count);

// Corners by their vertex index, wound as glTF 2.0, section 3.7.2.1 says: every triangle faces the way its mode does.
// A point v stands as (v, v, v) and a segment from a to b as (a, b, b), until they get bodies (strokes.h).
std::vector<Vec3u> assemble_triangles(PrimitiveMode mode, std::span<const uint32_t> corners);
// The same where corner i is vertex i.
std::vector<Vec3u> assemble_triangles(PrimitiveMode mode, uint32_t corner_count);

}  // namespace candela
