// SPDX-License-Identifier: MIT
// Where a document says its bytes lie: buffers, views, accessors and images, as plain values whose ranges are checked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/io/json_document.h"
#include "renderer/io/meshopt.h"

namespace candela {

enum class ComponentType : uint8_t { i8, u8, i16, u16, u32, f32 };

inline constexpr uint64_t component_bytes(ComponentType type) {
    switch (type) {
        case ComponentType::i8:
        case ComponentType::u8:
            return 1;
        case ComponentType::i16:
        case ComponentType::u16:
            return 2;
        default:
            return 4;
    }
}

struct BufferLayout {
    std::optional<std::string> uri;
    uint64_t byte_length = 0;
    bool needed = true;  // false: only a fallback for compressed views, never read
};

struct CompressedLayout {
    const char* extension = "";  // EXT_ or KHR_meshopt_compression
    uint32_t buffer = 0;
    uint64_t byte_offset = 0, byte_length = 0;
    uint64_t count = 0, stride = 0;
    MeshoptMode mode = MeshoptMode::attributes;
    MeshoptFilter filter = MeshoptFilter::none;
};

struct ViewLayout {
    uint32_t buffer = 0;
    uint64_t byte_offset = 0, byte_length = 0;
    uint64_t byte_stride = 0;  // 0: elements are packed
    std::optional<CompressedLayout> compressed;
};

struct SparseLayout {
    uint64_t count = 0;
    uint32_t indices_view = 0, values_view = 0;
    uint64_t indices_offset = 0, values_offset = 0;
    ComponentType index_type = ComponentType::u16;
};

struct AccessorLayout {
    std::optional<uint32_t> view;  // none: zeros
    uint64_t byte_offset = 0;
    ComponentType type = ComponentType::f32;
    uint32_t rows = 1, columns = 1;  // VEC3: 3 × 1
    bool normalized = false;
    uint64_t count = 0;
    uint64_t stride = 0;  // bytes from one element to the next in its view
    std::optional<SparseLayout> sparse;

    uint32_t components() const { return rows * columns; }
};

struct ImageLayout {
    std::string name;
    std::optional<std::string> uri;
    std::optional<uint32_t> view;
};

struct Layout {
    std::vector<BufferLayout> buffers;
    std::vector<ViewLayout> views;
    std::vector<AccessorLayout> accessors;
    std::vector<ImageLayout> images;
};

// Bytes of one element, columns of matrices padded to four bytes as glTF has them.
uint64_t element_bytes(const AccessorLayout& accessor);
uint64_t packed_bytes(const AccessorLayout& accessor);

// Needs a validated document. Throws LoadError unless every view lies in its buffer and every accessor in its views.
Layout read_layout(LoadContext& context, const Json& document);

}  // namespace candela
