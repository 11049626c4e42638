// SPDX-License-Identifier: MIT
// KHR_draco_mesh_compression: the compressed triangles of one primitive to the bytes that its accessors stand for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "renderer/io/files.h"
#include "renderer/io/layout.h"

namespace candela {

// What a Draco stream holds, decoded. Throws std::runtime_error with the reason (one line, no file name) wherever the
// stream is damaged or is not what is asked of it.
class DracoMesh {
  public:
    // As the stream's head says, before anything is allocated for it.
    struct Counts {
        uint64_t points = 0, faces = 0;
    };
    static Counts read_counts(std::span<const std::byte> encoded);

    explicit DracoMesh(std::span<const std::byte> encoded);
    ~DracoMesh();
    DracoMesh(const DracoMesh&) = delete;
    DracoMesh& operator=(const DracoMesh&) = delete;

    uint64_t point_count() const;
    uint64_t face_count() const;
    // Elements of the attribute of that unique id, packed in the accessor's own component type; one per point.
    RawBytes attribute(uint32_t unique_id, const AccessorLayout& accessor) const;
    // Three corners per face, each below point_count(), packed in the accessor's own component type.
    RawBytes indices(const AccessorLayout& accessor) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// Bytes that decoding may need beside the result: the library's connectivity and its attributes.
uint64_t draco_working_bytes(const DracoMesh::Counts& counts, uint64_t attribute_count);

}  // namespace candela
