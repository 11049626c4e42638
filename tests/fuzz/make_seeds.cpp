// SPDX-License-Identifier: MIT
// Small inputs for the codecs' fuzz targets, one for each way their format has of storing a picture or a stream.
// usage: make_seeds FOLDER    writes FOLDER/TARGET/NAME
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>
#include <png.h>
#include <webp/encode.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include <jpeglib.h>

#include "renderer/image/codec.h"

namespace {

using namespace candela;
namespace fs = std::filesystem;

constexpr int width = 19, height = 13;

// A gradient with some noise, so that every predictor and code has something to do.
uint8_t sample(int x, int y, int channel) {
    const int noise = (x * 7919 + y * 104729 + channel * 31) % 23;
    return static_cast<uint8_t>((x * 11 + y * 5 + channel * 60 + noise) & 0xff);
}

fs::path place(const fs::path& folder, const std::string& target, const std::string& name) {
    fs::create_directories(folder / target);
    return folder / target / name;
}

void write(const fs::path& file, std::span<const uint8_t> bytes) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

void write_pngs(const fs::path& folder) {
    struct Kind {
        const char* name;
        int color_type, bits;
    };
    constexpr Kind kinds[] = {{"grey1", PNG_COLOR_TYPE_GRAY, 1},       {"grey4", PNG_COLOR_TYPE_GRAY, 4},
                              {"grey16", PNG_COLOR_TYPE_GRAY, 16},     {"grey_alpha", PNG_COLOR_TYPE_GRAY_ALPHA, 8},
                              {"palette2", PNG_COLOR_TYPE_PALETTE, 2}, {"palette8", PNG_COLOR_TYPE_PALETTE, 8},
                              {"rgb", PNG_COLOR_TYPE_RGB, 8},          {"rgba", PNG_COLOR_TYPE_RGB_ALPHA, 8},
                              {"rgba16", PNG_COLOR_TYPE_RGB_ALPHA, 16}};
    for (const Kind& kind : kinds) {
        for (const bool interlaced : {false, true}) {
            const fs::path file = place(folder, "png", kind.name + std::string(interlaced ? "_interlaced" : ""));
            FILE* out = std::fopen(file.c_str(), "wb");
            png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
            png_infop info = png_create_info_struct(png);
            png_init_io(png, out);
            png_set_IHDR(png, info, width, height, kind.bits, kind.color_type,
                         interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                         PNG_FILTER_TYPE_DEFAULT);
            if (kind.color_type == PNG_COLOR_TYPE_PALETTE) {
                const int colors = 1 << kind.bits;
                std::vector<png_color> palette(static_cast<size_t>(colors), png_color{10, 20, 30});
                png_set_PLTE(png, info, palette.data(), colors);
                const png_byte alpha[] = {0, 128, 255};
                png_set_tRNS(png, info, alpha, 3, nullptr);
            }
            png_set_gAMA(png, info, 0.45455);
            png_set_compression_buffer_size(png, 300);  // several chunks
            png_write_info(png, info);
            std::vector<std::vector<png_byte>> rows(height, std::vector<png_byte>(width * 8));
            std::vector<png_bytep> pointers;
            for (int y = 0; y < height; ++y) {
                for (size_t x = 0; x < rows[0].size(); ++x)
                    rows[static_cast<size_t>(y)][x] = sample(static_cast<int>(x), y, 0);
                pointers.push_back(rows[static_cast<size_t>(y)].data());
            }
            png_write_image(png, pointers.data());
            png_write_end(png, info);
            png_destroy_write_struct(&png, &info);
            std::fclose(out);
        }
    }
}

void write_jpegs(const fs::path& folder) {
    struct Kind {
        const char* name;
        J_COLOR_SPACE space;
        int channels;
        bool progressive, arithmetic;
        int restart_rows;
    };
    constexpr Kind kinds[] = {
        {"grey", JCS_GRAYSCALE, 1, false, false, 0},    {"grey_progressive", JCS_GRAYSCALE, 1, true, false, 0},
        {"color", JCS_RGB, 3, false, false, 0},         {"color_progressive", JCS_RGB, 3, true, false, 0},
        {"color_restart", JCS_RGB, 3, false, false, 1}, {"color_arithmetic", JCS_RGB, 3, false, true, 0},
        {"inks", JCS_CMYK, 4, false, false, 0},         {"inks_progressive", JCS_CMYK, 4, true, false, 0}};
    for (const Kind& kind : kinds) {
        FILE* out = std::fopen(place(folder, "jpeg", kind.name).c_str(), "wb");
        jpeg_compress_struct info{};
        jpeg_error_mgr errors{};
        info.err = jpeg_std_error(&errors);
        jpeg_create_compress(&info);
        jpeg_stdio_dest(&info, out);
        info.image_width = width;
        info.image_height = height;
        info.input_components = kind.channels;
        info.in_color_space = kind.space;
        jpeg_set_defaults(&info);
        jpeg_set_quality(&info, 60, TRUE);
        if (kind.progressive) jpeg_simple_progression(&info);
        info.arith_code = kind.arithmetic ? TRUE : FALSE;
        info.restart_in_rows = kind.restart_rows;
        jpeg_start_compress(&info, TRUE);
        std::vector<JSAMPLE> row(static_cast<size_t>(width * kind.channels));
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width * kind.channels; ++x)
                row[static_cast<size_t>(x)] = sample(x / kind.channels, y, x % kind.channels);
            JSAMPROW pointer = row.data();
            jpeg_write_scanlines(&info, &pointer, 1);
        }
        jpeg_finish_compress(&info);
        jpeg_destroy_compress(&info);
        std::fclose(out);
    }
}

