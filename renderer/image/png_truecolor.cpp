// SPDX-License-Identifier: MIT
#include "renderer/image/png_truecolor.h"

#include <libdeflate.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "renderer/image/byte_order.h"
#include "renderer/image/codecs.h"
#include "renderer/image/png_filters.h"

namespace candela {

namespace {

constexpr uint32_t name_of(const char (&text)[5]) {
    uint32_t out = 0;
    for (int i = 0; i < 4; ++i)
        out = out << 8 | static_cast<uint8_t>(text[i]);
    return out;
}

struct Chunk {
    uint32_t name = 0;
    std::span<const std::byte> data;
    bool intact = false;  // its checksum is right

    bool is_ancillary() const { return (name >> 24 & 0x20) != 0; }
};

// Libpng takes no longer ones (decode_png says so), except of pixels.
constexpr size_t longest_chunk_bytes = size_t{64} << 20;

// The next one; nothing where the file ends in it, or what is there is none.
std::optional<Chunk> take_chunk(std::span<const std::byte>& rest) {
    if (rest.size() < 12) return std::nullopt;
    const size_t length = read_big_endian_u32(rest, 0);
    if (length > longest_chunk_bytes || length > rest.size() - 12) return std::nullopt;
    const auto is_letter = [](std::byte b) {
        const auto lower = std::to_integer<unsigned>(b | std::byte{0x20});
        return lower >= 'a' && lower <= 'z';
    };
    if (!std::all_of(rest.begin() + 4, rest.begin() + 8, is_letter)) return std::nullopt;
    Chunk out;
    out.name = read_big_endian_u32(rest, 4);
    out.data = rest.subspan(8, length);
    // That of the others does not matter: they are not read.
    if (!out.is_ancillary())
        out.intact = libdeflate_crc32(0, rest.data() + 4, length + 4) == read_big_endian_u32(rest, 8 + length);
    rest = rest.subspan(12 + length);
    return out;
}

struct Truecolor {
    uint32_t width = 0, height = 0;
    size_t channels = 0;
    std::vector<std::span<const std::byte>> compressed;  // pieces of one zlib stream

    size_t compressed_bytes() const {
        size_t out = 0;
        for (const std::span<const std::byte>& piece : compressed)
            out += piece.size();
        return out;
    }
    // A row is a byte for its filter and the pixels.
    uint64_t inflated_bytes() const { return uint64_t{height} * (1 + uint64_t{channels} * width); }
};

std::optional<Truecolor> read_chunks(std::span<const std::byte> bytes) {
    if (sniff_format(bytes) != ImageFormat::png) return std::nullopt;
    std::span<const std::byte> rest = bytes.subspan(8);

    // The header: depth, colour type, and methods of which there is but one each; not interlaced.
    const std::optional<Chunk> header = take_chunk(rest);
    if (!header || header->name != name_of("IHDR") || !header->intact || header->data.size() != 13) return std::nullopt;
    Truecolor out;
    out.width = read_big_endian_u32(header->data, 0);
    out.height = read_big_endian_u32(header->data, 4);
    constexpr uint32_t largest = std::numeric_limits<int32_t>::max();
    if (out.width == 0 || out.height == 0 || out.width > largest || out.height > largest) return std::nullopt;
    const uint32_t kind = read_big_endian_u32(header->data, 8);
    constexpr uint32_t rgb = 0x08'02'00'00, rgba = 0x08'06'00'00;
    if ((kind != rgb && kind != rgba) || header->data[12] != std::byte{0}) return std::nullopt;
    out.channels = kind == rgb ? 3 : 4;

    // Then whatever else there may be, the pixels in one sequence, and another chunk.
    for (;;) {
        const std::optional<Chunk> chunk = take_chunk(rest);
        if (!chunk) return std::nullopt;
        if (chunk->name == name_of("IDAT")) {
            if (!chunk->intact) return std::nullopt;
            out.compressed.push_back(chunk->data);
        } else if (!out.compressed.empty()) {
            return out;
        } else if (!chunk->is_ancillary() || chunk->name == name_of("tRNS")) {
            return std::nullopt;
        }
    }
}

// Of a zlib stream (RFC 1950, 2.2): how far back it says that it refers. Libdeflate does not look at it.
uint64_t window_bytes(std::byte first) {
    return uint64_t{1} << (8 + (std::to_integer<unsigned>(first) >> 4));
}

bool inflate_whole(std::span<const std::byte> compressed, std::span<std::byte> out) {
    if (compressed.empty()) return false;
    constexpr uint64_t longest_window_bytes = 32768;
    const uint64_t window = window_bytes(compressed[0]);
    if (window > longest_window_bytes || window < std::min<uint64_t>(longest_window_bytes, out.size())) return false;
    const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflater(
        libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
    if (inflater == nullptr) return false;
    size_t used = 0;
    const libdeflate_result result = libdeflate_zlib_decompress_ex(inflater.get(), compressed.data(), compressed.size(),
                                                                   out.data(), out.size(), &used, nullptr);
    return result == LIBDEFLATE_SUCCESS && used == compressed.size();
}

bool inflate_pieces(std::span<const std::span<const std::byte>> pieces, size_t bytes, std::span<std::byte> out) {
    if (pieces.size() == 1) return inflate_whole(pieces[0], out);
    std::vector<std::byte> joined;
    joined.reserve(bytes);
    for (const std::span<const std::byte>& piece : pieces)
        joined.insert(joined.end(), piece.begin(), piece.end());
    return inflate_whole(joined, out);
}

}  // namespace

std::optional<ImageRgba8> decode_truecolor_png(std::span<const std::byte> bytes, const DecodeLimits& limits) {
    const std::optional<Truecolor> png = read_chunks(bytes);
    if (!png) return std::nullopt;
    check_size(png->width, png->height, limits);

    // The inflated rows lie at the end of the memory for the pixels, which grow towards them.
    const uint64_t row_bytes = uint64_t{png->width} * sizeof(Rgba8);
    const uint64_t spare_rows = (unfilter_ahead_bytes(png->width, png->height) + row_bytes - 1) / row_bytes;
    const uint64_t rows = png->height + spare_rows;
    constexpr uint64_t most_bytes = uint64_t{1} << 40;
    if (rows > std::numeric_limits<int32_t>::max() || rows > most_bytes / row_bytes) return std::nullopt;
    const size_t compressed_bytes = png->compressed_bytes();
    if (rows * row_bytes + compressed_bytes > limits.max_memory_bytes) return std::nullopt;
    ImageRgba8 out = ImageRgba8::unfilled(static_cast<int>(png->width), static_cast<int>(rows));
    const std::span<std::byte> memory = std::as_writable_bytes(std::span(out.pixels()));
    const size_t inflated_bytes = png->inflated_bytes();
    const std::span<std::byte> inflated =
        memory.subspan(memory.size() - sizeof(Rgba8) - inflated_bytes, inflated_bytes);

    if (!inflate_pieces(png->compressed, compressed_bytes, inflated)) return std::nullopt;
    if (!unfilter_rows(reinterpret_cast<const uint8_t*>(inflated.data()), png->channels, png->width, png->height,
                       out.data())) {
        return std::nullopt;
    }
    out.keep_rows(static_cast<int>(png->height));
    return out;
}

}  // namespace candela
