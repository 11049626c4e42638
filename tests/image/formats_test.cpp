// SPDX-License-Identifier: MIT
// What PNG, JPEG and WebP can hold, each against the values that went in. PNG files are written here byte by byte
// (ISO/IEC 15948), the others by the encoders of their libraries.
#include <cstdio>

#include <jpeglib.h>
#include <webp/encode.h>

#include <functional>
#include <random>

#include "renderer/image/codec.h"
#include "tests/support/ktx2_writer.h"

namespace candela {
namespace {

using test::Bytes;

std::string outcome(std::span<const std::byte> bytes, const DecodeLimits& limits = {}) {
    try {
        decode_ldr(bytes, limits);
    } catch (const ImageError& error) {
        return error.what();
    }
    return "decoded";
}

void append_big(Bytes& out, uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out.push_back(static_cast<std::byte>(value >> shift & 255));
}

void append_chunk(Bytes& out, const char* type, const Bytes& data) {
    append_big(out, static_cast<uint32_t>(data.size()));
    Bytes body;
    for (int i = 0; i < 4; ++i)
        body.push_back(static_cast<std::byte>(type[i]));
    body.insert(body.end(), data.begin(), data.end());
    uint32_t crc = 0xffffffff;
    for (const std::byte byte : body) {
        crc ^= static_cast<uint32_t>(byte);
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 1) != 0 ? crc >> 1 ^ 0xedb88320 : crc >> 1;
    }
    out.insert(out.end(), body.begin(), body.end());
    append_big(out, crc ^ 0xffffffff);
}

// A zlib stream of one stored block.
Bytes stored(const Bytes& data) {
    Bytes out = {std::byte{0x78}, std::byte{0x01}, std::byte{1}};
    test::append_number(out, data.size(), 2);
    test::append_number(out, ~data.size() & 0xffff, 2);
    out.insert(out.end(), data.begin(), data.end());
    uint32_t a = 1, b = 0;
    for (const std::byte byte : data) {
        a = (a + static_cast<uint32_t>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    append_big(out, b << 16 | a);
    return out;
}

enum ColorType : uint8_t { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgba = 6 };

unsigned samples_of(ColorType type) {
    return type == rgb ? 3 : type == rgba ? 4 : type == grey_alpha ? 2 : 1;
}

struct Png {
    uint32_t width = 13, height = 11;
    unsigned depth = 8;
    ColorType type = rgb;
    bool interlaced = false;
    std::vector<uint32_t> samples;  // row by row, all channels of a pixel together
    Bytes palette, transparency;
};

Bytes encode(const Png& png) {
    const unsigned channels = samples_of(png.type);
    Bytes rows;
    const auto append_pass = [&](uint32_t x0, uint32_t y0, uint32_t dx, uint32_t dy) {
        for (uint32_t y = y0; y < png.height; y += dy) {
            if (x0 >= png.width) continue;
            rows.push_back(std::byte{0});  // no filter
            unsigned used = 0;             // bits of the last byte
            for (uint32_t x = x0; x < png.width; x += dx) {
                for (unsigned c = 0; c < channels; ++c) {
                    const uint32_t sample = png.samples[(y * png.width + x) * channels + c];
                    if (png.depth == 16) rows.push_back(static_cast<std::byte>(sample >> 8));
                    if (png.depth >= 8) {
                        rows.push_back(static_cast<std::byte>(sample & 255));
                        continue;
                    }
                    if (used % 8 == 0) rows.push_back(std::byte{0});
                    rows.back() |= static_cast<std::byte>(sample << (8 - png.depth - used % 8));
                    used += png.depth;
                }
            }
        }
    };
    if (png.interlaced) {
        constexpr uint32_t passes[7][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                           {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
        for (const auto& [x0, y0, dx, dy] : passes)
            append_pass(x0, y0, dx, dy);
    } else {
        append_pass(0, 0, 1, 1);
    }
    Bytes out;
    for (const unsigned byte : {0x89u, 0x50u, 0x4eu, 0x47u, 0x0du, 0x0au, 0x1au, 0x0au})
        out.push_back(static_cast<std::byte>(byte));
    Bytes header;
    append_big(header, png.width);
    append_big(header, png.height);
    for (const unsigned byte : {png.depth, static_cast<unsigned>(png.type), 0u, 0u, png.interlaced ? 1u : 0u})
        header.push_back(static_cast<std::byte>(byte));
    append_chunk(out, "IHDR", header);
    if (!png.palette.empty()) append_chunk(out, "PLTE", png.palette);
    if (!png.transparency.empty()) append_chunk(out, "tRNS", png.transparency);
    append_chunk(out, "IDAT", stored(rows));
    append_chunk(out, "IEND", {});
    return out;
}

Png random_png(ColorType type, unsigned depth, uint32_t largest, std::mt19937& random) {
    Png png;
    png.type = type;
    png.depth = depth;
    for (uint32_t i = 0; i < png.width * png.height * samples_of(type); ++i)
        png.samples.push_back(static_cast<uint32_t>(random() % (largest + 1)));
    return png;
}

// The nearest of 256 levels.
uint8_t to_8_bits(uint32_t sample, unsigned depth) {
    const double largest = (1u << depth) - 1;
    return static_cast<uint8_t>(std::floor(sample / largest * 255.0 + 0.5));
}

TEST(Png, EveryColourTypeAndDepthPlainAndInterlaced) {
    std::mt19937 random(1);
    const std::pair<ColorType, std::vector<unsigned>> kinds[] = {
        {grey, {1, 2, 4, 8, 16}}, {rgb, {8, 16}}, {grey_alpha, {8, 16}}, {rgba, {8, 16}}};
    for (const auto& [type, depths] : kinds) {
        for (const unsigned depth : depths) {
            Png png = random_png(type, depth, (1u << depth) - 1, random);
            for (const bool interlaced : {false, true}) {
                png.interlaced = interlaced;
                const ImageRgba8 image = decode_ldr(encode(png));
                ASSERT_EQ(image.width(), 13);
                ASSERT_EQ(image.height(), 11);
                const unsigned channels = samples_of(type);
                for (size_t i = 0; i < image.size(); ++i) {
                    const uint32_t* s = &png.samples[i * channels];
                    const auto at = [&](unsigned c) { return to_8_bits(s[c], depth); };
                    Rgba8 expected(at(0), at(0), at(0), 255);
                    if (channels >= 3) expected = Rgba8(at(0), at(1), at(2), 255);
                    if (channels % 2 == 0) expected.a = at(channels - 1);
                    ASSERT_EQ(image.pixels()[i], expected) << "type " << type << ", " << depth << " bits, pixel " << i;
                }
            }
        }
    }
}

// 16 bits are rounded, not cut: 0x80ff lies nearer to 0x81 than to 0x80.
TEST(Png, SixteenBitsAreRounded) {
    Png png;
    png.width = 256;
    png.height = 256;
    png.depth = 16;
    png.type = grey;
    for (uint32_t i = 0; i < 65536; ++i)
        png.samples.push_back(i);
    // One stored block holds less than 64 KiB: a quarter at a time.
    for (uint32_t part = 0; part < 4; ++part) {
        Png quarter = png;
        quarter.height = 64;
        quarter.samples.assign(png.samples.begin() + part * 16384, png.samples.begin() + (part + 1) * 16384);
        const ImageRgba8 image = decode_ldr(encode(quarter));
        for (uint32_t i = 0; i < 16384; ++i)
            ASSERT_EQ(image.pixels()[i].g, to_8_bits(part * 16384 + i, 16)) << part * 16384 + i;
    }
}

TEST(Png, PalettesWithAndWithoutTransparency) {
    std::mt19937 random(2);
    for (const unsigned depth : {1u, 2u, 4u, 8u}) {
        const uint32_t colors = depth == 8 ? 200 : 1u << depth;
        Png png = random_png(palette, depth, colors - 1, random);
        for (uint32_t i = 0; i < 3 * colors; ++i)
            png.palette.push_back(static_cast<std::byte>(random() % 256));
        for (const bool transparent : {false, true}) {
            // Alpha for the first half of the palette; the rest is opaque.
            for (uint32_t i = 0; transparent && i < (colors + 1) / 2; ++i)
                png.transparency.push_back(static_cast<std::byte>(random() % 256));
            const ImageRgba8 image = decode_ldr(encode(png));
            for (size_t i = 0; i < image.size(); ++i) {
                const uint32_t index = png.samples[i];
                const auto channel = [&](uint32_t c) { return static_cast<uint8_t>(png.palette[3 * index + c]); };
                const uint8_t alpha =
                    index < png.transparency.size() ? static_cast<uint8_t>(png.transparency[index]) : uint8_t{255};
                ASSERT_EQ(image.pixels()[i], Rgba8(channel(0), channel(1), channel(2), alpha)) << depth << " bits";
            }
        }
    }
}

// One colour may be declared transparent; at 16 bits all of them count.
TEST(Png, TransparentColours) {
    Png png;
    png.width = 3;
    png.height = 1;
    png.depth = 16;
    png.type = grey;
    png.samples = {0x1234, 0x1235, 0x1234};
    png.transparency = {std::byte{0x12}, std::byte{0x34}};
    const ImageRgba8 image = decode_ldr(encode(png));
    EXPECT_EQ(image(0, 0).a, 0);
    EXPECT_EQ(image(1, 0).a, 255);
    EXPECT_EQ(image(2, 0).a, 0);

    png.depth = 8;
    png.type = rgb;
    png.samples = {1, 2, 3, 1, 2, 4, 1, 2, 3};
    png.transparency = {std::byte{0}, std::byte{1}, std::byte{0}, std::byte{2}, std::byte{0}, std::byte{3}};
    const ImageRgba8 colored = decode_ldr(encode(png));
    EXPECT_EQ(colored(0, 0), Rgba8(1, 2, 3, 0));
    EXPECT_EQ(colored(1, 0), Rgba8(1, 2, 4, 255));
}

TEST(Png, LimitsAreNamed) {
    std::mt19937 random(4);
    const Bytes bytes = encode(random_png(rgb, 8, 255, random));
    EXPECT_EQ(outcome(bytes, {12, 1000}),
              "the picture has 13x11 pixels; the limit is 12 a side and 1000 in all; --limit-image raises it");
    EXPECT_EQ(outcome(bytes, {13, 142}),
              "the picture has 13x11 pixels; the limit is 13 a side and 142 in all; --limit-image raises it");
    EXPECT_EQ(outcome(bytes, {13, 143}), "decoded");
    // A header that promises what no memory could hold.
    Png huge;
    huge.width = huge.height = 0x7fffffff;
    Bytes promised = encode(Png{1, 1, 8, rgb, false, {0, 0, 0}, {}, {}});
    Bytes header;
    append_big(header, huge.width);
    append_big(header, huge.height);
    for (const int byte : {8, 2, 0, 0, 0})
        header.push_back(static_cast<std::byte>(byte));
    Bytes chunk;
    append_chunk(chunk, "IHDR", header);
    std::copy(chunk.begin(), chunk.end(), promised.begin() + 8);
    EXPECT_NE(outcome(promised).find("2147483647x2147483647 pixels; the limit is 16384"), std::string::npos)
        << outcome(promised);
}

struct JpegSettings {
    J_COLOR_SPACE stored = JCS_YCbCr;
    bool progressive = false, adobe = true;
    std::vector<jpeg_scan_info> scans;
};

// Samples of 1, 3 or 4 channels, at the best quality and without subsampling.
Bytes encode_jpeg(const std::vector<uint8_t>& samples, unsigned width, int channels, const JpegSettings& settings) {
    jpeg_compress_struct info{};
    jpeg_error_mgr errors{};
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&info, &data, &size);
    info.image_width = width;
    info.image_height = static_cast<unsigned>(samples.size()) / width / static_cast<unsigned>(channels);
    info.input_components = channels;
    info.in_color_space = channels == 1 ? JCS_GRAYSCALE : channels == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&info);
    jpeg_set_colorspace(&info, settings.stored);
    info.write_Adobe_marker = settings.adobe ? info.write_Adobe_marker : FALSE;
    for (int c = 0; c < channels; ++c)
        info.comp_info[c].h_samp_factor = info.comp_info[c].v_samp_factor = 1;
    jpeg_set_quality(&info, 100, TRUE);
    if (settings.progressive) jpeg_simple_progression(&info);
    if (!settings.scans.empty()) {
        info.scan_info = settings.scans.data();
        info.num_scans = static_cast<int>(settings.scans.size());
    }
    jpeg_start_compress(&info, TRUE);
    std::vector<uint8_t> copy = samples;
    while (info.next_scanline < info.image_height) {
        JSAMPROW row = copy.data() + size_t{info.next_scanline} * width * static_cast<unsigned>(channels);
        jpeg_write_scanlines(&info, &row, 1);
    }
    jpeg_finish_compress(&info);
    Bytes out;
    for (unsigned long i = 0; i < size; ++i)
        out.push_back(static_cast<std::byte>(data[i]));
    std::free(data);
    jpeg_destroy_compress(&info);
    return out;
}

// Smooth ramps, 24 × 16.
std::vector<uint8_t> ramps(int channels) {
    std::vector<uint8_t> out;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 24; ++x) {
            const int values[4] = {10 * x, 15 * y, 240 - 5 * x - 5 * y, 20 + 4 * x};
            for (int c = 0; c < channels; ++c)
                out.push_back(static_cast<uint8_t>(values[c]));
        }
    }
    return out;
}

void expect_near(const Bytes& jpeg, const std::function<Rgba8(size_t)>& expected, int tolerance) {
    const ImageRgba8 image = decode_ldr(jpeg);
    ASSERT_EQ(image.width(), 24);
    ASSERT_EQ(image.height(), 16);
    double error = 0;
    for (size_t i = 0; i < image.size(); ++i) {
        for (int c = 0; c < 4; ++c) {
            ASSERT_NEAR(image.pixels()[i][c], expected(i)[c], tolerance) << "pixel " << i << ", channel " << c;
            error += image.pixels()[i][c] - expected(i)[c];
        }
    }
    EXPECT_NEAR(error / (3.0 * static_cast<double>(image.size())), 0.0, 0.25) << "rounded, not cut";
}

TEST(Jpeg, ColoursAndGreysSequentialAndProgressive) {
    const std::vector<uint8_t> colors = ramps(3), greys = ramps(1);
    for (const bool progressive : {false, true}) {
        JpegSettings settings;
        settings.progressive = progressive;
        const auto color = [&](size_t i) { return Rgba8(colors[3 * i], colors[3 * i + 1], colors[3 * i + 2], 255); };
        expect_near(encode_jpeg(colors, 24, 3, settings), color, 3);
        settings.stored = JCS_RGB;
        expect_near(encode_jpeg(colors, 24, 3, settings), color, 1);
        settings.stored = JCS_GRAYSCALE;
        expect_near(
            encode_jpeg(greys, 24, 1, settings), [&](size_t i) { return Rgba8(greys[i], greys[i], greys[i], 255); }, 1);
    }
}

// With Adobe's marker the values are the light that passes, without it the ink.
TEST(Jpeg, FourInks) {
    const std::vector<uint8_t> inks = ramps(4);
    for (const J_COLOR_SPACE stored : {JCS_CMYK, JCS_YCCK}) {
        for (const bool adobe : {true, false}) {
            if (!adobe && stored == JCS_YCCK) continue;  // only the marker tells it from CMYK
            JpegSettings settings;
            settings.stored = stored;
            settings.adobe = adobe;
            expect_near(
                encode_jpeg(inks, 24, 4, settings),
                [&](size_t i) {
                    const auto light = [&](size_t c) {
                        const double value = inks[4 * i + c] / 255.0;
                        return adobe ? value : 1.0 - value;
                    };
                    const auto channel = [&](size_t c) {
                        return static_cast<uint8_t>(std::floor(255.0 * light(c) * light(3) + 0.5));
                    };
                    return Rgba8(channel(0), channel(1), channel(2), 255);
                },
                stored == JCS_CMYK ? 1 : 3);
        }
    }
}

TEST(Jpeg, DamageIsSaidAndQuirksAreNot) {
    const Bytes whole = encode_jpeg(ramps(3), 24, 3, {});
    Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(whole.size() / 2));
    EXPECT_NE(outcome(cut).find("broken JPEG: Premature end"), std::string::npos) << outcome(cut);
    // Bytes between the header's segments that belong to none.
    Bytes extra = whole;
    extra.insert(extra.begin() + 20, 5, std::byte{0});
    EXPECT_EQ(outcome(extra), "decoded");
    EXPECT_EQ(outcome(whole, {23, 1000}),
              "the picture has 24x16 pixels; the limit is 23 a side and 1000 in all; --limit-image raises it");
}

