// SPDX-License-Identifier: MIT
// The encoded images of a file, found first and decoded last.
#pragma once

#include "renderer/io/buffers.h"
#include "renderer/io/images.h"

namespace candela {

class AssetImages {
  public:
    AssetImages(LoadContext& context, const Layout& layout, const AssetFiles& files, BufferStore& buffers);
    ~AssetImages();

    // Names only; scene.images becomes as long as the file's.
    void list(Scene& scene) const;

    // Pixel counts of all images, from their heads.
    void measure(Scene& scene);

    // Begins to decode what the materials read, on other threads; scene.images get what their heads tell of alpha.
    // What becomes of it is the same as if all was done in finish: where memory runs short beside the rest of the load,
    // it is.
    void begin(Scene& scene);
    // Whether there is anything to decode.
    bool any_begun() const { return !begun_.empty(); }
    // Waits for it. Textures whose image is missing or damaged take their fallback; without one the image becomes one
    // white texel with a warning, and as a normal texture is left out.
    void finish(Scene& scene);

    // Decodes pictures that are no textures. Empty with a warning where one is missing or damaged.
    std::vector<ImageRgba8> decode_apart(const std::vector<uint32_t>& indices);

  private:
    // Empty with a warning where the bytes cannot be had.
    std::span<const std::byte> encoded(size_t index);
    struct State;
    // An image that is being decoded.
    struct Begun {
        uint32_t image = 0;
        EncodedImage source;
        std::string unread;         // why the source cannot be had
        uint64_t source_bytes = 0;  // booked
    };
    void note_uses(const Scene& scene);
    std::vector<Begun> sources_of_untried(const Scene& scene);
    Begun source_of(uint32_t image);
    void start();
    void drop();
    std::vector<DecodedImage> collect();
    void take(Scene& scene);
    ImageDecodeOptions decode_options() const;

    LoadContext& context_;
    const Layout& layout_;
    const AssetFiles& files_;
    BufferStore& buffers_;
    std::vector<RawBytes> owned_;
    std::vector<State> states_;
    std::vector<Begun> begun_;
    std::atomic<uint64_t> booked_bytes_{0};    // for pixels
    std::unique_ptr<ImageDecoding> decoding_;  // last: ends before what it reads
};

}  // namespace candela
