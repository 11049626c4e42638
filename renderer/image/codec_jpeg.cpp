// SPDX-License-Identifier: MIT
// JPEG through libjpeg (turbo). The library's fatal errors leave it by an exception instead of exit().
#include <cstdio>

#include <jpeglib.h>

#include <jerror.h>

#include "renderer/image/codecs.h"

namespace candela {

namespace {

[[noreturn]] void throw_jpeg_error(j_common_ptr info) {
    char message[JMSG_LENGTH_MAX];
    info->err->format_message(info, message);
    throw ImageError(std::string("broken JPEG: ") + message);
}

// Most warnings mean that data is missing or damaged; a picture with grey holes is worse than a plain word. The others
// are quirks of cameras and editors that cost no texel.
void treat_jpeg_message(j_common_ptr info, int level) {
    constexpr int quirks[] = {JWRN_EXTRANEOUS_DATA, JWRN_JFIF_MAJOR, JWRN_ADOBE_XFORM, JWRN_NOT_SEQUENTIAL};
    const bool quirk = std::find(std::begin(quirks), std::end(quirks), info->err->msg_code) != std::end(quirks);
    if (level < 0 && !quirk) throw_jpeg_error(info);
}

// Each scan of a progressive file visits the whole picture: many make a small file take minutes. Encoders write ten.
constexpr int max_scans = 200;

void limit_scans(j_common_ptr info) {
    if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number > max_scans)
        throw ImageError("the JPEG has more than " + std::to_string(max_scans) + " scans");
}

struct JpegReader {
    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    JpegReader() {
        info.err = jpeg_std_error(&errors);
        errors.error_exit = throw_jpeg_error;
        errors.emit_message = treat_jpeg_message;
        jpeg_create_decompress(&info);
        progress.progress_monitor = limit_scans;
        info.progress = &progress;
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

    ImageRgba8 out = ImageRgba8::unfilled(static_cast<int>(info.output_width), static_cast<int>(info.output_height));
    while (info.output_scanline < info.output_height) {
        JSAMPROW row = &out(0, static_cast<int>(info.output_scanline)).r;
        jpeg_read_scanlines(&info, &row, 1);
    }
    jpeg_finish_decompress(&info);
    if (!four_inks) return out;

    // Adobe stores inks inverted: then each value is already how much light the ink lets through.
    for (Rgba8& p : out.pixels()) {
        const glm::uvec4 light = inverted ? glm::uvec4(p) : 255u - glm::uvec4(p);
        p = Rgba8((glm::uvec3(light) * light.a + 127u) / 255u, 255u);
    }
    return out;
}

}  // namespace candela
