// SPDX-License-Identifier: MIT
// The bytes of a file's buffers and buffer views, read once and decompressed when first asked for.
#pragma once

#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "renderer/io/files.h"
#include "renderer/io/layout.h"

namespace candela {

class BufferStore {
  public:
    // Reads every buffer that is needed. glb_bin must outlive the store. Throws LoadError for buffers that are missing
    // or shorter than they say; longer ones are legal, and exactly byteLength bytes of them are seen.
    BufferStore(LoadContext& context, const Layout& layout, const AssetFiles& files,
                std::optional<std::span<const std::byte>> glb_bin);

    // byteLength bytes; valid as long as the store. Throws LoadError where compressed data is damaged. From any thread.
    std::span<const std::byte> view(uint32_t index);

    // Decompresses views on all cores, so that whoever asks for them does not wait for one after another. What fails
    // does so again when it is asked for.
    void decode_early(const std::set<uint32_t>& views);

  private:
    std::span<const std::byte> read_buffer(size_t index, const AssetFiles& files,
                                           std::optional<std::span<const std::byte>> glb_bin);

    LoadContext& context_;
    const Layout& layout_;
    std::vector<RawBytes> owned_;
    std::vector<std::span<const std::byte>> buffers_;
    void decode(uint32_t index);

    // By view, where it is compressed, once it was asked for.
    std::vector<RawBytes> decoded_;
    std::vector<std::once_flag> asked_;
};

}  // namespace candela
