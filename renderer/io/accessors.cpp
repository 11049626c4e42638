// SPDX-License-Identifier: MIT
#include "renderer/io/accessors.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include <glm/gtc/type_ptr.hpp>

#include "renderer/scene/scene.h"

namespace candela {

// Buffers are little-endian; the elements are read as they lie.
static_assert(std::endian::native == std::endian::little);

namespace {

template <typename T>
T load(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));
    return value;
}

// glTF 2.0, section 3.6.2.2: c / max for unsigned, max(c / max, -1) for signed.
template <typename T, bool normalized>
float to_float(T value) {
    if constexpr (std::is_floating_point_v<T> || !normalized) {
        return static_cast<float>(value);
    } else {
        constexpr float largest = static_cast<float>(std::numeric_limits<T>::max());
        return std::max(static_cast<float>(value) / largest, -1.0f);
    }
}

// Columns of matrices begin at multiples of four bytes.
struct Shape {
    uint32_t rows, columns;
    uint64_t column_stride;
};

template <typename T, bool normalized>
void convert(const std::byte* from, uint64_t stride, uint64_t count, const Shape& shape, float* out) {
    for (uint64_t i = 0; i < count; ++i, from += stride) {
        for (uint32_t c = 0; c < shape.columns; ++c) {
            const std::byte* column = from + c * shape.column_stride;
            for (uint32_t r = 0; r < shape.rows; ++r)
                *out++ = to_float<T, normalized>(load<T>(column + r * sizeof(T)));
        }
    }
}

template <bool normalized>
void convert_any(ComponentType type, const std::byte* from, uint64_t stride, uint64_t count, const Shape& shape,
                 float* out) {
    switch (type) {
        case ComponentType::i8:
            return convert<int8_t, normalized>(from, stride, count, shape, out);
        case ComponentType::u8:
            return convert<uint8_t, normalized>(from, stride, count, shape, out);
        case ComponentType::i16:
            return convert<int16_t, normalized>(from, stride, count, shape, out);
        case ComponentType::u16:
            return convert<uint16_t, normalized>(from, stride, count, shape, out);
        case ComponentType::u32:
            return convert<uint32_t, normalized>(from, stride, count, shape, out);
        case ComponentType::f32:
            return convert<float, normalized>(from, stride, count, shape, out);
    }
}

void convert_elements(const AccessorLayout& accessor, bool normalized, const std::byte* from, uint64_t stride,
                      uint64_t count, float* out) {
    const uint64_t column = accessor.rows * component_bytes(accessor.type);
    const Shape shape{accessor.rows, accessor.columns, accessor.columns == 1 ? column : (column + 3) / 4 * 4};
    const uint64_t element = element_bytes(accessor);
    if (accessor.type == ComponentType::f32 && stride == element) {
        std::memcpy(out, from, count * element);
    } else if (normalized) {
        convert_any<true>(accessor.type, from, stride, count, shape, out);
    } else {
        convert_any<false>(accessor.type, from, stride, count, shape, out);
    }
}

uint32_t load_index(ComponentType type, const std::byte* from) {
    switch (type) {
        case ComponentType::u8:
            return load<uint8_t>(from);
        case ComponentType::u16:
            return load<uint16_t>(from);
        default:
            return load<uint32_t>(from);
    }
}

template <typename T>
void widen(const std::byte* from, uint64_t stride, uint64_t count, uint32_t* out) {
    for (uint64_t i = 0; i < count; ++i, from += stride)
        out[i] = load<T>(from);
}

}  // namespace

AccessorReader::Source AccessorReader::source_of(uint32_t index) {
    const AccessorLayout& accessor = layout(index);
    const auto replaced = replaced_.find(index);
    if (replaced != replaced_.end()) return {replaced->second.data(), packed_bytes(accessor)};
    if (!accessor.view) return {};
    return {buffers_.view(*accessor.view).data() + accessor.byte_offset, accessor.stride};
}

void AccessorReader::decode_early(const std::vector<uint32_t>& accessors) {
    std::set<uint32_t> views;
    for (const uint32_t accessor : accessors) {
        const std::optional<uint32_t> view = layout(accessor).view;
        if (view && layout_.views[*view].compressed) views.insert(*view);
    }
    if (views.size() > 1) buffers_.decode_early(views);
}

std::vector<uint64_t> AccessorReader::read_sparse_positions(uint32_t index) {
    const AccessorLayout& accessor = layout(index);
    const SparseLayout& sparse = *accessor.sparse;
    const std::string where = pointer_to("/accessors", index, "sparse");
    context_.charge(sparse.count, sizeof(uint64_t), where);
    const std::byte* from = buffers_.view(sparse.indices_view).data() + sparse.indices_offset;
    std::vector<uint64_t> positions(sparse.count);
    for (uint64_t i = 0; i < sparse.count; ++i) {
        positions[i] = load_index(sparse.index_type, from + i * component_bytes(sparse.index_type));
        if (positions[i] >= accessor.count) {
            context_.fail(where + "/indices", "index " + std::to_string(positions[i]) + " is not below the count of " +
                                                  std::to_string(accessor.count));
        }
    }
    context_.release(sparse.count * sizeof(uint64_t));
    return positions;
}

