// SPDX-License-Identifier: MIT
// PNG: the common kind by an own reader, everything else through libpng.
#include <png.h>

#include <cstring>

#include "renderer/image/atomic_file.h"
#include "renderer/image/codecs.h"
#include "renderer/image/png_truecolor.h"

namespace candela {

namespace {

struct ByteReader {
    std::span<const std::byte> rest;
};

[[noreturn]] void throw_png_error(png_structp, png_const_charp message) {
    throw ImageError(std::string("broken PNG: ") + message);
}

void ignore_png_warning(png_structp, png_const_charp) {}

void read_bytes(png_structp png, png_bytep out, size_t count) {
    auto& reader = *static_cast<ByteReader*>(png_get_io_ptr(png));
    if (reader.rest.size() < count) png_error(png, "it ends too early");
    std::memcpy(out, reader.rest.data(), count);
    reader.rest = reader.rest.subspan(count);
}

void append_bytes(png_structp png, png_bytep bytes, size_t count) {
    auto& out = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
    const auto* first = reinterpret_cast<const std::byte*>(bytes);
    out.insert(out.end(), first, first + count);
}

void flush_nothing(png_structp) {}

// libpng is C, but is built to be unwound through; these own its structures meanwhile.
struct PngReader {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, throw_png_error, ignore_png_warning);
    png_infop info = png_create_info_struct(png);
    PngReader() = default;
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct PngWriter {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, throw_png_error, ignore_png_warning);
    png_infop info = png_create_info_struct(png);
    PngWriter() = default;
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
};

}  // namespace

ImageRgba8 decode_png(std::span<const std::byte> bytes, const DecodeLimits& limits) {
    if (std::optional<ImageRgba8> out = decode_truecolor_png(bytes, limits)) return *std::move(out);
    return decode_png_with_libpng(bytes, limits);
}

ImageRgba8 decode_png_with_libpng(std::span<const std::byte> bytes, const DecodeLimits& limits) {
    PngReader reader;
    ByteReader source{bytes};
    png_set_read_fn(reader.png, &source, read_bytes);
    png_set_user_limits(reader.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // check_size names the limit
    png_set_chunk_malloc_max(reader.png, 64u << 20);
    // Of all that is not pixels only the transparent colour is read; texts and profiles may inflate to anything.
    constexpr png_byte skipped[] = "iCCP\0zTXt\0iTXt\0tEXt\0sPLT\0hIST\0eXIf\0pCAL\0sCAL\0cHRM\0gAMA\0sRGB\0bKGD";
    png_set_keep_unknown_chunks(reader.png, PNG_HANDLE_CHUNK_NEVER, skipped, sizeof(skipped) / 5);
    png_read_info(reader.png, reader.info);
    const png_uint_32 width = png_get_image_width(reader.png, reader.info);
    const png_uint_32 height = png_get_image_height(reader.png, reader.info);
    check_size(width, height, limits);

    // Whatever is stored becomes 8-bit RGBA; transparent colours are found before 16 bits are rounded to 8.
    png_set_expand(reader.png);
    png_set_scale_16(reader.png);
    png_set_gray_to_rgb(reader.png);
    png_set_add_alpha(reader.png, 0xff, PNG_FILLER_AFTER);
    const int passes = png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    if (png_get_rowbytes(reader.png, reader.info) != size_t{width} * 4)
        throw ImageError("broken PNG: unexpected row size");

    ImageRgba8 out(static_cast<int>(width), static_cast<int>(height));
    for (int pass = 0; pass < passes; ++pass) {
        for (int y = 0; y < out.height(); ++y)
            png_read_row(reader.png, &out(0, y).r, nullptr);
    }
    return out;
}

void write_png(const std::filesystem::path& path, const ImageRgba8& image, bool with_alpha,
               const std::map<std::string, std::string>& text) {
    PngWriter writer;
    std::vector<std::byte> bytes;
    png_set_write_fn(writer.png, &bytes, append_bytes, flush_nothing);
    png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.width()),
                 static_cast<png_uint_32>(image.height()), 8,
                 with_alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
    for (const auto& [key, value] : text) {
        std::string key_copy = key.substr(0, 79), value_copy = value;
        png_text chunk{};
        chunk.compression = PNG_TEXT_COMPRESSION_NONE;
        chunk.key = key_copy.data();
        chunk.text = value_copy.data();
        chunk.text_length = value_copy.size();
        png_set_text(writer.png, writer.info, &chunk, 1);
    }
    png_write_info(writer.png, writer.info);
    if (!with_alpha) png_set_filler(writer.png, 0, PNG_FILLER_AFTER);
    for (int y = 0; y < image.height(); ++y)
        png_write_row(writer.png, &image(0, y).r);
    png_write_end(writer.png, writer.info);
    write_file_atomically(path, bytes);
}

}  // namespace candela
