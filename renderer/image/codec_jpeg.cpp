// SPDX-License-Identifier: MIT
// JPEG through libjpeg (turbo). The library's fatal errors leave it by an exception instead of exit().
#include <cstdio>

#include <jpeglib.h>

#include "renderer/image/codecs.h"

namespace candela {

namespace {

[[noreturn]] void throw_jpeg_error(j_common_ptr info) {
    char message[JMSG_LENGTH_MAX];
    info->err->format_message(info, message);
    throw ImageError(std::string("broken JPEG: ") + message);
}

// A warning means that data is missing or damaged; a picture with grey holes is worse than a plain word.
void treat_jpeg_message(j_common_ptr info, int level) {
    if (level < 0) throw_jpeg_error(info);
}

struct JpegReader {
    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};
    JpegReader() {
        info.err = jpeg_std_error(&errors);
        errors.error_exit = throw_jpeg_error;
        errors.emit_message = treat_jpeg_message;
        jpeg_create_decompress(&info);
    }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;
    ~JpegReader() { jpeg_destroy_decompress(&info); }
};

}  // namespace

ImageRgba8 decode_jpeg(std::span<const std::byte> bytes, const DecodeLimits& limits) {
    JpegReader reader;
    jpeg_decompress_struct& info = reader.info;
    jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&info, TRUE);
    check_size(info.image_width, info.image_height, limits);
    const bool four_inks = info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK;
    info.out_color_space = four_inks ? JCS_CMYK : JCS_EXT_RGBA;
    const bool inverted = info.saw_Adobe_marker != 0;
    jpeg_start_decompress(&info);

    ImageRgba8 out(static_cast<int>(info.output_width), static_cast<int>(info.output_height));
    while (info.output_scanline < info.output_height) {
        JSAMPROW row = &out(0, static_cast<int>(info.output_scanline)).r;
        jpeg_read_scanlines(&info, &row, 1);
    }
    jpeg_finish_decompress(&info);
    if (!four_inks) return out;

    // Adobe stores inks inverted: then each value is already how much light the ink lets through.
    for (Rgba8& p : out.pixels()) {
        const glm::uvec4 light = inverted ? glm::uvec4(p) : 255u - glm::uvec4(p);
        p = Rgba8(light.r * light.a / 255u, light.g * light.a / 255u, light.b * light.a / 255u, 255u);
    }
    return out;
}

}  // namespace candela
