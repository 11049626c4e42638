// SPDX-License-Identifier: MIT
// The own reader of PNG against what went in, and against libpng: the same pixels, or the same error.
#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include <cstring>
#include <functional>
#include <random>
#include <variant>

#include "renderer/image/atomic_file.h"
#include "renderer/image/codecs.h"
#include "renderer/image/png_truecolor.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

using Bytes = std::vector<std::byte>;

struct Writing {
    int channels = 3, bits = 8;
    bool interlaced = false, transparent_color = false;
    size_t piece_bytes = 8192;  // of compressed data to a chunk
};

// Of 16 bits a picture has the upper 8 twice.
Bytes encode(const ImageRgba8& image, const Writing& writing) {
    Bytes out;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    const auto append = [](png_structp writer, png_bytep bytes, size_t count) {
        auto& to = *static_cast<Bytes*>(png_get_io_ptr(writer));
        const auto* first = reinterpret_cast<const std::byte*>(bytes);
        to.insert(to.end(), first, first + count);
    };
    png_set_write_fn(png, &out, append, [](png_structp) {});
    constexpr int types[] = {0, PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                             PNG_COLOR_TYPE_RGB_ALPHA};
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.width()), static_cast<png_uint_32>(image.height()),
                 writing.bits, types[writing.channels], writing.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_gAMA(png, info, 0.45455);
    if (writing.transparent_color) {
        const Rgba8 p = image(0, 0);
        const png_color_16 color{0, p.r, p.g, p.b, p.r};
        png_set_tRNS(png, info, nullptr, 0, &color);
    }
    png_set_compression_buffer_size(png, writing.piece_bytes);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
    png_write_info(png, info);
    const int passes = png_set_interlace_handling(png);
    for (int pass = 0; pass < passes; ++pass) {
        for (int y = 0; y < image.height(); ++y) {
            std::vector<png_byte> row;
            for (int x = 0; x < image.width(); ++x) {
                const Rgba8 p = image(x, y);
                const png_byte of_grey[] = {p.r, p.a}, of_color[] = {p.r, p.g, p.b, p.a};
                for (int c = 0; c < writing.channels; ++c)
                    row.insert(row.end(), static_cast<size_t>(writing.bits / 8),
                               writing.channels < 3 ? of_grey[c] : of_color[c]);
            }
            png_write_row(png, row.data());
        }
    }
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return out;
}

// Smooth with noise, so that each filter's prediction is now and then the nearest, and equal ones occur.
ImageRgba8 picture(int width, int height, bool with_alpha, std::mt19937& random) {
    ImageRgba8 out(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto channel = [&](int slope) {
                return static_cast<uint8_t>((x * slope + y * 7 + random() % 40) & 255);
            };
            out(x, y) = Rgba8(channel(3), channel(11), channel(20), with_alpha ? channel(5) : uint8_t{255});
        }
    }
    return out;
}

using Outcome = std::variant<ImageRgba8::Pixels, std::string>;

Outcome outcome(const std::function<ImageRgba8()>& decode) {
    try {
        return decode().pixels();
    } catch (const ImageError& error) {
        return error.what();
    }
}

constexpr DecodeLimits small{.max_side = 512, .max_pixels = size_t{1} << 16};

bool own_reader_decodes(std::span<const std::byte> bytes) {
    try {
        return decode_truecolor_png(bytes, small).has_value();
    } catch (const ImageError&) {
        return false;
    }
}

// Zlib checks the tables of codes more closely than libdeflate: it refuses some that decode to the right checksum.
bool readers_agree(std::span<const std::byte> bytes, const DecodeLimits& limits = small) {
    const Outcome own = outcome([&] { return decode_png(bytes, limits); });
    const Outcome packaged = outcome([&] { return decode_png_with_libpng(bytes, limits); });
    const auto* refused = std::get_if<std::string>(&packaged);
    const bool over_tables = refused != nullptr && refused->starts_with("broken PNG: IDAT: invalid ");
    return own == packaged || (over_tables && std::holds_alternative<ImageRgba8::Pixels>(own));
}

