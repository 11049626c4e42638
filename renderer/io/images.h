// SPDX-License-Identifier: MIT
// Decoding the images of a file, several at a time, beside whatever else is done meanwhile.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "renderer/image/codec.h"
#include "renderer/image/mip_chain.h"
#include "renderer/scene/scene.h"

namespace candela {

// Where the bytes of an image are: in memory that outlives the decoding, in a file that is read when its turn comes, or
// in a data: URI (likewise). An empty span fails with "no data".
struct DataUri {
    std::string_view text;
};
struct EncodedImage {
    std::variant<std::span<const std::byte>, std::filesystem::path, DataUri> source;
    std::optional<MipColors> mips;           // wanted
    bool as_color = false, as_data = false;  // how it is used: what basisu_oddities asks
};

struct DecodedImage {
    ImageRgba8 pixels;                // empty when error is set
    std::vector<ImageRgba8> smaller;  // where mips are wanted
    ImageAlpha alpha = ImageAlpha::unknown;
    std::vector<std::string> oddities;
    std::string error;      // one line; empty: decoded
    bool unread = false;    // the error is about the file or the URI
    bool too_much = false;  // the error is that others have left no memory for it
    uint64_t booked_bytes = 0;
};

struct ImageDecodeOptions {
    DecodeLimits limits;
    // Decoded bytes of all images together; images that would exceed it fail with an error naming the limit.
    uint64_t max_total_bytes = uint64_t{16} << 30;
    // Books those of one image elsewhere too, from any thread; false: there are not as many left, and it fails.
    std::function<bool(uint64_t)> book;
    unsigned threads = 0;                       // 0: all cores; 1: the one that waits, in order
    std::function<void(float)> progress;        // 0..1, never falling, from the thread that waits only
    const std::atomic<bool>* cancel = nullptr;  // set: images not yet begun fail with "cancelled"
};

// Decodes from construction on, on threads that nothing more urgent keeps busy. One result per image, in order; a
// damaged image never stops the others.
class ImageDecoding {
  public:
    ImageDecoding(std::vector<EncodedImage> images, const ImageDecodeOptions& options);
    ~ImageDecoding();  // leaves what has not begun, and waits for the rest
    ImageDecoding(const ImageDecoding&) = delete;
    ImageDecoding& operator=(const ImageDecoding&) = delete;

    // Helps, and waits until all are decoded. Once.
    std::vector<DecodedImage> finish();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// All at once, without anything beside.
std::vector<DecodedImage> decode_images(std::span<const std::span<const std::byte>> encoded,
                                        const ImageDecodeOptions& options = {});

}  // namespace candela