TEST(Jpeg, FilesOfVeryManyScansAreRefused) {
    JpegSettings settings;
    const auto scan = [&](int component, int first, int last, int high, int low) {
        settings.scans.push_back({1, {component, 0, 0, 0}, first, last, high, low});
    };
    settings.scans.push_back({3, {0, 1, 2, 0}, 0, 0, 0, 0});
    for (int component = 0; component < 3; ++component) {
        for (int coefficient = 1; coefficient < 64; ++coefficient)
            scan(component, coefficient, coefficient, 0, component == 0 ? 1 : 0);
    }
    EXPECT_EQ(outcome(encode_jpeg(ramps(3), 24, 3, settings)), "decoded") << settings.scans.size();
    for (int coefficient = 1; coefficient < 64; ++coefficient)
        scan(0, coefficient, coefficient, 1, 0);
    EXPECT_EQ(outcome(encode_jpeg(ramps(3), 24, 3, settings)), "the JPEG has more than 200 scans");
}

Bytes to_bytes(uint8_t* data, size_t size) {
    Bytes out;
    for (size_t i = 0; i < size; ++i)
        out.push_back(static_cast<std::byte>(data[i]));
    WebPFree(data);
    return out;
}

TEST(Webp, LosslessAndLossyWithAlpha) {
    ImageRgba8 image(24, 16);
    const std::vector<uint8_t> samples = ramps(4);
    for (size_t i = 0; i < image.size(); ++i)
        image.pixels()[i] = Rgba8(samples[4 * i], samples[4 * i + 1], samples[4 * i + 2], samples[4 * i + 3]);
    uint8_t* data = nullptr;
    size_t size = WebPEncodeLosslessRGBA(&image(0, 0).r, 24, 16, 24 * 4, &data);
    EXPECT_EQ(decode_ldr(to_bytes(data, size)).pixels(), image.pixels());

    size = WebPEncodeRGBA(&image(0, 0).r, 24, 16, 24 * 4, 100.0f, &data);
    const Bytes lossy = to_bytes(data, size);
    const ImageRgba8 back = decode_ldr(lossy);
    for (size_t i = 0; i < image.size(); ++i) {
        EXPECT_EQ(back.pixels()[i].a, image.pixels()[i].a) << "alpha is lossless";
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(back.pixels()[i][c], image.pixels()[i][c], 16) << "colour is subsampled";
    }
    EXPECT_EQ(outcome(lossy, {23, 1000}),
              "the picture has 24x16 pixels; the limit is 23 a side and 1000 in all; --limit-image raises it");
    const Bytes cut(lossy.begin(), lossy.end() - static_cast<std::ptrdiff_t>(lossy.size() / 3));
    EXPECT_NE(outcome(cut).find("broken WebP"), std::string::npos) << outcome(cut);
}

TEST(Webp, AnimationsAreNamed) {
    // RIFF with an extended header whose animation flag is set, 24 × 16, an ANIM and an empty ANMF chunk.
    Bytes out;
    const auto text = [&](const char* name) {
        for (int i = 0; i < 4; ++i)
            out.push_back(static_cast<std::byte>(name[i]));
    };
    text("RIFF");
    test::append_number(out, 4 + 18 + 14 + 24, 4);
    text("WEBP");
    text("VP8X");
    test::append_number(out, 10, 4);
    test::append_number(out, 2, 4);
    test::append_number(out, 23, 3);
    test::append_number(out, 15, 3);
    text("ANIM");
    test::append_number(out, 6, 4);
    test::append_number(out, 0, 6);
    text("ANMF");
    test::append_number(out, 16, 4);
    test::append_number(out, 0, 16);
    EXPECT_EQ(outcome(out), "the WebP file is an animation, not a picture");
}

}  // namespace
}  // namespace candela
