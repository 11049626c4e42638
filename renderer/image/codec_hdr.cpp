// SPDX-License-Identifier: MIT
// Radiance .hdr (RGBE): G. Ward, "Real Pixels", Graphics Gems II; the adaptive run-length coding of Radiance's color.c.
#include <cmath>
#include <cstring>

#include "renderer/image/atomic_file.h"
#include "renderer/image/codecs.h"

namespace candela {

namespace {

using Rgbe = glm::u8vec4;

class HdrReader {
  public:
    explicit HdrReader(std::span<const std::byte> bytes) : rest_(bytes) {}

    std::string line() {
        std::string out;
        for (;;) {
            const auto c = static_cast<char>(byte());
            if (c == '\n') return out;
            if (out.size() > 4096) throw ImageError("broken HDR: a header line without end");
            out.push_back(c);
        }
    }
    uint8_t byte() {
        if (rest_.empty()) throw ImageError("broken HDR: it ends too early");
        const auto value = static_cast<uint8_t>(rest_.front());
        rest_ = rest_.subspan(1);
        return value;
    }
    std::span<const std::byte> rest() const { return rest_; }

  private:
    std::span<const std::byte> rest_;
};

Vec3 decode_rgbe(const Rgbe& p) {
    return p.a == 0 ? Vec3(0) : (Vec3(p)) * std::ldexp(1.0f, static_cast<int>(p.a) - 136);
}

Rgbe encode_rgbe(const Vec3& radiance) {
    const Vec3 c = glm::max(radiance, Vec3(0));
    const float largest = max_component(c);
    if (!(largest > 1e-32f)) return Rgbe(0);
    int exponent = 0;
    std::frexp(largest, &exponent);
    const float scale = std::ldexp(1.0f, 8 - exponent);
    const Vec3 mantissa = glm::min(glm::floor(c * scale), Vec3(255));
    return {static_cast<uint8_t>(mantissa.x), static_cast<uint8_t>(mantissa.y), static_cast<uint8_t>(mantissa.z),
            static_cast<uint8_t>(std::clamp(exponent + 128, 0, 255))};
}

// One scanline whose four components are run-length coded one after the other.
void read_new_scanline(HdrReader& reader, std::vector<Rgbe>& row) {
    for (int component = 0; component < 4; ++component) {
        size_t x = 0;
        while (x < row.size()) {
            const uint8_t code = reader.byte();
            const bool run = code > 128;
            const size_t count = run ? code - 128u : code;
            if (count == 0 || x + count > row.size()) throw ImageError("broken HDR: a run leaves its line");
            uint8_t value = run ? reader.byte() : uint8_t{0};
            for (size_t k = 0; k < count; ++k, ++x)
                row[x][component] = run ? value : (value = reader.byte());
        }
    }
}

// Flat pixels, or the old coding: (1,1,1,n) repeats the pixel before n times, shifted by 8 bits for each repetition in
// a row.
void read_old_scanline(HdrReader& reader, std::vector<Rgbe>& row, Rgbe first) {
    size_t x = 0;
    unsigned shift = 0;
    Rgbe pixel = first;
    for (;;) {
        if (pixel.r == 1 && pixel.g == 1 && pixel.b == 1 && x > 0) {
            const size_t count = shift < 24 ? size_t{pixel.a} << shift : row.size() + 1;
            if (x + count > row.size()) throw ImageError("broken HDR: a run leaves its line");
            for (size_t k = 0; k < count; ++k, ++x)
                row[x] = row[x - 1];
            shift += 8;
        } else {
            row[x++] = pixel;
            shift = 0;
        }
        if (x >= row.size()) return;
        for (int c = 0; c < 4; ++c)
            pixel[c] = reader.byte();
    }
}

}  // namespace

ImageRgba32f decode_hdr(std::span<const std::byte> bytes, const DecodeLimits& limits) {
    HdrReader reader(bytes);
    bool rgbe = false;
    for (std::string line = reader.line(); !line.empty(); line = reader.line()) {
        if (line.starts_with("FORMAT=")) rgbe = line == "FORMAT=32-bit_rle_rgbe";
    }
    if (!rgbe) throw ImageError("broken HDR: its FORMAT is not 32-bit_rle_rgbe");
    int width = 0, height = 0;
    if (std::sscanf(reader.line().c_str(), "-Y %d +X %d", &height, &width) != 2 || width <= 0 || height <= 0) {
        throw ImageError("broken HDR: its size line is not of the form -Y H +X W");
    }
    check_size(static_cast<uint64_t>(width), static_cast<uint64_t>(height), limits, sizeof(Vec4));
    // Even the best run-length coding needs a few bytes a line.
    if (reader.rest().size() < static_cast<size_t>(height)) throw ImageError("broken HDR: it ends too early");

    ImageRgba32f out(width, height);
    std::vector<Rgbe> row(static_cast<size_t>(width));
    for (int y = 0; y < height; ++y) {
        Rgbe first;
        for (int c = 0; c < 4; ++c)
            first[c] = reader.byte();
        const bool coded = first.r == 2 && first.g == 2 && (first.b & 0x80) == 0 && width >= 8 && width < 32768;
        if (coded) {
            if ((first.b << 8 | first.a) != width) throw ImageError("broken HDR: a line has another width");
            read_new_scanline(reader, row);
        } else {
            read_old_scanline(reader, row, first);
        }
        for (int x = 0; x < width; ++x)
            out(x, y) = Vec4(decode_rgbe(row[static_cast<size_t>(x)]), 1.0f);
    }
    return out;
}

void write_hdr(const std::filesystem::path& path, const ImageRgba32f& image) {
    std::string out = "#?RADIANCE\nSOFTWARE=candela\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(image.height()) +
                      " +X " + std::to_string(image.width()) + "\n";
    // Lines of a width that readers expect to be coded are coded, as literals, so that no pixel can look like a code.
    const int width = image.width();
    const bool coded = width >= 8 && width < 32768;
    std::vector<Rgbe> row(static_cast<size_t>(width));
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < width; ++x)
            row[static_cast<size_t>(x)] = encode_rgbe(Vec3(image(x, y)));
        if (!coded) {
            for (const Rgbe& p : row)
                out.append(
                    {static_cast<char>(p.r), static_cast<char>(p.g), static_cast<char>(p.b), static_cast<char>(p.a)});
            continue;
        }
        out.append({2, 2, static_cast<char>(width >> 8), static_cast<char>(width & 0xff)});
        for (int component = 0; component < 4; ++component) {
            for (int x = 0; x < width; x += 128) {
                const int count = std::min(128, width - x);
                out.push_back(static_cast<char>(count));
                for (int k = x; k < x + count; ++k)
                    out.push_back(static_cast<char>(row[static_cast<size_t>(k)][component]));
            }
        }
    }
    write_file_atomically(path, out);
}

}  // namespace candela
