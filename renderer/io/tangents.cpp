// SPDX-License-Identifier: MIT
// After Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", section 6: tangents are shared by the corners of
// faces that meet in a vertex across an edge and agree in handedness, weighted by the faces' angles there.
#include "renderer/io/tangents.h"

#include <array>
#include <bit>
#include <numeric>
#include <unordered_map>

#include "renderer/math/hash.h"
#include "renderer/math/parallel.h"
#include "renderer/scene/deform.h"

namespace candela {
namespace {

// The tangent direction of one face and how its texture lies on it.
struct Face {
    Vec3 tangent{0};                 // along +u, unit; 0 where uv has no extent
    bool keeps_orientation = false;  // uv turns the same way as the face
    bool any_orientation = true;     // no area in uv: joins whatever is beside it
};

bool normalize_or_zero(Vec3& v) {
    const float length = glm::length(v);
    v = length > 0.0f && std::isfinite(length) ? v / length : Vec3(0);
    return length > 0.0f;
}

constexpr size_t corners_at_once = 4096;

class TangentBuilder {
  public:
    TangentBuilder(Primitive& primitive, uint32_t uv_set) : primitive_(primitive), uv_(primitive.uv[uv_set]) {}

    void run();
    // Of every vertex the mean over its corners, unit, with nothing written to the primitive.
    std::vector<Vec3> mean_tangents();

  private:
    uint32_t vertex(size_t corner) const { return primitive_.triangles[corner / 3][static_cast<int>(corner % 3)]; }
    Vec3 position(size_t corner) const { return primitive_.positions[vertex(corner)]; }
    Vec3 normal(size_t corner) const {
        return primitive_.normals.empty() ? face_normals_[corner / 3] : primitive_.normals[vertex(corner)];
    }

    void make_tangents();
    void make_faces();
    void weld_corners();
    void join_across_edges();
    void accumulate();
    void write_back();

    uint32_t find(uint32_t corner);
    void join(size_t a, size_t b);
    bool same_vertex(size_t a, size_t b) const;
    uint32_t hash_of(size_t corner) const;

