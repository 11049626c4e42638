// SPDX-License-Identifier: MIT
// Typed arrays out of accessors: every component type, normalised or not, strided, sparse, or absent (zeros).
#pragma once

#include <map>
#include <vector>

#include "renderer/io/buffers.h"
#include "renderer/math/math.h"

namespace candela {

class AccessorReader {
  public:
    AccessorReader(LoadContext& context, const Layout& layout, BufferStore& buffers)
        : context_(context), layout_(layout), buffers_(buffers) {}

    // The same, for a part of the load that runs on a thread of its own.
    AccessorReader(LoadContext& context, const AccessorReader& whole)
        : context_(context), layout_(whole.layout_), buffers_(whole.buffers_) {}

    const AccessorLayout& layout(uint32_t accessor) const { return layout_.accessors[accessor]; }
    const Layout& layout() const { return layout_; }

    // Elements that stand in for an accessor's own until clear_replacements: packed, of the accessor's type and count.
    // So what a compressed primitive holds reads like any other accessor.
    void replace(uint32_t accessor, RawBytes elements) { replaced_[accessor] = std::move(elements); }
    void clear_replacements() { replaced_.clear(); }
    // Decompresses what these accessors read, as far as it is compressed (BufferStore::decode_early).
    void decode_early(const std::vector<uint32_t>& accessors);
    // The bytes of a buffer view, decompressed.
    std::span<const std::byte> view(uint32_t view) { return buffers_.view(view); }

    // Elements as floats, with normalized integers mapped to [0,1] or [-1,1] as glTF has it (section 3.6.2.2). The
    // memory is booked with the context. where names the use for the error when the accessor's type is another.
    std::vector<float> read_scalars(uint32_t accessor, const std::string& where);
    std::vector<Vec2> read_vec2(uint32_t accessor, const std::string& where);
    std::vector<Vec3> read_vec3(uint32_t accessor, const std::string& where);
    std::vector<Vec4> read_vec4(uint32_t accessor, const std::string& where);
    std::vector<Mat4> read_mat4(uint32_t accessor, const std::string& where);
    // Unsigned scalars.
    std::vector<uint32_t> read_indices(uint32_t accessor, const std::string& where);
    // RGB (alpha 1) or RGBA; integers count as normalized even where the file forgot to say so.
    std::vector<Vec4> read_colors(uint32_t accessor, const std::string& where);

  private:
    template <typename Element>
    std::vector<Element> read_floats(uint32_t accessor, uint32_t rows, uint32_t columns, const char* type,
                                     const std::string& where, bool always_normalized = false);
    std::vector<uint64_t> read_sparse_positions(uint32_t accessor);
    // Where the elements lie before sparse ones replace some; first is null where all are zero.
    struct Source {
        const std::byte* first = nullptr;
        uint64_t stride = 0;
    };
    Source source_of(uint32_t accessor);

    LoadContext& context_;
    const Layout& layout_;
    BufferStore& buffers_;
    std::map<uint32_t, RawBytes> replaced_;
};

}  // namespace candela