uint32_t big_endian_32(const Bytes& bytes, size_t at) {
    uint32_t out = 0;
    for (size_t i = 0; i < 4; ++i)
        out = out << 8 | std::to_integer<uint32_t>(bytes[at + i]);
    return out;
}

// Writes the checksums of all chunks anew.
Bytes with_checksums(Bytes bytes) {
    for (size_t at = 8; at + 12 <= bytes.size();) {
        const size_t length = big_endian_32(bytes, at);
        if (length > bytes.size() - at - 12) break;
        const auto sum = static_cast<uint32_t>(
            crc32(0, reinterpret_cast<const Bytef*>(&bytes[at + 4]), static_cast<uInt>(length + 4)));
        for (size_t i = 0; i < 4; ++i)
            bytes[at + 8 + length + i] = static_cast<std::byte>(sum >> (24 - 8 * i));
        at += 12 + length;
    }
    return bytes;
}

void append_big(Bytes& out, size_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out.push_back(static_cast<std::byte>(value >> shift & 255));
}

void append_chunk(Bytes& out, const char* name, std::span<const Bytef> data) {
    append_big(out, data.size());
    for (int i = 0; i < 4; ++i)
        out.push_back(static_cast<std::byte>(name[i]));
    for (const Bytef byte : data)
        out.push_back(static_cast<std::byte>(byte));
    append_big(out, 0);
}

// Rows as they are, each with the byte that names its filter; no library writes every filter everywhere.
Bytes file_of_rows(size_t width, size_t height, int channels, std::span<const Bytef> rows, size_t piece_bytes) {
    Bytes out, sides;
    for (const int byte : {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a})
        out.push_back(static_cast<std::byte>(byte));
    append_big(sides, width);
    append_big(sides, height);
    std::vector<Bytef> header(13);
    std::memcpy(header.data(), sides.data(), sides.size());
    header[8] = 8;
    header[9] = channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA;
    append_chunk(out, "IHDR", header);
    uLongf length = compressBound(rows.size());
    std::vector<Bytef> compressed(length);
    EXPECT_EQ(compress(compressed.data(), &length, rows.data(), rows.size()), Z_OK);
    for (size_t at = 0; at < length; at += piece_bytes)
        append_chunk(out, "IDAT", std::span(compressed).subspan(at, std::min(piece_bytes, length - at)));
    append_chunk(out, "IEND", {});
    return with_checksums(std::move(out));
}

TEST(PngTruecolor, WhatWentIn) {
    std::mt19937 random(6);
    for (const int channels : {3, 4}) {
        const ImageRgba8 image = picture(131, 67, channels == 4, random);
        const std::optional<ImageRgba8> read = decode_truecolor_png(encode(image, {.channels = channels}), {});
        ASSERT_TRUE(read);
        EXPECT_EQ(read->width(), 131);
        EXPECT_EQ(read->height(), 67);
        EXPECT_EQ(read->pixels(), image.pixels());
    }
}

