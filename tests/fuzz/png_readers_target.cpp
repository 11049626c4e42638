// SPDX-License-Identifier: MIT
// PNG by the own reader and by libpng: the same pixels, or the same error.
#include <optional>
#include <string>

#include "renderer/image/codecs.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace candela;

constexpr DecodeLimits limits{.max_side = 512, .max_pixels = size_t{1} << 16};

struct Outcome {
    ImageRgba8 image;
    std::string error;
};

template <typename Decode>
Outcome outcome_of(Decode decode, std::span<const std::byte> bytes) {
    try {
        return {decode(bytes, limits), {}};
    } catch (const ImageError& error) {
        return {{}, error.what()};
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::span<const std::byte> bytes = fuzz::bytes_of(data, size);
    const Outcome own = outcome_of(decode_png, bytes), packaged = outcome_of(decode_png_with_libpng, bytes);
    // Zlib checks the tables of codes more closely than libdeflate: it refuses some that decode to the right checksum.
    if (own.error.empty() && packaged.error.starts_with("broken PNG: IDAT: invalid ")) return 0;
    fuzz::require(own.error == packaged.error, "both readers say the same of a broken picture");
    fuzz::require(own.image.width() == packaged.image.width() && own.image.height() == packaged.image.height(),
                  "both readers find it as large");
    fuzz::require(own.image.pixels() == packaged.image.pixels(), "both readers find the same pixels");
    return 0;
}
