// SPDX-License-Identifier: MIT
#include "renderer/io/repair.h"

#include "renderer/scene/deform.h"

namespace candela {
namespace {

// Squares of larger coordinates, and products of four of them, leave single precision's range.
constexpr float farthest_m = 1e9f;

bool placeable(const Vec3& p) {
    return std::abs(p.x) <= farthest_m && std::abs(p.y) <= farthest_m && std::abs(p.z) <= farthest_m;
}

// False for zero and for what is not finite.
bool normalize(Vec3& v) {
    const glm::dvec3 wide(v);
    const double squared = glm::dot(wide, wide);
    if (!(squared > 1e-30) || !std::isfinite(squared)) return false;
    v = Vec3(wide / std::sqrt(squared));
    return true;
}

Vec3 any_perpendicular(const Vec3& n) {
    const Vec3 axis = std::abs(n.x) < 0.6f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    return glm::normalize(axis - n * glm::dot(n, axis));
}

template <typename T>
void gather(std::vector<T>& values, const std::vector<uint32_t>& kept) {
    if (values.empty()) return;
    std::vector<T> out;
    out.reserve(kept.size() + position_padding);
    out.resize(kept.size());
    for (size_t i = 0; i < kept.size(); ++i)
        out[i] = values[kept[i]];
    values = std::move(out);
}

}  // namespace

void gather_vertices(Primitive& primitive, const std::vector<uint32_t>& kept) {
    gather(primitive.positions, kept);
    gather(primitive.normals, kept);
    gather(primitive.tangents, kept);
    gather(primitive.uv[0], kept);
    gather(primitive.uv[1], kept);
    gather(primitive.colors, kept);
    if (primitive.deformation) {
        primitive.deformation = std::make_shared<const Deformation>(gather_vertices(*primitive.deformation, kept));
    }
}

uint64_t vertex_bytes(const Primitive& p) {
    return p.positions.size() * sizeof(Vec3) + p.normals.size() * sizeof(Vec3) + p.tangents.size() * sizeof(Vec4) +
           (p.uv[0].size() + p.uv[1].size()) * sizeof(Vec2) + p.colors.size() * sizeof(Vec4);
}

size_t drop_unused_vertices(Primitive& primitive) {
    const size_t before = primitive.positions.size();
    std::vector<uint8_t> used(before, 0);
    for (const Vec3u& t : primitive.triangles)
        used[t.x] = used[t.y] = used[t.z] = 1;
    if (std::find(used.begin(), used.end(), uint8_t{0}) == used.end()) return 0;
    std::vector<uint32_t> new_index(before), kept;
    for (uint32_t i = 0; i < before; ++i) {
        new_index[i] = static_cast<uint32_t>(kept.size());
        if (used[i] != 0) kept.push_back(i);
    }
    for (Vec3u& t : primitive.triangles)
        t = {new_index[t.x], new_index[t.y], new_index[t.z]};
    gather_vertices(primitive, kept);
    return before - kept.size();
}

size_t drop_unplaceable_triangles(Primitive& primitive) {
    const std::vector<Vec3>& p = primitive.positions;
    if (std::all_of(p.begin(), p.end(), placeable)) return 0;
    const size_t before = primitive.triangles.size();
    std::erase_if(primitive.triangles,
                  [&](const Vec3u& t) { return !placeable(p[t.x]) || !placeable(p[t.y]) || !placeable(p[t.z]); });
    for (Vec3& position : primitive.positions) {
        if (!placeable(position)) position = Vec3(0);
    }
    return before - primitive.triangles.size();
}

size_t repair_normals(Primitive& primitive) {
    std::vector<uint8_t> bad(primitive.normals.size(), 0);
    size_t count = 0;
    for (size_t i = 0; i < primitive.normals.size(); ++i) {
        if (normalize(primitive.normals[i])) continue;
        primitive.normals[i] = Vec3(0);
        bad[i] = 1;
        ++count;
    }
    if (count == 0) return 0;
    for (const Vec3u& t : primitive.triangles) {
        if ((bad[t.x] | bad[t.y] | bad[t.z]) == 0) continue;
        const std::vector<Vec3>& p = primitive.positions;
        const Vec3 twice_area = glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
        if (!is_finite(twice_area)) continue;
        for (int c = 0; c < 3; ++c) {
            if (bad[t[c]] != 0) primitive.normals[t[c]] += twice_area;
        }
    }
    for (size_t i = 0; i < bad.size(); ++i) {
        if (bad[i] != 0 && !normalize(primitive.normals[i])) primitive.normals[i] = Vec3(0, 0, 1);
    }
    return count;
}

size_t repair_tangents(Primitive& primitive) {
    size_t count = 0;
    for (size_t i = 0; i < primitive.tangents.size(); ++i) {
        Vec4& tangent = primitive.tangents[i];
        Vec3 direction(tangent);
        if (!normalize(direction)) {
            direction = any_perpendicular(primitive.normals[i]);
            ++count;
        }
        tangent = Vec4(direction, tangent.w < 0.0f ? -1.0f : 1.0f);
    }
    return count;
}

size_t repair_uv_and_colors(Primitive& primitive) {
    size_t count = 0;
    for (std::vector<Vec2>& set : primitive.uv) {
        for (Vec2& uv : set) {
            if (std::isfinite(uv.x) && std::isfinite(uv.y)) continue;
            uv = Vec2(0);
            ++count;
        }
    }
    for (Vec4& color : primitive.colors) {
        if (is_finite(Vec3(color)) && std::isfinite(color.w)) {
            color = glm::max(color, 0.0f);
        } else {
            color = Vec4(1);
            ++count;
        }
    }
    return count;
}

}  // namespace candela
