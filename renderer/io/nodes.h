// SPDX-License-Identifier: MIT
// The node tree of a file, its cameras and its lights.
#pragma once

#include "renderer/io/load_context.h"

namespace tinygltf {
class Model;
}

namespace candela {

// Fills scene.nodes, roots, scene_names and active_scene. Throws LoadError for cycles, for nodes with two parents, for
// transforms that are not finite, and where options.scene names a scene that the file has not.
void load_nodes(LoadContext& context, const tinygltf::Model& model, Scene& scene);

// Fills scene.lights.
void load_lights(LoadContext& context, const tinygltf::Model& model, Scene& scene);

// Fills scene.file_cameras; those that no node uses stay as they are by default. Needs scene.nodes. Throws LoadError
// for angles and sizes that make no picture.
void load_cameras(LoadContext& context, const tinygltf::Model& model, Scene& scene);

}  // namespace candela
