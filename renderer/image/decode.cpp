// SPDX-License-Identifier: MIT
// Which decoder a file wants is told by its first bytes, never by its name.
#include <cstring>

#include "renderer/image/atomic_file.h"
#include "renderer/image/codecs.h"
#include "renderer/image/tone.h"

namespace candela {

namespace {

bool starts_with(std::span<const std::byte> bytes, std::string_view magic, size_t at = 0) {
    return bytes.size() >= at + magic.size() && std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
}

}  // namespace

ImageFormat sniff_format(std::span<const std::byte> bytes) {
    if (starts_with(bytes, "\x89PNG\r\n\x1a\n")) return ImageFormat::png;
    if (starts_with(bytes, "\xff\xd8\xff")) return ImageFormat::jpeg;
    if (starts_with(bytes, "RIFF") && starts_with(bytes, "WEBP", 8)) return ImageFormat::webp;
    if (starts_with(bytes, "\xabKTX 20\xbb\r\n\x1a\n")) return ImageFormat::ktx2;
    if (starts_with(bytes, "\x76\x2f\x31\x01")) return ImageFormat::exr;
    if (starts_with(bytes, "#?")) return ImageFormat::hdr;
    return ImageFormat::unknown;
}

void check_size(uint64_t width, uint64_t height, const DecodeLimits& limits, size_t pixel_bytes) {
    if (width == 0 || height == 0) throw ImageError("the picture has no pixels");
    const std::string size = "the picture has " + std::to_string(width) + "x" + std::to_string(height) + " pixels";
    const auto side = static_cast<uint64_t>(limits.max_side);
    if (width > side || height > side || width * height > limits.max_pixels) {
        throw ImageError(size + "; the limit is " + std::to_string(limits.max_side) + " a side and " +
                         std::to_string(limits.max_pixels) + " in all; --limit-image raises it");
    }
    if (width * height > limits.max_memory_bytes / pixel_bytes) {
        throw ImageError(size + " and so needs " + std::to_string(width * height * pixel_bytes) +
                         " bytes, more than the memory limit leaves for it (" +
                         std::to_string(limits.max_memory_bytes) + " bytes); --limit-memory raises it");
    }
}

ImageRgba8 decode_ldr(std::span<const std::byte> bytes, const DecodeLimits& limits) {
    switch (sniff_format(bytes)) {
        case ImageFormat::png:
            return decode_png(bytes, limits);
        case ImageFormat::jpeg:
            return decode_jpeg(bytes, limits);
        case ImageFormat::webp:
            return decode_webp(bytes, limits);
        case ImageFormat::ktx2:
            return decode_ktx2(bytes, limits);
        default:
            throw ImageError("is no PNG, JPEG, WebP or KTX2 picture");
    }
}

ImageRgba32f read_linear(const std::filesystem::path& path, const DecodeLimits& limits) {
    const std::vector<std::byte> bytes = read_file(path, limits);
    switch (sniff_format(bytes)) {
        case ImageFormat::exr:
            return decode_exr(bytes, limits);
        case ImageFormat::hdr:
            return decode_hdr(bytes, limits);
        default:
            throw ImageError("is no OpenEXR or Radiance picture");
    }
}

ImageRgba32f read_any_as_linear(const std::filesystem::path& path, const DecodeLimits& limits) {
    const std::vector<std::byte> bytes = read_file(path, limits);
    const ImageFormat format = sniff_format(bytes);
    if (format == ImageFormat::exr) return decode_exr(bytes, limits);
    if (format == ImageFormat::hdr) return decode_hdr(bytes, limits);
    if (format == ImageFormat::unknown)
        throw ImageError("is no picture in a format that candela reads (EXR, HDR, PNG, JPEG, WebP, KTX2)");
    const ImageRgba8 stored = decode_ldr(bytes, limits);
    ImageRgba32f out(stored.width(), stored.height());
    float table[256];
    for (int i = 0; i < 256; ++i)
        table[i] = linear_from_srgb(static_cast<float>(i) / 255.0f);
    for (size_t i = 0; i < stored.size(); ++i) {
        const Rgba8& p = stored.pixels()[i];
        const float alpha = static_cast<float>(p.a) / 255.0f;
        out.pixels()[i] = Vec4(Vec3(table[p.r], table[p.g], table[p.b]) * alpha, alpha);
    }
    return out;
}

}  // namespace candela
