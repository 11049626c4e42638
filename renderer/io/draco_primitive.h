// SPDX-License-Identifier: MIT
// A primitive whose data is compressed by Draco, made readable through its accessors.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "renderer/io/accessors.h"

namespace tinygltf {
struct Primitive;
}

namespace candela {

class DracoMesh;

// Which buffer view holds the compressed form of a primitive, if it has one.
std::optional<uint32_t> draco_view(const tinygltf::Primitive& primitive);

class DracoPrimitives {
  public:
    DracoPrimitives(LoadContext& context, AccessorReader& accessors);
    ~DracoPrimitives();

    // Where the primitive at `where` has a compressed form, its accessors read as that form says from now on, until
    // finish(); true then. Its triangles are a list. Damaged data is a warning where every accessor that it would have
    // filled has data of its own and the extension is not required, else LoadError.
    bool decode(const tinygltf::Primitive& primitive, const std::string& where, bool extension_is_required);
    void finish();

  private:
    struct Request;
    void decode_or_throw(const Request& request, const std::string& where);

    LoadContext& context_;
    AccessorReader& accessors_;
    uint64_t booked_bytes_ = 0;  // of the replacements
    // Of the view decoded last: primitives that share one come one after the other.
    uint32_t view_ = 0xffffffffu;
    std::unique_ptr<DracoMesh> mesh_;
};

}  // namespace candela
