// SPDX-License-Identifier: MIT
#include "renderer/io/draco.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

// Third-party headers: their warnings are not ours.
#include <draco/compression/decode.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

namespace candela {

struct DracoMesh::Impl {
    std::unique_ptr<draco::Mesh> mesh;
};

namespace {

void require(bool holds, const char* reason) {
    if (!holds) throw std::runtime_error(reason);
}

std::string clean(const char* text) {
    std::string out(text);
    for (char& c : out) {
        if (c == '\n' || c == '\r') c = ' ';
    }
    return out;
}

// The same type in glTF, which knows fewer.
std::optional<ComponentType> component_of(draco::DataType type) {
    switch (type) {
        case draco::DT_INT8:
            return ComponentType::i8;
        case draco::DT_UINT8:
        case draco::DT_BOOL:
            return ComponentType::u8;
        case draco::DT_INT16:
            return ComponentType::i16;
        case draco::DT_UINT16:
            return ComponentType::u16;
        case draco::DT_UINT32:
            return ComponentType::u32;
        case draco::DT_FLOAT32:
            return ComponentType::f32;
        default:
            return std::nullopt;
    }
}

template <typename T>
double load_as_double(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));
    return static_cast<double>(value);
}

double load_component(draco::DataType type, const std::byte* from) {
    switch (type) {
        case draco::DT_INT8:
            return load_as_double<int8_t>(from);
        case draco::DT_UINT8:
        case draco::DT_BOOL:
            return load_as_double<uint8_t>(from);
        case draco::DT_INT16:
            return load_as_double<int16_t>(from);
        case draco::DT_UINT16:
            return load_as_double<uint16_t>(from);
        case draco::DT_INT32:
            return load_as_double<int32_t>(from);
        case draco::DT_UINT32:
            return load_as_double<uint32_t>(from);
        case draco::DT_INT64:
            return load_as_double<int64_t>(from);
        case draco::DT_UINT64:
            return load_as_double<uint64_t>(from);
        case draco::DT_FLOAT32:
            return load_as_double<float>(from);
        case draco::DT_FLOAT64:
            return load_as_double<double>(from);
        default:
            throw std::runtime_error("has an attribute of a type that Draco does not know");
    }
}

// The largest value of an integer type; 0 for floating point.
double largest_of(draco::DataType type) {
    switch (type) {
        case draco::DT_INT8:
            return 127.0;
        case draco::DT_UINT8:
            return 255.0;
        case draco::DT_INT16:
            return 32767.0;
        case draco::DT_UINT16:
            return 65535.0;
        case draco::DT_INT32:
            return 2147483647.0;
        case draco::DT_UINT32:
            return 4294967295.0;
        default:
            return 0.0;
    }
}

template <typename T>
void store_rounded(double value, std::byte* to) {
    // A comparison that is false for NaN too.
    const bool fits = value >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
                      value <= static_cast<double>(std::numeric_limits<T>::max());
    require(fits, "holds values that the accessor's component type cannot");
    const T stored = static_cast<T>(std::llround(value));
    std::memcpy(to, &stored, sizeof(T));
}

void store_component(ComponentType type, double value, std::byte* to) {
    switch (type) {
        case ComponentType::i8:
            return store_rounded<int8_t>(value, to);
        case ComponentType::u8:
            return store_rounded<uint8_t>(value, to);
        case ComponentType::i16:
            return store_rounded<int16_t>(value, to);
        case ComponentType::u16:
            return store_rounded<uint16_t>(value, to);
        case ComponentType::u32:
            return store_rounded<uint32_t>(value, to);
        case ComponentType::f32: {
            const auto stored = static_cast<float>(value);
            std::memcpy(to, &stored, sizeof(stored));
            return;
        }
    }
}