template <typename Element>
std::vector<Element> AccessorReader::read_floats(uint32_t index, uint32_t rows, uint32_t columns, const char* type,
                                                 const std::string& where, bool always_normalized) {
    const AccessorLayout& accessor = layout(index);
    if (accessor.rows != rows || accessor.columns != columns) {
        context_.fail(where, pointer_to("/accessors", index) + " is not of type " + type);
    }
    static_assert(sizeof(Element) % sizeof(float) == 0);
    // NOLINTNEXTLINE(bugprone-sizeof-expression): Element may be float itself.
    constexpr uint64_t floats_each = sizeof(Element) / sizeof(float);
    const bool normalized = accessor.normalized || always_normalized;
    context_.charge(accessor.count, sizeof(Element), pointer_to("/accessors", index, "count"));
    std::vector<Element> elements;
    if constexpr (std::is_same_v<Element, Vec3>) elements.reserve(accessor.count + position_padding);
    elements.resize(accessor.count, Element(0.0f));
    auto* out = reinterpret_cast<float*>(elements.data());
    if (const Source source = source_of(index); source.first != nullptr) {
        convert_elements(accessor, normalized, source.first, source.stride, accessor.count, out);
    }
    if (accessor.sparse) {
        const std::vector<uint64_t> positions = read_sparse_positions(index);
        const std::byte* from = buffers_.view(accessor.sparse->values_view).data() + accessor.sparse->values_offset;
        const uint64_t stride = packed_bytes(accessor);
        for (uint64_t i = 0; i < positions.size(); ++i) {
            convert_elements(accessor, normalized, from + i * stride, stride, 1, out + positions[i] * floats_each);
        }
    }
    return elements;
}

std::vector<float> AccessorReader::read_scalars(uint32_t accessor, const std::string& where) {
    return read_floats<float>(accessor, 1, 1, "SCALAR", where);
}

std::vector<Vec2> AccessorReader::read_vec2(uint32_t accessor, const std::string& where) {
    return read_floats<Vec2>(accessor, 2, 1, "VEC2", where);
}

std::vector<Vec3> AccessorReader::read_vec3(uint32_t accessor, const std::string& where) {
    return read_floats<Vec3>(accessor, 3, 1, "VEC3", where);
}

std::vector<Vec4> AccessorReader::read_vec4(uint32_t accessor, const std::string& where) {
    return read_floats<Vec4>(accessor, 4, 1, "VEC4", where);
}

std::vector<Mat4> AccessorReader::read_mat4(uint32_t accessor, const std::string& where) {
    return read_floats<Mat4>(accessor, 4, 4, "MAT4", where);
}

std::vector<Vec4> AccessorReader::read_colors(uint32_t accessor, const std::string& where) {
    if (layout(accessor).rows == 4) return read_floats<Vec4>(accessor, 4, 1, "VEC3 or VEC4", where, true);
    const std::vector<Vec3> rgb = read_floats<Vec3>(accessor, 3, 1, "VEC3 or VEC4", where, true);
    context_.charge(rgb.size(), sizeof(Vec4) - sizeof(Vec3), pointer_to("/accessors", accessor, "count"));
    std::vector<Vec4> rgba(rgb.size());
    std::transform(rgb.begin(), rgb.end(), rgba.begin(), [](const Vec3& color) { return Vec4(color, 1.0f); });
    return rgba;
}

std::vector<uint32_t> AccessorReader::read_indices(uint32_t index, const std::string& where) {
    const AccessorLayout& accessor = layout(index);
    const bool is_unsigned = accessor.type == ComponentType::u8 || accessor.type == ComponentType::u16 ||
                             accessor.type == ComponentType::u32;
    if (accessor.components() != 1 || !is_unsigned) {
        context_.fail(where, pointer_to("/accessors", index) + " is not of unsigned integer SCALARs");
    }
    context_.charge(accessor.count, sizeof(uint32_t), pointer_to("/accessors", index, "count"));
    std::vector<uint32_t> indices(accessor.count, 0);
    if (const Source source = source_of(index); source.first != nullptr) {
        switch (accessor.type) {
            case ComponentType::u8:
                widen<uint8_t>(source.first, source.stride, accessor.count, indices.data());
                break;
            case ComponentType::u16:
                widen<uint16_t>(source.first, source.stride, accessor.count, indices.data());
                break;
            default:
                widen<uint32_t>(source.first, source.stride, accessor.count, indices.data());
                break;
        }
    }
    if (accessor.sparse) {
        const std::vector<uint64_t> positions = read_sparse_positions(index);
        const std::byte* from = buffers_.view(accessor.sparse->values_view).data() + accessor.sparse->values_offset;
        for (uint64_t i = 0; i < positions.size(); ++i)
            indices[positions[i]] = load_index(accessor.type, from + i * component_bytes(accessor.type));
    }
    return indices;
}

}  // namespace candela
