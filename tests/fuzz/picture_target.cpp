// SPDX-License-Identifier: MIT
// One decoder of pictures: CANDELA_DECODER names it.
#include <type_traits>

#include "renderer/image/codecs.h"
#include "renderer/image/picture_size.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace candela;

// Small, so that the fuzzer spends its time on decoding and not on filling memory.
constexpr DecodeLimits limits{.max_side = 512, .max_pixels = size_t{1} << 16};

template <typename Pixel>
void check(const Image<Pixel>& image) {
    fuzz::require(image.width() > 0 && image.height() > 0, "a picture has pixels");
    fuzz::require(image.width() <= limits.max_side && image.height() <= limits.max_side, "no side is over its limit");
    fuzz::require(image.size() <= limits.max_pixels, "the pixels are not over their limit");
    fuzz::require(image.size() == static_cast<size_t>(image.width()) * static_cast<size_t>(image.height()),
                  "the pixels are as many as the sides say");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::optional<PictureSize> said = picture_size(fuzz::bytes_of(data, size));
    try {
        const auto image = CANDELA_DECODER(fuzz::bytes_of(data, size), limits);
        check(image);
        // The HDR decoder, called by itself, reads what begins like another format.
        if (said && std::is_same_v<decltype(image), const ImageRgba8>) {
            fuzz::require(said->width == static_cast<uint32_t>(image.width()) &&
                              said->height == static_cast<uint32_t>(image.height()),
                          "a picture is as large as its head says");
        }
    } catch (const ImageError& error) {
        fuzz::require(std::string_view(error.what()).find('\n') == std::string_view::npos, "a message is one line");
    }
    return 0;
}
