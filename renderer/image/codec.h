// SPDX-License-Identifier: MIT
// Reading and writing picture files: the only place that knows the image libraries.
// Encoders write to a temporary file beside the target, flush it to the disk and rename it, so that an interrupted or
// failed write never leaves half a file or touches an older one. Failures throw ImageError.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "renderer/image/image.h"

namespace candela {

// what() is one line without the file's name; the caller knows the file.
struct ImageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// What a picture may ask for; the messages name the command line's options that raise them.
struct DecodeLimits {
    int max_side = 16384;  // --limit-image N: N, and N² pixels
    size_t max_pixels = size_t{1} << 28;
    uint64_t max_memory_bytes = uint64_t{16} << 30;  // --limit-memory: for the file's bytes, and for the pixels
};

// Decodes PNG (1 to 16 bit, any colour type), JPEG (grey, YCbCr, CMYK), WebP or KTX2 (Basis Universal as
// KHR_texture_basisu has it; its largest mip level) from memory, whichever its first bytes say it is, to RGBA8 with
// straight alpha, values as stored (no colour conversion; 16-bit values are rounded to 8 bits).
ImageRgba8 decode_ldr(std::span<const std::byte> bytes, const DecodeLimits& limits = {});

// What a KTX2 file that decodes has against KHR_texture_basisu, where that does the picture no harm: predicates
// ("has …", "says …"). Empty for other formats. as_color, as_data: it is used as sRGB colour, as plain numbers.
std::vector<std::string> basisu_oddities(std::span<const std::byte> bytes, bool as_color, bool as_data);

// One named channel layer of an EXR besides the main picture: "albedo.R", "depth.Z", …
struct ExrLayer {
    std::string name;                        // "albedo"
    std::vector<std::string> channel_names;  // {"R","G","B"}; one Image plane per channel below
    std::vector<Image<float>> channels;
};

// A linear picture as read from or written to .exr or .hdr: radiance in linear Rec. 709, alpha 1 where the file has
// none.
ImageRgba32f read_linear(const std::filesystem::path& path, const DecodeLimits& limits = {});

// Reads .exr/.hdr as linear; .png/.jpg/.webp as sRGB converted to linear.
ImageRgba32f read_any_as_linear(const std::filesystem::path& path, const DecodeLimits& limits = {});

// header: string attributes written to the file (command, version, camera).
void write_exr(const std::filesystem::path& path, const ImageRgba32f& image, bool with_alpha,
               const std::map<std::string, std::string>& header, std::span<const ExrLayer> layers = {});
void write_hdr(const std::filesystem::path& path, const ImageRgba32f& image);
// Display-referred 8-bit sRGB values. text: tEXt chunks.
void write_png(const std::filesystem::path& path, const ImageRgba8& image, bool with_alpha,
               const std::map<std::string, std::string>& text = {});

}  // namespace candela
