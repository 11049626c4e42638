// SPDX-License-Identifier: MIT
#include "renderer/io/draco_primitive.h"

#include "renderer/io/draco.h"
#include "renderer/io/json_document.h"
#include "renderer/io/tinygltf.h"

namespace candela {

namespace {

constexpr const char* name = "KHR_draco_mesh_compression";

}  // namespace

std::optional<uint32_t> draco_view(const tinygltf::Primitive& primitive) {
    const tinygltf::Value* source = find_extension(primitive.extensions, name);
    if (source == nullptr || !source->Has("bufferView")) return std::nullopt;
    return static_cast<uint32_t>(source->Get("bufferView").GetNumberAsInt());
}

// Which accessors a stream fills, by the ids of its attributes.
struct DracoPrimitives::Request {
    uint32_t view = 0;
    std::map<uint32_t, uint32_t> id_of_accessor;
    uint32_t indices = 0;
};

DracoPrimitives::DracoPrimitives(LoadContext& context, AccessorReader& accessors)
    : context_(context), accessors_(accessors) {}

DracoPrimitives::~DracoPrimitives() = default;

void DracoPrimitives::decode_or_throw(const Request& request, const std::string& where) {
    const auto require_count = [&](uint32_t accessor, uint64_t holds, const char* what) {
        const uint64_t says = accessors_.layout(accessor).count;
        if (says == holds) return;
        throw std::runtime_error("the compressed data holds " + std::to_string(holds) + " " + what + ", but " +
                                 pointer_to("/accessors", accessor, "count") + " is " + std::to_string(says));
    };
    const std::span<const std::byte> encoded = accessors_.view(request.view);

    // What the head of the stream declares is compared with the accessors before anything is allocated for it.
    if (view_ != request.view) {
        mesh_.reset();
        view_ = 0xffffffffu;
        const DracoMesh::Counts counts = DracoMesh::read_counts(encoded);
        require_count(request.indices, 3 * counts.faces, "corners");
        for (const auto& [accessor, id] : request.id_of_accessor) {
            const uint64_t says = accessors_.layout(accessor).count;
            // Vertices become several points where attributes have seams, never fewer but for isolated ones.
            if (counts.points > 4 * says + 64) require_count(accessor, counts.points, "vertices");
        }
        const uint64_t working = draco_working_bytes(counts, request.id_of_accessor.size());
        context_.charge(working, where);
        mesh_ = std::make_unique<DracoMesh>(encoded);
        context_.release(working);
        view_ = request.view;
    }

    const auto book = [&](uint32_t accessor) {
        const uint64_t bytes = accessors_.layout(accessor).count * packed_bytes(accessors_.layout(accessor));
        context_.charge(bytes, where);
        booked_bytes_ += bytes;
    };
    for (const auto& [accessor, id] : request.id_of_accessor) {
        require_count(accessor, mesh_->point_count(), "vertices");
        book(accessor);
        accessors_.replace(accessor, mesh_->attribute(id, accessors_.layout(accessor)));
    }
    require_count(request.indices, 3 * mesh_->face_count(), "corners");
    book(request.indices);
    accessors_.replace(request.indices, mesh_->indices(accessors_.layout(request.indices)));
}

void DracoPrimitives::finish() {
    accessors_.clear_replacements();
    context_.release(booked_bytes_);
    booked_bytes_ = 0;
}

bool DracoPrimitives::decode(const tinygltf::Primitive& primitive, const std::string& where,
                             bool extension_is_required) {
    const tinygltf::Value* source = find_extension(primitive.extensions, name);
    if (source == nullptr || !source->Has("bufferView") || !source->Has("attributes")) return false;
    const std::string place = where + "/extensions/" + name;
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != TINYGLTF_MODE_TRIANGLE_STRIP) {
        context_.fail(place,
                      "compresses only triangles, but the primitive's mode is " + std::to_string(primitive.mode));
    }

    Request request;
    request.view = static_cast<uint32_t>(source->Get("bufferView").GetNumberAsInt());
    bool has_other_data = true;
    const tinygltf::Value& ids = source->Get("attributes");
    for (const std::string& attribute : ids.Keys()) {
        const auto accessor = primitive.attributes.find(attribute);
        if (accessor == primitive.attributes.end()) {
            context_.warn(place + "/attributes/" + pointer_token(attribute),
                          "is not an attribute of the primitive and is not used");
            continue;
        }
        const auto index = static_cast<uint32_t>(accessor->second);
        request.id_of_accessor[index] = static_cast<uint32_t>(ids.Get(attribute).GetNumberAsInt());
        has_other_data &= accessors_.layout(index).view.has_value();
    }
    if (primitive.indices < 0) context_.fail(place, "compresses indices, but the primitive has none");
    request.indices = static_cast<uint32_t>(primitive.indices);
    has_other_data &= accessors_.layout(request.indices).view.has_value();

    try {
        decode_or_throw(request, place);
        return true;
    } catch (const LoadError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        finish();
        if (extension_is_required || !has_other_data) context_.fail(place, error.what());
        context_.warn(place, std::string(error.what()) + "; the uncompressed data is used");
        return false;
    }
}

}  // namespace candela
