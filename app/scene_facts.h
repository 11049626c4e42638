// SPDX-License-Identifier: MIT
// What candela info says of a scene, as JSON whose keys are stable: scripts read them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "renderer/io/diagnostics.h"
#include "renderer/scene/scene.h"

namespace candela {

// scene, scenes, active_scene, variants, active_variant, counts, triangles, placed_triangles, strokes, vertex_bytes,
// estimated_bytes, bounds, nodes, meshes, cameras, lights, animations, skins, morph_targets, extensions, metadata,
// warnings.
nlohmann::ordered_json describe_scene(const Scene& scene, const Diagnostics& diagnostics);

}  // namespace candela