double largest_of(ComponentType type) {
    switch (type) {
        case ComponentType::i8:
            return 127.0;
        case ComponentType::u8:
            return 255.0;
        case ComponentType::i16:
            return 32767.0;
        case ComponentType::u16:
            return 65535.0;
        default:
            return 0.0;
    }
}

// By how much a stored value is to be multiplied so that it means the same in the accessor's type: factors lie in
// [-1,1] where either side is normalized and the other is floating point.
double scale_between(const draco::PointAttribute& from, const AccessorLayout& to) {
    const double from_largest = largest_of(from.data_type());
    if (to.type == ComponentType::f32) return from.normalized() && from_largest > 0.0 ? 1.0 / from_largest : 1.0;
    return to.normalized && from_largest == 0.0 ? largest_of(to.type) : 1.0;
}

uint64_t read_count(draco::DecoderBuffer& buffer) {
    uint32_t count = 0;
    require(draco::DecodeVarint(&count, &buffer), "the compressed data ends too early");
    return count;
}

}  // namespace

// Draco bitstream specification 2.2, sections "Draco Decoder", "Sequential Decoder" and "EdgeBreaker Decoder".
DracoMesh::Counts DracoMesh::read_counts(std::span<const std::byte> encoded) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(encoded.data()), encoded.size());
    char magic[5];
    uint8_t major = 0, minor = 0, geometry = 0, method = 0;
    uint16_t flags = 0;
    const bool has_head = buffer.Decode(magic, sizeof(magic)) && buffer.Decode(&major) && buffer.Decode(&minor) &&
                          buffer.Decode(&geometry) && buffer.Decode(&method) && buffer.Decode(&flags);
    require(has_head && std::memcmp(magic, "DRACO", sizeof(magic)) == 0, "the compressed data is not Draco's");
    require(major == 2 && minor <= 2,
            "the compressed data is of a version of Draco that is not supported, only 2.0 to 2.2");
    require(geometry == draco::TRIANGULAR_MESH, "the compressed data is not a mesh of triangles");
    require(method <= 1, "the compressed data has an unknown encoding");
    buffer.set_bitstream_version(static_cast<uint16_t>((major << 8) | minor));
    constexpr uint16_t has_metadata = 0x8000;
    if ((flags & has_metadata) != 0) {
        draco::GeometryMetadata metadata;
        require(draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata), "its metadata is damaged");
    }
    Counts out;
    const bool sequential = method == 0;
    if (!sequential) {
        uint8_t traversal = 0;
        require(buffer.Decode(&traversal), "the compressed data ends too early");
    }
    const bool old = minor < 2;
    if (sequential && old) {
        uint32_t faces = 0, points = 0;
        require(buffer.Decode(&faces) && buffer.Decode(&points), "the compressed data ends too early");
        out = {points, faces};
    } else if (sequential) {
        out.faces = read_count(buffer);
        out.points = read_count(buffer);
    } else {
        // Before 2.2 a number of new vertices comes first. Points may outnumber vertices, at seams of attributes.
        if (old) read_count(buffer);
        out.points = read_count(buffer);
        out.faces = read_count(buffer);
    }
    return out;
}

DracoMesh::DracoMesh(std::span<const std::byte> encoded) : impl_(std::make_unique<Impl>()) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(encoded.data()), encoded.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
        throw std::runtime_error("the compressed data is damaged: " + clean(decoded.status().error_msg()));
    }
    impl_->mesh = std::move(decoded).value();
    require(impl_->mesh != nullptr, "the compressed data is damaged");
}

DracoMesh::~DracoMesh() = default;

uint64_t DracoMesh::point_count() const {
    return impl_->mesh->num_points();
}

uint64_t DracoMesh::face_count() const {
    return impl_->mesh->num_faces();
}

