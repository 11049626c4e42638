// SPDX-License-Identifier: MIT
// Draco streams: what the loader asks of one, whatever it holds.
#include "renderer/io/draco.h"

#include <cstring>
#include <stdexcept>

#include "tests/fuzz/fuzz.h"

namespace {

using namespace candela;

void check_indices(const DracoMesh& mesh) {
    AccessorLayout scalar;
    scalar.type = ComponentType::u32;
    scalar.count = 3 * mesh.face_count();
    const RawBytes corners = mesh.indices(scalar);
    fuzz::require(corners.size() == scalar.count * sizeof(uint32_t), "each triangle has three corners");
    for (size_t i = 0; i < scalar.count; ++i) {
        uint32_t corner = 0;
        std::memcpy(&corner, corners.data() + i * sizeof corner, sizeof corner);
        fuzz::require(corner < mesh.point_count(), "corners are below the number of points");
    }
}

void check_attribute(const DracoMesh& mesh, uint32_t id, ComponentType type, uint32_t rows) {
    AccessorLayout accessor;
    accessor.type = type;
    accessor.rows = rows;
    accessor.count = mesh.point_count();
    try {
        fuzz::require(mesh.attribute(id, accessor).size() == accessor.count * rows * component_bytes(type),
                      "an attribute has an element for each point");
    } catch (const std::runtime_error&) {
        return;
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::span<const std::byte> stream = fuzz::bytes_of(data, size);
    try {
        // The loader compares the counts with those of the accessors before it decodes.
        const DracoMesh::Counts counts = DracoMesh::read_counts(stream);
        if (counts.points > 20000 || counts.faces > 20000) return 0;
        const DracoMesh mesh(stream);
        check_indices(mesh);
        for (uint32_t id = 0; id < 4; ++id) {
            check_attribute(mesh, id, ComponentType::f32, 3);
            check_attribute(mesh, id, ComponentType::f32, 2);
            check_attribute(mesh, id, ComponentType::u8, 4);
        }
    } catch (const std::runtime_error&) {
        return 0;
    }
    return 0;
}
