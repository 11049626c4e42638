// SPDX-License-Identifier: MIT
#include "renderer/io/layout.h"

#include <nlohmann/json.hpp>

namespace candela {
namespace {

// The second adds a filter and a version of the stream to the first.
constexpr const char* meshopt_names[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

// Validated members: present ones have the right type.
uint64_t integer(const Json& object, const char* member, uint64_t otherwise = 0) {
    const auto found = object.find(member);
    return found == object.end() ? otherwise : found->get<uint64_t>();
}

std::optional<std::string> text(const Json& object, const char* member) {
    const auto found = object.find(member);
    if (found == object.end()) return std::nullopt;
    return found->get<std::string>();
}

std::optional<uint32_t> index(const Json& object, const char* member) {
    const auto found = object.find(member);
    if (found == object.end()) return std::nullopt;
    return found->get<uint32_t>();
}

const Json* extension(const Json& object, const char* name) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end()) return nullptr;
    const auto found = extensions->find(name);
    return found == extensions->end() ? nullptr : &*found;
}

const Json& array(const Json& document, const char* name) {
    static const Json none = Json::array();
    const auto found = document.find(name);
    return found == document.end() ? none : *found;
}

ComponentType component_type(LoadContext& context, const Json& object, const std::string& where) {
    const uint64_t code = integer(object, "componentType");
    switch (code) {
        case 5120:
            return ComponentType::i8;
        case 5121:
            return ComponentType::u8;
        case 5122:
            return ComponentType::i16;
        case 5123:
            return ComponentType::u16;
        case 5125:
            return ComponentType::u32;
        case 5126:
            return ComponentType::f32;
        default:
            context.fail(where + "/componentType", std::to_string(code) + " is not a component type of glTF");
    }
}

// offset + length <= size, without overflow.
bool in_range(uint64_t offset, uint64_t length, uint64_t size) {
    return offset <= size && length <= size - offset;
}

std::string outside(const std::string& what, uint64_t offset, uint64_t length, const std::string& of, uint64_t size) {
    return what + " at offset " + std::to_string(offset) + " of " + std::to_string(length) +
           " bytes reaches past the end of " + of + ", which has " + std::to_string(size) + " bytes";
}

CompressedLayout read_compressed(LoadContext& context, const Json& object, const char* name, const std::string& where) {
    CompressedLayout out;
    out.extension = name;
    out.buffer = *index(object, "buffer");
    out.byte_offset = integer(object, "byteOffset");
    out.byte_length = integer(object, "byteLength");
    out.count = integer(object, "count");
    out.stride = integer(object, "byteStride");
    const std::string mode = *text(object, "mode");
    if (mode == "ATTRIBUTES") {
        out.mode = MeshoptMode::attributes;
    } else if (mode == "TRIANGLES") {
        out.mode = MeshoptMode::triangles;
    } else if (mode == "INDICES") {
        out.mode = MeshoptMode::indices;
    } else {
        context.fail(where + "/mode", "\"" + mode + "\" is not a mode of " + name);
    }
    const std::string filter = text(object, "filter").value_or("NONE");
    if (filter == "NONE") {
        out.filter = MeshoptFilter::none;
    } else if (filter == "OCTAHEDRAL") {
        out.filter = MeshoptFilter::octahedral;
    } else if (filter == "QUATERNION") {
        out.filter = MeshoptFilter::quaternion;
    } else if (filter == "EXPONENTIAL") {
        out.filter = MeshoptFilter::exponential;
    } else if (filter == "COLOR" && std::string_view(name) == meshopt_names[1]) {
        out.filter = MeshoptFilter::color;
    } else {
        context.fail(where + "/filter", "\"" + filter + "\" is not a filter of " + name);
    }
    return out;
}

void read_buffers(const Json& document, Layout& layout) {
    for (const Json& object : array(document, "buffers")) {
        BufferLayout& buffer = layout.buffers.emplace_back();
        buffer.uri = text(object, "uri");
        buffer.byte_length = integer(object, "byteLength");
        for (const char* name : meshopt_names) {
            const Json* meshopt = extension(object, name);
            if (meshopt == nullptr) continue;
            const auto fallback = meshopt->find("fallback");
            if (fallback != meshopt->end() && fallback->get<bool>()) buffer.needed = false;
        }
    }
}

void read_views(LoadContext& context, const Json& document, Layout& layout) {
    const Json& views = array(document, "bufferViews");
    // A buffer that only stands in for compressed views is a fallback, declared or not.
    std::vector<uint8_t> read_plainly(layout.buffers.size(), 0), stands_in(layout.buffers.size(), 0);
    for (size_t i = 0; i < views.size(); ++i) {
        const Json& object = views[i];
        const std::string where = pointer_to("/bufferViews", i);
        ViewLayout& view = layout.views.emplace_back();
        view.buffer = *index(object, "buffer");
        view.byte_offset = integer(object, "byteOffset");
        view.byte_length = integer(object, "byteLength");
        view.byte_stride = integer(object, "byteStride");
        const uint64_t buffer_bytes = layout.buffers[view.buffer].byte_length;
        if (!in_range(view.byte_offset, view.byte_length, buffer_bytes)) {
            context.fail(where + "/byteLength", outside("a view", view.byte_offset, view.byte_length,
                                                        pointer_to("/buffers", view.buffer), buffer_bytes));
        }
        const char* name = meshopt_names[extension(object, meshopt_names[1]) != nullptr ? 1 : 0];
        const Json* meshopt = extension(object, name);
        (meshopt == nullptr ? read_plainly : stands_in)[view.buffer] = 1;
        if (meshopt == nullptr) continue;

        const std::string place = where + "/extensions/" + name;
        CompressedLayout compressed = read_compressed(context, *meshopt, name, place);
        const uint64_t source_bytes = layout.buffers[compressed.buffer].byte_length;
        if (!in_range(compressed.byte_offset, compressed.byte_length, source_bytes)) {
            context.fail(place + "/byteLength",
                         outside("compressed data", compressed.byte_offset, compressed.byte_length,
                                 pointer_to("/buffers", compressed.buffer), source_bytes));
        }
        if (compressed.count > view.byte_length / compressed.stride ||
            compressed.count * compressed.stride != view.byte_length) {
            context.fail(place + "/count", "count times byteStride differs from the view's byteLength");
        }
        read_plainly[compressed.buffer] = 1;
        view.compressed = compressed;
    }
    for (size_t b = 0; b < layout.buffers.size(); ++b) {
        if (read_plainly[b] != 0) {
            layout.buffers[b].needed = true;
        } else if (stands_in[b] != 0) {
            layout.buffers[b].needed = false;
        }
    }
}

void read_type(LoadContext& context, const Json& object, const std::string& where, AccessorLayout& out) {
    struct Shape {
        std::string_view name;
        uint32_t rows, columns;
    };
    constexpr Shape shapes[] = {{"SCALAR", 1, 1}, {"VEC2", 2, 1}, {"VEC3", 3, 1}, {"VEC4", 4, 1},
                                {"MAT2", 2, 2},   {"MAT3", 3, 3}, {"MAT4", 4, 4}};
    const std::string type = *text(object, "type");
    for (const Shape& shape : shapes) {
        if (shape.name == type) {
            out.rows = shape.rows;
            out.columns = shape.columns;
            return;
        }
    }
    context.fail(where + "/type", "\"" + type + "\" is not an accessor type of glTF");
}

// count elements of element_size bytes, stride bytes apart, from offset on, within the view.
void check_reach(LoadContext& context, const Layout& layout, uint32_t view, uint64_t offset, uint64_t count,
                 uint64_t stride, uint64_t element_size, const std::string& where, const char* count_member) {
    const uint64_t size = layout.views[view].byte_length;
    const bool first_fits = in_range(offset, element_size, size);
    if (first_fits && (count - 1) <= (size - offset - element_size) / stride) return;
    context.fail(where + count_member, std::to_string(count) + " elements of " + std::to_string(stride) +
                                           " bytes from offset " + std::to_string(offset) +
                                           " on reach past the end of " + pointer_to("/bufferViews", view) +
                                           ", which has " + std::to_string(size) + " bytes");
}

void read_sparse(LoadContext& context, const Json& object, const std::string& where, const Layout& layout,
                 AccessorLayout& accessor) {
    SparseLayout sparse;
    sparse.count = integer(object, "count");
    if (sparse.count > accessor.count) context.fail(where + "/count", "is more than the accessor's own count");
    const Json& indices = object["indices"];
    const Json& values = object["values"];
    sparse.indices_view = *index(indices, "bufferView");
    sparse.indices_offset = integer(indices, "byteOffset");
    sparse.index_type = component_type(context, indices, where + "/indices");
    sparse.values_view = *index(values, "bufferView");
    sparse.values_offset = integer(values, "byteOffset");
    if (sparse.index_type != ComponentType::u8 && sparse.index_type != ComponentType::u16 &&
        sparse.index_type != ComponentType::u32) {
        context.fail(where + "/indices/componentType", "sparse indices must be unsigned integers");
    }
    const uint64_t index_bytes = component_bytes(sparse.index_type);
    check_reach(context, layout, sparse.indices_view, sparse.indices_offset, sparse.count, index_bytes, index_bytes,
                where, "/indices/byteOffset");
    check_reach(context, layout, sparse.values_view, sparse.values_offset, sparse.count, packed_bytes(accessor),
                element_bytes(accessor), where, "/values/byteOffset");
    accessor.sparse = sparse;
}

void read_accessors(LoadContext& context, const Json& document, Layout& layout) {
    const Json& accessors = array(document, "accessors");
    for (size_t i = 0; i < accessors.size(); ++i) {
        const Json& object = accessors[i];
        const std::string where = pointer_to("/accessors", i);
        AccessorLayout accessor;
        accessor.view = index(object, "bufferView");
        accessor.byte_offset = integer(object, "byteOffset");
        accessor.type = component_type(context, object, where);
        read_type(context, object, where, accessor);
        const auto normalized = object.find("normalized");
        accessor.normalized = normalized != object.end() && normalized->get<bool>();
        accessor.count = integer(object, "count");
        accessor.stride = packed_bytes(accessor);
        if (accessor.view) {
            const ViewLayout& view = layout.views[*accessor.view];
            if (view.byte_stride != 0) accessor.stride = view.byte_stride;
            if (accessor.stride < element_bytes(accessor)) {
                context.fail(pointer_to("/bufferViews", *accessor.view, "byteStride"),
                             "is " + std::to_string(accessor.stride) + ", less than the " +
                                 std::to_string(element_bytes(accessor)) + " bytes of an element of " + where);
            }
            check_reach(context, layout, *accessor.view, accessor.byte_offset, accessor.count, accessor.stride,
                        element_bytes(accessor), where, "/count");
        }
        const auto sparse = object.find("sparse");
        if (sparse != object.end()) read_sparse(context, *sparse, where + "/sparse", layout, accessor);
        layout.accessors.push_back(accessor);
    }
}

}  // namespace

uint64_t element_bytes(const AccessorLayout& accessor) {
    const uint64_t column = accessor.rows * component_bytes(accessor.type);
    const uint64_t padded = accessor.columns == 1 ? column : (column + 3) / 4 * 4;
    return (accessor.columns - 1) * padded + column;
}

uint64_t packed_bytes(const AccessorLayout& accessor) {
    const uint64_t size = element_bytes(accessor);
    return accessor.columns == 1 ? size : (size + 3) / 4 * 4;
}

Layout read_layout(LoadContext& context, const Json& document) {
    Layout layout;
    read_buffers(document, layout);
    read_views(context, document, layout);
    read_accessors(context, document, layout);
    const Json& images = array(document, "images");
    for (size_t i = 0; i < images.size(); ++i) {
        layout.images.push_back(
            {text(images[i], "name").value_or(""), text(images[i], "uri"), index(images[i], "bufferView")});
    }
    return layout;
}

}  // namespace candela
