// SPDX-License-Identifier: MIT
// EXT_ and KHR_meshopt_compression: one compressed buffer view to the bytes that accessors read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/io/files.h"

namespace candela {

enum class MeshoptMode : uint8_t { attributes, triangles, indices };
enum class MeshoptFilter : uint8_t { none, octahedral, quaternion, exponential, color };

struct MeshoptView {
    std::span<const std::byte> encoded;  // in range of its buffer; the content is not to be trusted
    uint64_t count = 0;                  // elements
    uint64_t stride = 0;                 // bytes of a decoded element
    MeshoptMode mode = MeshoptMode::attributes;
    MeshoptFilter filter = MeshoptFilter::none;
};

// Returns count · stride bytes. Throws std::runtime_error with the reason (one line, no file name) when stride or count
// do not fit the mode or the filter, or the stream is damaged. The caller has bounded count · stride by its memory
// limit.
RawBytes decode_meshopt(const MeshoptView& view);

}  // namespace candela
