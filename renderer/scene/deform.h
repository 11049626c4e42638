// SPDX-License-Identifier: MIT
// Shapes that change: morph targets blend a mesh's vertices, joints of a skin carry them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "renderer/scene/scene.h"

namespace candela {

// Differences to the mesh as modelled; each array is empty (no difference) or as long as the primitive's positions.
struct MorphTarget {
    std::vector<Vec3> positions, normals, tangents;
    std::vector<Vec2> uv[2] = {};
    std::vector<Vec4> colors = {};
};

struct Deformation {
    std::vector<MorphTarget> targets;
    // Joints of the node's skin that carry a vertex, influences_per_vertex for each, and how much: weights sum to 1.
    // All 0: the vertex follows no joint and stays in the world where it is in the mesh. 0 influences: not skinned.
    uint32_t influences_per_vertex = 0;
    std::vector<uint16_t> joints;
    std::vector<float> weights;
    uint32_t joint_count = 0;  // 1 + the largest joint that carries anything
};

// With vertex i a copy of vertex from[i].
Deformation gather_vertices(const Deformation& deformation, std::span<const uint32_t> from);

// Everything that decides the shape of a mesh in a pose.
struct MeshPose {
    std::vector<float> morph_weights;
    bool skinned = false;
    std::vector<Mat4> world_from_joint;  // joint matrices: from the mesh, by the joint, to the world
    Mat4 world_from_mesh{1.0f};          // of a skinned mesh's primitives that no joint carries

    bool operator==(const MeshPose&) const = default;
    // The mesh as modelled.
    bool is_rest() const;
};

// Whether poses may change the shape of the mesh.
bool can_deform(const Mesh& mesh, bool skinned);

// The mesh in a pose; in world space if skinned. Nothing where a vertex would not be finite or lie beyond 1e9.
std::optional<Mesh> deform(const Mesh& mesh, const MeshPose& pose);

}  // namespace candela