TEST(PngTruecolor, EveryFilterAndShape) {
    std::mt19937 random(1);
    // 4 is Paeth's, of which two rows go at once.
    const std::vector<int> filters[] = {{0}, {1}, {2}, {3}, {4}, {4, 1, 4, 4, 4, 3, 0, 4, 4, 4, 4, 2}};
    constexpr size_t sizes[][2] = {{1, 1}, {1, 9}, {9, 1}, {2, 2}, {1, 200}, {200, 2}, {33, 47}};
    for (const int channels : {3, 4}) {
        for (const std::vector<int>& filter : filters) {
            for (const auto& [width, height] : sizes) {
                std::vector<Bytef> rows;
                for (size_t y = 0; y < height; ++y) {
                    rows.push_back(static_cast<Bytef>(filter[y % filter.size()]));
                    // Small ones, so that predictions are near each other and equal now and then.
                    for (size_t i = 0; i < width * static_cast<size_t>(channels); ++i)
                        rows.push_back(static_cast<Bytef>((random() % 7 - 3) & 255));
                }
                for (const size_t piece_bytes : {size_t{8192}, size_t{11}}) {
                    const Bytes bytes = file_of_rows(width, height, channels, rows, piece_bytes);
                    const std::optional<ImageRgba8> read = decode_truecolor_png(bytes, {});
                    ASSERT_TRUE(read) << channels << " channels, " << width << "x" << height;
                    ASSERT_EQ(read->pixels(), decode_png_with_libpng(bytes, {}).pixels())
                        << channels << " channels, " << width << "x" << height << ", filter " << filter[0];
                }
            }
        }
    }
}

TEST(PngTruecolor, OtherKindsAreLeftToLibpng) {
    std::mt19937 random(2);
    const ImageRgba8 image = picture(21, 13, true, random);
    std::vector<Writing> others = {
        {.interlaced = true}, {.channels = 4, .interlaced = true}, {.transparent_color = true}};
    for (int channels = 1; channels <= 4; ++channels) {
        others.push_back({.channels = channels, .bits = 16});
        if (channels < 3) others.push_back({.channels = channels});
    }
    for (const Writing& writing : others) {
        const Bytes bytes = encode(image, writing);
        EXPECT_FALSE(decode_truecolor_png(bytes, {})) << writing.channels << " channels, " << writing.bits << " bits";
        EXPECT_EQ(decode_png(bytes, {}).size(), image.size());
        EXPECT_TRUE(readers_agree(bytes));
    }
}

// Each byte changed, with the checksums of the chunks as they were and as they should be; the file cut off anywhere;
// bytes that nobody needs.
TEST(PngTruecolor, DamageIsWhatLibpngSays) {
    std::mt19937 random(3);
    for (const int channels : {3, 4}) {
        const Bytes bytes = encode(picture(9, 6, channels == 4, random), {.channels = channels, .piece_bytes = 100});
        ASSERT_TRUE(decode_truecolor_png(bytes, {}));
        size_t decoded = 0;
        for (size_t i = 0; i < bytes.size(); ++i) {
            for (const std::byte change : {std::byte{1}, std::byte{0x10}, std::byte{0x20}, std::byte{0xff}}) {
                Bytes changed = bytes;
                changed[i] ^= change;
                EXPECT_TRUE(readers_agree(changed)) << "byte " << i;
                changed = with_checksums(std::move(changed));
                EXPECT_TRUE(readers_agree(changed)) << "byte " << i << ", checksums written anew";
                decoded += own_reader_decodes(changed) ? 1 : 0;
            }
            EXPECT_TRUE(readers_agree(std::span(bytes).first(i))) << "cut at " << i;
        }
        // Bytes that do not matter to the pixels are there, but not many.
        EXPECT_GT(decoded, 0u);
        EXPECT_LT(decoded, bytes.size());
        Bytes longer = bytes;
        longer.insert(longer.end(), 20, std::byte{7});
        EXPECT_TRUE(decode_truecolor_png(longer, {}));
        EXPECT_TRUE(readers_agree(longer));
    }
}

