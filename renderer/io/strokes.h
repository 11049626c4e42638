// SPDX-License-Identifier: MIT
// Points and lines as rays can hit them: points become small spheres, lines round tubes with spheres at their ends.
#pragma once

#include "renderer/io/load_context.h"

namespace candela {

// How thick points and lines are: this fraction of the diagonal of the box around all that the active scene places,
// less where there are so many that they would hide each other (see stroke_width).
inline constexpr float stroke_width_per_diagonal = 1.0f / 500.0f;

// count: points, ends and segments together. Above 15 625 the width falls with the square root of the count.
float stroke_width(float scene_diagonal, uint64_t count);

// Replaces the degenerate triangles by which assemble_triangles names points and segments with bodies made of
// triangles, the coarser the more there are. All that a vertex carries goes to the vertices of its body; normals are
// those of spheres and tubes. A mesh that is placed in several sizes has the width where it is largest, and a
// warning says so. Fills scene.strokes; needs the scene's nodes. Throws LoadError where the memory limit does not allow
// the bodies.
void give_strokes_bodies(LoadContext& context, Scene& scene, std::vector<Mesh>& meshes);

}  // namespace candela
