// SPDX-License-Identifier: MIT
// KTX2 with Basis Universal, straight to texels; Zstandard through libzstd.
#include <zstd.h>

#include <limits>

#include "renderer/image/basis_lz.h"
#include "renderer/image/codecs.h"
#include "renderer/image/ktx2_container.h"
#include "renderer/image/uastc.h"

namespace candela {

namespace {

// The one frame that a level is, which must fill exactly the size that the picture needs.
std::vector<std::byte> decompress(std::span<const std::byte> bytes, size_t expected) {
    std::vector<std::byte> out(expected);
    const size_t got = ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(got) != 0) throw ImageError(std::string("broken KTX2: Zstandard: ") + ZSTD_getErrorName(got));
    if (got != expected) throw ImageError("broken KTX2: its blocks are fewer than its size needs");
    return out;
}

ImageRgba8 decode_uastc_level(const Ktx2File& file, const Ktx2File::Level& level) {
    const size_t columns = (static_cast<size_t>(level.width) + 3) / 4,
                 rows = (static_cast<size_t>(level.height) + 3) / 4;
    const size_t needed = columns * rows * uastc_block_bytes;
    if (level.uncompressed_bytes != needed)
        throw ImageError("broken KTX2: a mip level has another size than its picture");
    if (file.zstandard) return decode_uastc(decompress(level.data, needed), level.width, level.height);
    if (level.data.size() < needed) throw ImageError("broken KTX2: its blocks are fewer than its size needs");
    return decode_uastc(level.data, level.width, level.height);
}

ImageRgba8 decode_etc1s_level(const Ktx2File& file, size_t index) {
    using Second = BasisLz::SecondSlice;
    const Ktx2File::Level& level = file.levels[index];
    const Second second = file.channels == Ktx2File::Channels::rgba        ? Second::alpha
                          : file.channels == Ktx2File::Channels::red_green ? Second::green
                                                                           : Second::none;
    return BasisLz(file.global_data, file.levels.size()).decode(index, level.data, level.width, level.height, second);
}

}  // namespace

ImageRgba8 decode_ktx2(std::span<const std::byte> bytes, const DecodeLimits& limits) {
    // Smaller levels are made from this one, as for every picture: what a young picture shows must be the mean of what
    // it comes to show, in linear light, and of the file's own levels nobody knows how they were made.
    constexpr size_t base_level = 0;
    const Ktx2File file = parse_ktx2(bytes, limits);
    if (file.blocks == Ktx2File::Blocks::etc1s) return decode_etc1s_level(file, base_level);
    ImageRgba8 out = decode_uastc_level(file, file.levels[base_level]);
    // Whatever the blocks hold, there is no alpha unless the descriptor says so.
    if (file.channels != Ktx2File::Channels::rgba) {
        for (Rgba8& texel : out.pixels())
            texel.a = 255;
    }
    return out;
}

std::vector<std::string> basisu_oddities(std::span<const std::byte> bytes, bool as_color, bool as_data) {
    std::vector<std::string> out;
    if (sniff_format(bytes) != ImageFormat::ktx2) return out;
    const Ktx2File file = parse_ktx2(bytes, {std::numeric_limits<int>::max(), std::numeric_limits<size_t>::max(),
                                             std::numeric_limits<uint64_t>::max()});
    const Ktx2File::Level& base = file.levels.front();
    if (base.width % 4 != 0 || base.height % 4 != 0) {
        out.push_back("has " + std::to_string(base.width) + "x" + std::to_string(base.height) +
                      " pixels, no multiples of 4 as KHR_texture_basisu wants");
    }
    // Of two uses one disagrees, whatever it says.
    if (as_color && !as_data && file.transfer == Ktx2File::Transfer::linear)
        out.emplace_back("says that its values are linear but is used as sRGB colour");
    if (as_data && !as_color && file.transfer == Ktx2File::Transfer::srgb)
        out.emplace_back("says that its values are sRGB but is used as data");
    return out;
}

}  // namespace candela