void write_webps(const fs::path& folder) {
    std::vector<uint8_t> rgba;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 4; ++c)
                rgba.push_back(sample(x, y, c));
        }
    }
    const auto keep = [&](const char* name, size_t size, uint8_t* bytes) {
        write(place(folder, "webp", name), {bytes, size});
        WebPFree(bytes);
    };
    uint8_t* bytes = nullptr;
    size_t size = WebPEncodeRGBA(rgba.data(), width, height, width * 4, 50.0f, &bytes);
    keep("lossy_alpha", size, bytes);
    size = WebPEncodeLosslessRGBA(rgba.data(), width, height, width * 4, &bytes);
    keep("lossless_alpha", size, bytes);
    for (size_t i = 3; i < rgba.size(); i += 4)
        rgba[i] = 255;
    size = WebPEncodeRGBA(rgba.data(), width, height, width * 4, 80.0f, &bytes);
    keep("lossy", size, bytes);
    // Few colours make a palette.
    for (uint8_t& value : rgba)
        value |= 0x3f;
    size = WebPEncodeLosslessRGBA(rgba.data(), width, height, width * 4, &bytes);
    keep("lossless_palette", size, bytes);
}

void write_linear(const fs::path& folder) {
    ImageRgba32f image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 4; ++c)
                image(x, y)[c] = static_cast<float>(sample(x, y, c)) / 60.0f;
        }
    }
    write_hdr(place(folder, "hdr", "coded"), image);
    write_hdr(place(folder, "hdr", "flat"), ImageRgba32f(5, 4, Vec4(0.5f)));
    // (1,1,1,n) repeats the pixel before n times.
    std::ofstream(place(folder, "hdr", "old_runs"), std::ios::binary)
        << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 6\n"
        << std::string("\x80\x40\x20\x81\x01\x01\x01\x05\x80\x40\x20\x81\x01\x01\x01\x05", 16);

    for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
        for (const bool tiled : {false, true}) {
            Imf::Header header(width, height);
            header.compression() = static_cast<Imf::Compression>(compression);
            const Imf::PixelType type = compression % 2 == 0 ? Imf::HALF : Imf::FLOAT;
            Imf::FrameBuffer buffer;
            std::vector<std::vector<uint32_t>> planes(3, std::vector<uint32_t>(width * height));
            for (int c = 0; c < 3; ++c) {
                std::vector<uint32_t>& plane = planes[static_cast<size_t>(c)];
                for (int i = 0; i < width * height; ++i) {
                    const float value = image(i % width, i / width)[c];
                    const half half_value(value);
                    if (type == Imf::FLOAT) std::memcpy(&plane[static_cast<size_t>(i)], &value, 4);
                    if (type == Imf::HALF) std::memcpy(&plane[static_cast<size_t>(i)], &half_value, 2);
                }
                const char* name = c == 0 ? "R" : c == 1 ? "G" : "B";
                header.channels().insert(name, Imf::Channel(type));
                buffer.insert(name, Imf::Slice(type, reinterpret_cast<char*>(plane.data()), 4, 4 * width));
            }
            const std::string name = "compression" + std::to_string(compression) + (tiled ? "_tiled" : "");
            const std::string file = place(folder, "exr", name).string();
            if (tiled) {
                header.setTileDescription(Imf::TileDescription(8, 8, Imf::ONE_LEVEL));
                Imf::TiledOutputFile out(file.c_str(), header);
                out.setFrameBuffer(buffer);
                out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
            } else {
                Imf::OutputFile out(file.c_str(), header);
                out.setFrameBuffer(buffer);
                out.writePixels(height);
            }
        }
    }
}