    Primitive& primitive_;
    const std::vector<Vec2>& uv_;
    std::vector<Face> faces_;
    std::vector<Vec3> face_normals_;
    std::vector<uint32_t> welded_;  // by corner: the first corner with equal position, normal and uv
    std::vector<uint32_t> parent_;  // union-find over corners
    std::vector<Vec4> tangents_;    // by corner
};

void TangentBuilder::make_faces() {
    const size_t count = primitive_.triangles.size();
    faces_.resize(count);
    face_normals_.resize(count);
    parallel_for_each(count, corners_at_once, [&](size_t t) {
        const Vec3 d1 = position(3 * t + 1) - position(3 * t);
        const Vec3 d2 = position(3 * t + 2) - position(3 * t);
        face_normals_[t] = glm::cross(d1, d2);
        normalize_or_zero(face_normals_[t]);
        const Vec2 t1 = uv_[vertex(3 * t + 1)] - uv_[vertex(3 * t)];
        const Vec2 t2 = uv_[vertex(3 * t + 2)] - uv_[vertex(3 * t)];
        const float signed_area = t1.x * t2.y - t1.y * t2.x;
        Face& face = faces_[t];
        face.keeps_orientation = signed_area > 0.0f;
        if (signed_area == 0.0f || !std::isfinite(signed_area)) return;
        face.tangent = (d1 * t2.y - d2 * t1.y) * (face.keeps_orientation ? 1.0f : -1.0f);
        face.any_orientation = !normalize_or_zero(face.tangent);
    });
}

bool TangentBuilder::same_vertex(size_t a, size_t b) const {
    return vertex(a) == vertex(b)
               ? !primitive_.normals.empty() || normal(a) == normal(b)
               : position(a) == position(b) && normal(a) == normal(b) && uv_[vertex(a)] == uv_[vertex(b)];
}

uint32_t TangentBuilder::hash_of(size_t corner) const {
    const Vec3 p = position(corner), n = normal(corner);
    const Vec2 uv = uv_[vertex(corner)];
    uint32_t hash = 0;
    // Adding 0 makes -0 and 0 the same bits.
    for (const float value : {p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y}) {
        hash = hash_combine(hash, std::bit_cast<uint32_t>(value + 0.0f));
    }
    return hash;
}

void TangentBuilder::weld_corners() {
    const size_t corners = 3 * primitive_.triangles.size();
    welded_.resize(corners);
    constexpr uint32_t empty = 0xffffffffu;
    // Corners of one vertex are alike, unless each face has a normal of its own: then each corner is looked for.
    const bool by_vertex = !primitive_.normals.empty();
    const size_t entries = by_vertex ? std::min(primitive_.positions.size(), corners) : corners;
    const size_t slots = std::bit_ceil(2 * entries + 1);
    std::vector<uint32_t> table(slots, empty);
    std::vector<uint32_t> of_vertex(by_vertex ? primitive_.positions.size() : 0, empty);
    for (size_t corner = 0; corner < corners; ++corner) {
        if (by_vertex && of_vertex[vertex(corner)] != empty) {
            welded_[corner] = of_vertex[vertex(corner)];
            continue;
        }
        size_t slot = hash_of(corner) & (slots - 1);
        while (table[slot] != empty && !same_vertex(table[slot], corner))
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == empty) table[slot] = static_cast<uint32_t>(corner);
        welded_[corner] = table[slot];
        if (by_vertex) of_vertex[vertex(corner)] = table[slot];
    }
}

uint32_t TangentBuilder::find(uint32_t corner) {
    while (parent_[corner] != corner) {
        parent_[corner] = parent_[parent_[corner]];
        corner = parent_[corner];
    }
    return corner;
}

void TangentBuilder::join(size_t a, size_t b) {
    const uint32_t root_a = find(static_cast<uint32_t>(a));
    const uint32_t root_b = find(static_cast<uint32_t>(b));
    parent_[std::max(root_a, root_b)] = std::min(root_a, root_b);
}

void TangentBuilder::join_across_edges() {
    struct Edge {
        uint32_t other;   // the larger of both welded ends
        uint32_t corner;  // where it starts
        bool operator<(const Edge& o) const { return other != o.other ? other < o.other : corner < o.corner; }
    };
    const auto next = [](uint32_t corner) { return corner - corner % 3 + (corner % 3 + 1) % 3; };
    const auto corners = static_cast<uint32_t>(welded_.size());
    parent_.resize(corners);
    std::iota(parent_.begin(), parent_.end(), 0u);

    // The edges of each smaller end lie together, in the order of the larger ones and then of their corners.
    std::vector<uint32_t> first(size_t{corners} + 1, 0);
    const auto smaller_end = [&](uint32_t corner) { return std::min(welded_[corner], welded_[next(corner)]); };
    const auto is_edge = [&](uint32_t corner) { return welded_[corner] != welded_[next(corner)]; };
    for (uint32_t corner = 0; corner < corners; ++corner) {
        if (is_edge(corner)) ++first[smaller_end(corner) + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Edge> edges(first.back());
    std::vector<uint32_t> fill(first.begin(), first.end() - 1);
    for (uint32_t corner = 0; corner < corners; ++corner) {
        if (!is_edge(corner)) continue;
        edges[fill[smaller_end(corner)]++] = {std::max(welded_[corner], welded_[next(corner)]), corner};
    }
    parallel_for_each(corners, corners_at_once,
                      [&](size_t end) { std::sort(edges.begin() + first[end], edges.begin() + first[end + 1]); });

    // Each edge is shared with the first one that runs the other way and is still free.
    std::vector<bool> taken(edges.size(), false);
    for (size_t i = 0; i < edges.size(); ++i) {
        if (taken[i]) continue;
        const size_t end = first[smaller_end(edges[i].corner) + 1];
        for (size_t k = i + 1; k < end && edges[k].other == edges[i].other; ++k) {
            const uint32_t a = edges[i].corner, b = edges[k].corner;
            if (taken[k] || welded_[a] == welded_[b]) continue;
            taken[i] = taken[k] = true;
            const Face &face_a = faces_[a / 3], &face_b = faces_[b / 3];
            const bool agree = face_a.keeps_orientation == face_b.keeps_orientation || face_a.any_orientation ||
                               face_b.any_orientation;
            if (agree) {
                join(a, next(b));
                join(next(a), b);
            }
            break;
        }
    }
}

void TangentBuilder::accumulate() {
    // The face's tangent and the edges at each corner, seen in the plane of the vertex normal.
    const size_t corners = welded_.size();
    std::vector<Vec3> shares(corners, Vec3(0));
    parallel_for_each(corners, corners_at_once, [&](size_t corner) {
        const Face& face = faces_[corner / 3];
        if (face.any_orientation) return;
        const Vec3 n = normal(corner);
        const auto flatten = [&](Vec3 v) {
            v -= glm::dot(n, v) * n;
            normalize_or_zero(v);
            return v;
        };
        const size_t first = corner - corner % 3;
        const Vec3 to_next = flatten(position(first + (corner + 1 - first) % 3) - position(corner));
        const Vec3 to_last = flatten(position(first + (corner + 2 - first) % 3) - position(corner));
        const float angle = std::acos(std::clamp(glm::dot(to_next, to_last), -1.0f, 1.0f));
        shares[corner] = angle * flatten(face.tangent);
    });
    std::vector<Vec3> sums(corners, Vec3(0));
    std::vector<int8_t> keeps(corners, -1);
    for (size_t corner = 0; corner < corners; ++corner) {
        const Face& face = faces_[corner / 3];
        if (face.any_orientation) continue;
        const uint32_t root = find(static_cast<uint32_t>(corner));
        sums[root] += shares[corner];
        keeps[root] = face.keeps_orientation ? 1 : 0;
    }
    shares = {};
    // Faces without a tangent of their own borrow from another group at the same vertex.
    std::vector<uint32_t> lender(corners, 0xffffffffu);
    std::vector<uint32_t> source(corners);
    for (uint32_t corner = 0; corner < corners; ++corner) {
        source[corner] = find(corner);
        if (keeps[source[corner]] >= 0 && lender[welded_[corner]] == 0xffffffffu)
            lender[welded_[corner]] = source[corner];
    }
    tangents_.resize(corners);
    parallel_for_each(corners, corners_at_once, [&](size_t corner) {
        uint32_t root = source[corner];
        if (keeps[root] < 0 && lender[welded_[corner]] != 0xffffffffu) root = lender[welded_[corner]];
        const Vec3 n = normal(corner);
        Vec3 t = sums[root] - glm::dot(n, sums[root]) * n;
        if (!normalize_or_zero(t)) {
            const Vec3 axis = std::abs(n.x) < 0.6f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
            t = axis - glm::dot(n, axis) * n;
            normalize_or_zero(t);
        }
        // glTF's v runs down the picture: a texture that keeps its orientation there is mirrored in MikkTSpace's sense.
        tangents_[corner] = Vec4(t, keeps[root] == 1 ? -1.0f : 1.0f);
    });
}

void TangentBuilder::write_back() {
    // Corners of one vertex that differ in their tangents get vertices of their own, in the order of the corners.
    constexpr uint32_t unset = 0xffffffffu;
    const size_t vertices = primitive_.positions.size();
    std::vector<uint32_t> first_corner(vertices, unset);
    std::unordered_map<uint64_t, uint32_t> split;  // (vertex, corner group) to the appended vertex
    std::vector<uint32_t> appended_from, appended_corner;
    primitive_.tangents.assign(vertices, Vec4(1, 0, 0, 1));
    for (uint32_t corner = 0; corner < tangents_.size(); ++corner) {
        const uint32_t v = vertex(corner);
        uint32_t& slot = primitive_.triangles[corner / 3][static_cast<int>(corner % 3)];
        if (first_corner[v] == unset) {
            first_corner[v] = corner;
            primitive_.tangents[v] = tangents_[corner];
        } else if (primitive_.tangents[v] != tangents_[corner]) {
            const uint64_t key = uint64_t{v} << 32 | find(corner);
            const auto [found, added] = split.try_emplace(key, static_cast<uint32_t>(vertices + appended_from.size()));
            if (added) {
                appended_from.push_back(v);
                appended_corner.push_back(corner);
            }
            slot = found->second;
        }
    }
    if (appended_from.empty()) return;

    // Their number is known: nothing grows further than it must.
    const auto append = [&](auto& values) {
        if (values.empty()) return;
        values.reserve(vertices + appended_from.size() + position_padding);
        for (const uint32_t from : appended_from)
            values.push_back(values[from]);
    };
    append(primitive_.positions);
    append(primitive_.normals);
    append(primitive_.uv[0]);
    append(primitive_.uv[1]);
    append(primitive_.colors);
    primitive_.tangents.reserve(vertices + appended_from.size());
    for (const uint32_t corner : appended_corner)
        primitive_.tangents.push_back(tangents_[corner]);
    if (primitive_.deformation) {
        std::vector<uint32_t> from(vertices);
        std::iota(from.begin(), from.end(), 0u);
        from.insert(from.end(), appended_from.begin(), appended_from.end());
        primitive_.deformation = std::make_shared<const Deformation>(gather_vertices(*primitive_.deformation, from));
    }
}

void TangentBuilder::run() {
    make_tangents();
    write_back();
}

void TangentBuilder::make_tangents() {
    make_faces();
    weld_corners();
    join_across_edges();
    accumulate();
}

std::vector<Vec3> TangentBuilder::mean_tangents() {
    make_tangents();
    std::vector<Vec3> out(primitive_.positions.size(), Vec3(0));
    for (size_t corner = 0; corner < tangents_.size(); ++corner)
        out[vertex(corner)] += Vec3(tangents_[corner]);
    for (Vec3& tangent : out)
        normalize_or_zero(tangent);
    return out;
}

template <typename Vector>
void add(std::vector<Vector>& values, const std::vector<Vector>& differences) {
    for (size_t i = 0; i < std::min(values.size(), differences.size()); ++i)
        values[i] += differences[i];
}

// What the tangents of the mesh become where the target has moved all the way, less what they are.
std::vector<Vec3> tangent_differences(const Primitive& primitive, const MorphTarget& target, uint32_t uv_set) {
    if (target.positions.empty() && target.normals.empty() && target.uv[uv_set].empty()) return {};
    Primitive moved;
    moved.positions = primitive.positions;
    moved.normals = primitive.normals;
    moved.uv[uv_set] = primitive.uv[uv_set];
    moved.triangles = primitive.triangles;
    add(moved.positions, target.positions);
    add(moved.normals, target.normals);
    add(moved.uv[uv_set], target.uv[uv_set]);
    for (size_t i = 0; i < moved.normals.size(); ++i) {
        if (!normalize_or_zero(moved.normals[i])) moved.normals[i] = primitive.normals[i];
    }
    std::vector<Vec3> out = TangentBuilder(moved, uv_set).mean_tangents();
    for (size_t i = 0; i < out.size(); ++i)
        out[i] = out[i] == Vec3(0) ? Vec3(0) : out[i] - Vec3(primitive.tangents[i]);
    return out;
}

}  // namespace

void generate_tangents(Primitive& primitive, uint32_t uv_set) {
    TangentBuilder(primitive, uv_set).run();
    if (!primitive.deformation || primitive.deformation->targets.empty()) return;
    auto deformation = std::make_shared<Deformation>(*primitive.deformation);
    for (MorphTarget& target : deformation->targets)
        target.tangents = tangent_differences(primitive, target, uv_set);
    primitive.deformation = std::move(deformation);
}

}  // namespace candela
