// SPDX-License-Identifier: MIT
// The encoded images of a file, found first and decoded last.
#pragma once

#include "renderer/io/buffers.h"
#include "renderer/io/images.h"

namespace candela {

class AssetImages {
  public:
    AssetImages(LoadContext& context, const Layout& layout, const AssetFiles& files, BufferStore& buffers)
        : context_(context), layout_(layout), files_(files), buffers_(buffers) {}

    // Names only; scene.images becomes as long as the file's.
    void list(Scene& scene) const;

    // Pixel counts of all images, from their heads.
    void measure(Scene& scene);

    // Decodes what the materials read. Textures whose image is missing or damaged take their fallback; without one the
    // image becomes one white texel with a warning, and as a normal texture is left out.
    void decode(Scene& scene);

    // Decodes pictures that are no textures. Empty with a warning where one is missing or damaged.
    std::vector<ImageRgba8> decode_apart(const std::vector<uint32_t>& indices);

  private:
    // Empty with a warning where the bytes cannot be had. consequence: what becomes of it.
    std::span<const std::byte> encoded(size_t index, const char* consequence);
    struct State;
    void decode_used(Scene& scene, std::vector<State>& states);
    std::vector<DecodedImage> decode_all(std::span<const std::span<const std::byte>> sources);

    LoadContext& context_;
    const Layout& layout_;
    const AssetFiles& files_;
    BufferStore& buffers_;
    std::vector<std::vector<std::byte>> owned_;
};

}  // namespace candela