// Inputs of meshopt_target.cpp: mode, filter, stride, count, stream.
void write_meshopt(const fs::path& folder) {
    constexpr size_t count = 24;
    const auto keep = [&](const std::string& name, int mode, int filter, size_t stride,
                          std::span<const unsigned char> stream) {
        std::vector<uint8_t> input = {static_cast<uint8_t>(mode), static_cast<uint8_t>(filter),
                                      static_cast<uint8_t>(stride), count, 0};
        input.insert(input.end(), stream.begin(), stream.end());
        write(place(folder, "meshopt", name), input);
    };
    struct Kind {
        int filter;
        size_t stride;
    };
    for (const Kind& kind : {Kind{0, 4}, Kind{0, 12}, Kind{0, 64}, Kind{1, 4}, Kind{1, 8}, Kind{2, 8}, Kind{3, 16},
                             Kind{4, 4}, Kind{4, 8}}) {
        std::vector<unsigned char> vertices;
        for (size_t i = 0; i < count * kind.stride; ++i)
            vertices.push_back(sample(static_cast<int>(i), 3, 0));
        std::vector<unsigned char> stream(meshopt_encodeVertexBufferBound(count, kind.stride));
        stream.resize(meshopt_encodeVertexBuffer(stream.data(), stream.size(), vertices.data(), count, kind.stride));
        keep("attributes" + std::to_string(kind.filter) + "_" + std::to_string(kind.stride), 0, kind.filter,
             kind.stride, stream);
    }
    std::vector<unsigned int> indices;
    for (unsigned int i = 0; i < count; ++i)
        indices.push_back((i / 3 + i % 3) % 10);
    std::vector<unsigned char> stream(meshopt_encodeIndexBufferBound(count, count));
    stream.resize(meshopt_encodeIndexBuffer(stream.data(), stream.size(), indices.data(), count));
    for (const size_t stride : {size_t{2}, size_t{4}})
        keep("triangles" + std::to_string(stride), 1, 0, stride, stream);
    stream.resize(meshopt_encodeIndexSequenceBound(count, count));
    stream.resize(meshopt_encodeIndexSequence(stream.data(), stream.size(), indices.data(), count));
    for (const size_t stride : {size_t{2}, size_t{4}})
        keep("indices" + std::to_string(stride), 2, 0, stride, stream);
}

void write_draco(const fs::path& folder) {
    for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        constexpr int faces = 12;
        draco::TriangleSoupMeshBuilder builder;
        builder.Start(faces);
        const int positions = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
        const int colors = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8);
        for (int f = 0; f < faces; ++f) {
            // A strip of triangles.
            float position[3][3];
            uint8_t color[3][4];
            for (int corner = 0; corner < 3; ++corner) {
                for (int i = 0; i < 3; ++i)
                    position[corner][i] = static_cast<float>((f + corner) * (i + 1) % 7);
                for (int i = 0; i < 4; ++i)
                    color[corner][i] = sample(f + corner, i, 0);
            }
            builder.SetAttributeValuesForFace(positions, draco::FaceIndex(static_cast<uint32_t>(f)), position[0],
                                              position[1], position[2]);
            builder.SetAttributeValuesForFace(colors, draco::FaceIndex(static_cast<uint32_t>(f)), color[0], color[1],
                                              color[2]);
        }
        draco::Encoder encoder;
        encoder.SetEncodingMethod(method);
        encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 11);
        draco::EncoderBuffer buffer;
        if (!encoder.EncodeMeshToBuffer(*builder.Finalize(), &buffer).ok()) std::abort();
        write(place(folder, "draco", method == draco::MESH_SEQUENTIAL_ENCODING ? "sequential" : "edgebreaker"),
              {reinterpret_cast<const uint8_t*>(buffer.data()), buffer.size()});
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: make_seeds FOLDER\n");
        return 2;
    }
    const fs::path folder = argv[1];
    write_pngs(folder);
    write_jpegs(folder);
    write_webps(folder);
    write_linear(folder);
    write_meshopt(folder);
    write_draco(folder);
    return 0;
}