RawBytes DracoMesh::attribute(uint32_t unique_id, const AccessorLayout& accessor) const {
    const draco::PointAttribute* source = impl_->mesh->GetAttributeByUniqueId(unique_id);
    if (source == nullptr) {
        throw std::runtime_error("the compressed data has no attribute of id " + std::to_string(unique_id));
    }
    const uint32_t components = accessor.rows;
    require(accessor.columns == 1 && static_cast<uint32_t>(source->num_components()) == components,
            "the compressed data has another number of components");
    const auto type = source->data_type();
    const uint64_t source_component = static_cast<uint64_t>(draco::DataTypeLength(type));
    const uint64_t source_element = source_component * components;
    require(source->buffer() != nullptr && source_component > 0, "the compressed attribute has no data");

    // The library's own offsets are checked against the size of its buffer before anything is read from there.
    const auto stride = static_cast<uint64_t>(source->byte_stride());
    const auto offset = static_cast<uint64_t>(source->byte_offset());
    const uint64_t size = source->buffer()->data_size();
    const uint64_t points = point_count();
    const auto* bytes = reinterpret_cast<const std::byte*>(source->buffer()->data());
    const uint64_t out_component = component_bytes(accessor.type);
    const uint64_t out_element = packed_bytes(accessor);
    const bool copies = component_of(type) == accessor.type;
    const double scale = scale_between(*source, accessor);
    // Of so many values the data holds every byte.
    uint64_t values = 0;
    if (offset <= size && source_element <= size - offset && stride > 0)
        values = std::min<uint64_t>(source->size(), (size - offset - source_element) / stride + 1);
    const auto value_of = [&](uint64_t point) {
        const uint64_t value = source->mapped_index(draco::PointIndex(static_cast<uint32_t>(point))).value();
        require(value < values, "the compressed attribute reaches past its data");
        return bytes + offset + value * stride;
    };
    RawBytes out(points * out_element);
    // Copies are of a size that the compiler knows.
    const auto copy_all = [&](auto element) {
        for (uint64_t p = 0; p < points; ++p)
            std::memcpy(out.data() + p * element, value_of(p), element);
    };
    if (copies && source_element == 8) {
        copy_all(std::integral_constant<size_t, 8>());
    } else if (copies && source_element == 12) {
        copy_all(std::integral_constant<size_t, 12>());
    } else if (copies && source_element == 16) {
        copy_all(std::integral_constant<size_t, 16>());
    } else if (copies) {
        copy_all(source_element);
    } else {
        for (uint64_t p = 0; p < points; ++p) {
            const std::byte* from = value_of(p);
            for (uint32_t c = 0; c < components; ++c) {
                store_component(accessor.type, scale * load_component(type, from + c * source_component),
                                out.data() + p * out_element + c * out_component);
            }
        }
    }
    return out;
}

RawBytes DracoMesh::indices(const AccessorLayout& accessor) const {
    const draco::Mesh& mesh = *impl_->mesh;
    const uint64_t component = component_bytes(accessor.type);
    RawBytes out(uint64_t{mesh.num_faces()} * 3 * component);
    std::byte* to = out.data();
    const auto store = [&](uint32_t corner) {
        if (accessor.type != ComponentType::u32) return store_component(accessor.type, corner, to);
        std::memcpy(to, &corner, sizeof(corner));
    };
    for (uint32_t f = 0; f < mesh.num_faces(); ++f) {
        const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(f));
        for (size_t c = 0; c < 3; ++c, to += component) {
            require(face[c].value() < mesh.num_points(), "the compressed triangles name vertices that are not there");
            store(face[c].value());
        }
    }
    return out;
}

uint64_t draco_working_bytes(const DracoMesh::Counts& counts, uint64_t attribute_count) {
    // Corner table, traversal and seams of each attribute; values before and after their prediction is undone.
    constexpr uint64_t bytes_per_face = 96, bytes_per_face_and_attribute = 24, bytes_per_value = 48;
    return counts.faces * (bytes_per_face + bytes_per_face_and_attribute * attribute_count) +
           counts.points * bytes_per_value * (attribute_count + 1);
}

}  // namespace candela
