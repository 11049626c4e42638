// SPDX-License-Identifier: MIT
#include "renderer/io/buffers.h"

#include "renderer/math/parallel.h"

namespace candela {

BufferStore::BufferStore(LoadContext& context, const Layout& layout, const AssetFiles& files,
                         std::optional<std::span<const std::byte>> glb_bin)
    : context_(context),
      layout_(layout),
      owned_(layout.buffers.size()),
      buffers_(layout.buffers.size()),
      decoded_(layout.views.size()),
      asked_(layout.views.size()) {
    for (size_t i = 0; i < layout.buffers.size(); ++i) {
        context.check_cancel();
        if (layout.buffers[i].needed) buffers_[i] = read_buffer(i, files, glb_bin);
    }
}

std::span<const std::byte> BufferStore::read_buffer(size_t index, const AssetFiles& files,
                                                    std::optional<std::span<const std::byte>> glb_bin) {
    const BufferLayout& buffer = layout_.buffers[index];
    const std::string where = pointer_to("/buffers", index);
    std::span<const std::byte> bytes;
    if (!buffer.uri) {
        if (index != 0 || !glb_bin) context_.fail(where, "has no uri, and the file has no binary chunk for it");
        bytes = *glb_bin;
    } else {
        try {
            if (is_data_uri(*buffer.uri)) {
                context_.charge(data_uri_bound_bytes(*buffer.uri), where + "/uri");
                owned_[index] = decode_data_uri(*buffer.uri);
            } else {
                const std::filesystem::path file = files.resolve(*buffer.uri);
                context_.charge(std::min(file_size_bytes(file), buffer.byte_length), where + "/byteLength");
                owned_[index] = read_file(file, buffer.byte_length, true);
            }
        } catch (const FileError& error) {
            context_.fail(where + "/uri", error.what());
        }
        bytes = owned_[index];
    }
    if (bytes.size() < buffer.byte_length) {
        context_.fail(where + "/byteLength", std::to_string(buffer.byte_length) + " bytes are declared, but only " +
                                                 std::to_string(bytes.size()) + " are there");
    }
    return bytes.first(buffer.byte_length);
}

void BufferStore::decode(uint32_t index) {
    const ViewLayout& view = layout_.views[index];
    const CompressedLayout& source = *view.compressed;
    const std::string where = pointer_to("/bufferViews", index, "extensions") + "/" + source.extension;
    context_.charge(source.count, source.stride, where + "/count");
    try {
        decoded_[index] = decode_meshopt({buffers_[source.buffer].subspan(source.byte_offset, source.byte_length),
                                          source.count, source.stride, source.mode, source.filter});
    } catch (const std::runtime_error& error) {
        context_.release(source.count * source.stride);
        context_.fail(where, error.what());
    }
    if (decoded_[index].size() != view.byte_length) context_.fail(where, "decodes to another size than declared");
}

std::span<const std::byte> BufferStore::view(uint32_t index) {
    const ViewLayout& view = layout_.views[index];
    if (!view.compressed) return buffers_[view.buffer].subspan(view.byte_offset, view.byte_length);
    std::call_once(asked_[index], [&] { decode(index); });
    return decoded_[index];
}

void BufferStore::decode_early(const std::set<uint32_t>& views) {
    const std::vector<uint32_t> all(views.begin(), views.end());
    parallel_for_each(all.size(), 1, [&](size_t i) {
        try {
            view(all[i]);
        } catch (...) {  // NOLINT(bugprone-empty-catch): said when the view is asked for
        }
    });
}

}  // namespace candela
