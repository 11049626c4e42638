// SPDX-License-Identifier: MIT
// Which mesh lies under which tree of the accelerator, and what of it a world of another pose has ready.
#pragma once

#include <map>

#include "renderer/world/opacity_scan.h"
#include "renderer/world/placement.h"

namespace candela {

class ShapeTable {
  public:
    // Fills world.fixed and world.shapes. before: null for a first world.
    ShapeTable(World& world, const World* before);

    struct Place {
        const MeshVertices* vertices = nullptr;
        uint32_t shape = invalid_index;  // in world.shapes; invalid: in world.fixed
    };
    // Of an instance with a usable transform.
    Place place(const Instance& instance, TransformKind kind);
    // Meshes that no instance shows in this pose wait with their trees for another.
    void keep_hidden();
    // Sets fixed and shapes of the input.
    void describe(AccelInput& input) const;

  private:
    using Vertices = std::shared_ptr<const MeshVertices>;

    uint32_t add_shape(const Instance& instance);
    uint32_t add_flat_shape(const Instance& instance);
    Vertices add_fixed(const Instance& instance);
    Vertices rest_of(const Instance& instance, const MeshVertices& pose);
    void append_opacity(const Mesh& mesh, WorldShape& shape);
    // The shape of `before` whose tree serves for this one too.
    const WorldShape* ready(const WorldShape& shape) const;

    World& world_;
    const World* before_;
    OpacityScan opacity_;
    std::vector<uint32_t> uses_;                  // of each mesh, in all poses
    std::map<const Mesh*, uint32_t> shapes_;      // of meshes as modelled
    std::map<const Mesh*, uint32_t> old_shapes_;  // in before
    std::map<const Mesh*, Vertices> rests_;
};

}  // namespace candela