// The stream as it is and one byte more or less, in a chunk whose length and checksum are right.
TEST(PngTruecolor, PixelsAreNeitherMoreNorLessThanTheHeaderSays) {
    std::mt19937 random(4);
    const Bytes bytes = encode(picture(9, 6, false, random), {});
    size_t at = 8;
    while (std::memcmp(&bytes[at + 4], "IDAT", 4) != 0)
        at += 12 + big_endian_32(bytes, at);
    const auto changed_by = [&](int more) {
        Bytes out = bytes;
        const uint32_t length = big_endian_32(out, at);
        const auto end = out.begin() + static_cast<std::ptrdiff_t>(at + 8 + length);
        if (more > 0) out.insert(end, std::byte{0});
        if (more < 0) out.erase(end - 1);
        for (size_t i = 0; i < 4; ++i)
            out[at + i] = static_cast<std::byte>((length + static_cast<uint32_t>(more)) >> (24 - 8 * i));
        return with_checksums(std::move(out));
    };
    EXPECT_TRUE(decode_truecolor_png(changed_by(0), {}));
    for (const int more : {-1, 1}) {
        EXPECT_FALSE(decode_truecolor_png(changed_by(more), {})) << more;
        EXPECT_TRUE(readers_agree(changed_by(more))) << more;
    }
    for (const int height : {5, 7}) {
        Bytes out = bytes;
        out[8 + 8 + 7] = static_cast<std::byte>(height);
        out = with_checksums(std::move(out));
        EXPECT_FALSE(decode_truecolor_png(out, {})) << height;
        EXPECT_TRUE(readers_agree(out)) << height;
    }
}

// A stream that says that it refers 256 bytes back, and refers to the row above, which is farther away.
TEST(PngTruecolor, StreamsReferNoFurtherBackThanTheySay) {
    constexpr size_t width = 133;
    std::mt19937 random(7);
    std::vector<Bytef> rows(1 + 3 * width);
    std::generate(rows.begin() + 1, rows.end(), random);
    rows.insert(rows.end(), rows.begin(), rows.begin() + 1 + 3 * width);
    Bytes bytes = file_of_rows(width, 2, 3, rows, 8192);
    ASSERT_TRUE(decode_truecolor_png(bytes, {}));
    constexpr size_t stream = 8 + 12 + 13 + 8;  // behind signature, header and the head of the chunk
    bytes[stream] = std::byte{0x08};
    bytes[stream + 1] = std::byte{0x1d};  // so that both are a multiple of 31
    bytes = with_checksums(std::move(bytes));
    EXPECT_FALSE(decode_truecolor_png(bytes, {}));
    EXPECT_THROW(decode_png_with_libpng(bytes, {}), ImageError);
    EXPECT_TRUE(readers_agree(bytes));
}

TEST(PngTruecolor, LimitsAreLibpngs) {
    std::mt19937 random(5);
    const Bytes bytes = encode(picture(40, 30, false, random), {.piece_bytes = 100});
    for (const DecodeLimits& limits : {DecodeLimits{39, 1 << 20}, DecodeLimits{40, 1199}, DecodeLimits{40, 1200},
                                       DecodeLimits{40, 1200, 4799}, DecodeLimits{40, 1200, 4800}}) {
        EXPECT_TRUE(readers_agree(bytes, limits));
    }
    // What it needs besides the pixels it only takes where there is as much.
    EXPECT_FALSE(decode_truecolor_png(bytes, {40, 1200, 4800}));
    EXPECT_EQ(decode_png(bytes, {40, 1200, 4800}).size(), 1200u);
}

TEST(PngTruecolor, SharedPicturesAreTheSame) {
    const std::filesystem::path models = test::shared_data() / "models";
    if (!std::filesystem::exists(models)) GTEST_SKIP() << "skipped: no shared data";
    size_t files = 0, own = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(models)) {
        if (entry.path().extension() != ".png") continue;
        const Bytes bytes = read_file(entry.path());
        const std::optional<ImageRgba8> read = decode_truecolor_png(bytes, {});
        ++files;
        own += read ? 1 : 0;
        EXPECT_EQ((read ? *read : decode_png(bytes, {})).pixels(), decode_png_with_libpng(bytes, {}).pixels())
            << entry.path();
    }
    // Textures are of the common kind; that is what the reader is for.
    EXPECT_GT(10 * own, 8 * files);
}

}  // namespace
}  // namespace candela
