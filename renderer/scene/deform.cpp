// SPDX-License-Identifier: MIT
#include "renderer/scene/deform.h"

namespace candela {
namespace {

constexpr float farthest_m = 1e9f;  // as for meshes that do not deform

// Zero and what is not finite become the alternative.
Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
    const float length = glm::length(v);
    return length > 1e-20f && std::isfinite(length) ? v / length : otherwise;
}

// The cofactors of the linear part: its inverse transpose times its determinant, which exists for every matrix.
Mat3 cofactors(const Mat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

template <typename Vector>
void add_scaled(std::vector<Vector>& values, const std::vector<Vector>& deltas, float weight) {
    for (size_t i = 0; i < std::min(values.size(), deltas.size()); ++i)
        values[i] += weight * deltas[i];
}

void add_scaled(std::vector<Vec4>& values, const std::vector<Vec3>& deltas, float weight) {
    for (size_t i = 0; i < std::min(values.size(), deltas.size()); ++i)
        values[i] += Vec4(weight * deltas[i], 0.0f);
}

// Base + sum of weight times difference (glTF 2.0, section 3.7.2.2).
void morph(const Deformation& deformation, std::span<const float> weights, Primitive& out) {
    bool colors_move = false;
    for (size_t t = 0; t < std::min(weights.size(), deformation.targets.size()); ++t) {
        if (weights[t] == 0.0f) continue;
        add_scaled(out.positions, deformation.targets[t].positions, weights[t]);
        add_scaled(out.normals, deformation.targets[t].normals, weights[t]);
        add_scaled(out.tangents, deformation.targets[t].tangents, weights[t]);
        for (int set = 0; set < 2; ++set)
            add_scaled(out.uv[set], deformation.targets[t].uv[set], weights[t]);
        add_scaled(out.colors, deformation.targets[t].colors, weights[t]);
        colors_move = colors_move || !deformation.targets[t].colors.empty();
    }
    // Colours stay in their range (section 3.7.2.2).
    for (size_t i = 0; colors_move && i < out.colors.size(); ++i)
        out.colors[i] = glm::clamp(out.colors[i], 0.0f, 1.0f);
}

// Moves vertices by one affine map each, and turns over the triangles that the maps mirror: glTF wants their winding
// reversed.
class VertexMover {
  public:
    explicit VertexMover(Primitive& primitive) : primitive_(primitive) {}

    void move(size_t i, const Mat4& world_from_mesh) {
        const Mat3 linear(world_from_mesh);
        primitive_.positions[i] = Vec3(world_from_mesh * Vec4(primitive_.positions[i], 1.0f));
        const Mat3 normal_map = cofactors(linear);
        const bool mirrors = glm::dot(linear[0], normal_map[0]) < 0.0f;
        if (mirrors && mirrored_.empty()) mirrored_.resize(primitive_.positions.size(), 0);
        if (mirrors) mirrored_[i] = 1;
        if (!primitive_.normals.empty())
            primitive_.normals[i] = (mirrors ? -normal_map : normal_map) * primitive_.normals[i];
        if (!primitive_.tangents.empty()) {
            const Vec4& tangent = primitive_.tangents[i];
            primitive_.tangents[i] = Vec4(linear * Vec3(tangent), mirrors ? -tangent.w : tangent.w);
        }
    }

    void turn_mirrored_triangles() {
        if (mirrored_.empty()) return;
        for (Vec3u& t : primitive_.triangles) {
            if (mirrored_[t.x] + mirrored_[t.y] + mirrored_[t.z] >= 2) std::swap(t.y, t.z);
        }
    }

  private:
    Primitive& primitive_;
    std::vector<uint8_t> mirrored_;
};

// Each vertex by the weighted sum of its joints' matrices (glTF 2.0, section 3.7.3.3).
void skin(const Deformation& deformation, std::span<const Mat4> world_from_joint, Primitive& out) {
    VertexMover mover(out);
    const size_t influences = deformation.influences_per_vertex;
    for (size_t i = 0; i < out.positions.size(); ++i) {
        Mat4 blended(0.0f);
        for (size_t k = i * influences; k < (i + 1) * influences; ++k) {
            if (deformation.weights[k] != 0.0f)
                blended += deformation.weights[k] * world_from_joint[deformation.joints[k]];
        }
        // Without weights the vertex follows no joint.
        if (blended[3][3] == 0.0f) continue;
        mover.move(i, blended);
    }
    mover.turn_mirrored_triangles();
}

void move_all(const Mat4& world_from_mesh, Primitive& out) {
    VertexMover mover(out);
    for (size_t i = 0; i < out.positions.size(); ++i)
        mover.move(i, world_from_mesh);
    mover.turn_mirrored_triangles();
}

// Sums of large differences may leave the range of floats: such values stay as modelled.
template <typename Vector>
void keep_finite(const std::vector<Vector>& source, std::vector<Vector>& values) {
    for (size_t i = 0; i < values.size(); ++i) {
        if (glm::any(glm::isnan(values[i])) || glm::any(glm::isinf(values[i]))) values[i] = source[i];
    }
}

// Normals and tangents of unit length; false where a position is out of bounds.
bool finish(const Primitive& source, Primitive& out) {
    for (size_t i = 0; i < out.normals.size(); ++i)
        out.normals[i] = unit_or(out.normals[i], source.normals[i]);
    for (size_t i = 0; i < out.tangents.size(); ++i)
        out.tangents[i] = Vec4(unit_or(Vec3(out.tangents[i]), Vec3(source.tangents[i])), out.tangents[i].w);
    for (int set = 0; set < 2; ++set)
        keep_finite(source.uv[set], out.uv[set]);
    keep_finite(source.colors, out.colors);
    return std::all_of(out.positions.begin(), out.positions.end(), [](const Vec3& p) {
        return std::abs(p.x) <= farthest_m && std::abs(p.y) <= farthest_m && std::abs(p.z) <= farthest_m;
    });
}

template <typename T>
std::vector<T> gather(const std::vector<T>& values, std::span<const uint32_t> from, size_t each = 1) {
    std::vector<T> out;
    if (values.empty()) return out;
    out.reserve(from.size() * each);
    for (const uint32_t i : from) {
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(i * each);
        out.insert(out.end(), first, first + static_cast<std::ptrdiff_t>(each));
    }
    return out;
}

}  // namespace

Deformation gather_vertices(const Deformation& deformation, std::span<const uint32_t> from) {
    Deformation out;
    out.targets.reserve(deformation.targets.size());
    for (const MorphTarget& target : deformation.targets) {
        out.targets.push_back({gather(target.positions, from),
                               gather(target.normals, from),
                               gather(target.tangents, from),
                               {gather(target.uv[0], from), gather(target.uv[1], from)},
                               gather(target.colors, from)});
    }
    out.influences_per_vertex = deformation.influences_per_vertex;
    out.joints = gather(deformation.joints, from, deformation.influences_per_vertex);
    out.weights = gather(deformation.weights, from, deformation.influences_per_vertex);
    out.joint_count = deformation.joint_count;
    return out;
}

bool MeshPose::is_rest() const {
    return !skinned && std::all_of(morph_weights.begin(), morph_weights.end(), [](float w) { return w == 0.0f; });
}

bool can_deform(const Mesh& mesh, bool skinned) {
    return skinned || std::any_of(mesh.primitives.begin(), mesh.primitives.end(), [](const Primitive& primitive) {
               return primitive.deformation && !primitive.deformation->targets.empty();
           });
}

std::optional<Mesh> deform(const Mesh& mesh, const MeshPose& pose) {
    Mesh out = mesh;
    for (size_t p = 0; p < out.primitives.size(); ++p) {
        Primitive& primitive = out.primitives[p];
        const Deformation* deformation = mesh.primitives[p].deformation.get();
        primitive.deformation = nullptr;
        if (deformation != nullptr) morph(*deformation, pose.morph_weights, primitive);
        if (pose.skinned && deformation != nullptr && deformation->influences_per_vertex > 0) {
            skin(*deformation, pose.world_from_joint, primitive);
        } else if (pose.skinned) {
            move_all(pose.world_from_mesh, primitive);
        }
        if (!finish(mesh.primitives[p], primitive)) return std::nullopt;
    }
    return out;
}

}  // namespace candela
