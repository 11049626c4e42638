// SPDX-License-Identifier: MIT
// The node tree of a file, and what its active scene places: instances, lights, cameras.
#pragma once

#include "renderer/io/load_context.h"

namespace tinygltf {
class Model;
}

namespace candela {

// Fills scene.nodes, scene_names and active_scene. Throws LoadError for cycles, for nodes with two parents, for
// transforms that are not finite, and where options.scene names a scene that the file has not.
void load_nodes(LoadContext& context, const tinygltf::Model& model, Scene& scene);

// Walks the active scene and fills instances, light_instances and cameras. Needs scene.meshes, lights and nodes.
void place_nodes(LoadContext& context, const tinygltf::Model& model, Scene& scene);

// Fills scene.lights.
void load_lights(LoadContext& context, const tinygltf::Model& model, Scene& scene);

// The camera of the file as seen from world_from_node, whose scale does not matter to it. Throws LoadError for angles
// and sizes that make no picture.
Camera make_camera(LoadContext& context, const tinygltf::Model& model, uint32_t index, const Mat4& world_from_node);

}  // namespace candela
