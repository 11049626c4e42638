// SPDX-License-Identifier: MIT
// "OpenEXR File Layout" (openexr.com): magic, version, then each part's attributes as name, type, size and value.
#include "renderer/image/exr_header.h"

#include <cstring>

#include "renderer/image/codecs.h"

namespace candela {

namespace {

[[noreturn]] void fail(const char* what) {
    throw ImageError(std::string("broken EXR: ") + what);
}

class Reader {
  public:
    explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

    std::span<const std::byte> take(uint64_t count) {
        if (count > rest_.size()) fail("its header declares more bytes than there are");
        const std::span<const std::byte> out = rest_.first(count);
        rest_ = rest_.subspan(count);
        return out;
    }
    uint32_t u32() {
        uint32_t value = 0;
        for (int i = 0; const std::byte b : take(4))
            value |= std::to_integer<uint32_t>(b) << (8 * i++);
        return value;
    }
    std::string name() {
        constexpr size_t longest = 255;
        std::string out;
        for (;;) {
            const char c = std::to_integer<char>(take(1).front());
            if (c == '\0') return out;
            if (out.size() == longest) fail("a name in its header has no end");
            out.push_back(c);
        }
    }

    bool empty() const { return rest_.empty(); }

  private:
    std::span<const std::byte> rest_;
};

struct Window {
    int64_t width = 0, height = 0;
};

Window read_window(std::span<const std::byte> value) {
    if (value.size() != 16) fail("its data window has another size");
    Reader reader(value);
    int32_t side[4];  // left, top, right, bottom; both ends belong to it
    for (int32_t& each : side)
        each = static_cast<int32_t>(reader.u32());
    return {std::max<int64_t>(int64_t{side[2]} - side[0] + 1, 0), std::max<int64_t>(int64_t{side[3]} - side[1] + 1, 0)};
}

// Bytes of one pixel in all channels.
uint64_t read_channels(std::span<const std::byte> value) {
    Reader reader(value);
    uint64_t bytes = 0;
    while (!reader.name().empty()) {
        const uint32_t type = reader.u32();
        bytes += type == 1 ? 2 : 4;  // half, else float or unsigned integer
        reader.take(4);              // whether it is linear, and padding
        // Sampled more sparsely than the picture: no picture with R, G, B is, and the decoder divides by it.
        if (reader.u32() != 1 || reader.u32() != 1) fail("its channels are subsampled, which is not read");
    }
    if (!reader.empty()) fail("its list of channels ends early");
    return bytes;
}

// The library reads as many bytes as a type has, whatever the attribute says: where they differ, it would go on in the
// midst of the next attribute.
struct FixedType {
    std::string_view name;
    size_t size;
};
constexpr FixedType fixed_types[] = {{"box2f", 16},
                                     {"box2i", 16},
                                     {"chromaticities", 32},
                                     {"compression", 1},
                                     {"deepImageState", 1},
                                     {"double", 8},
                                     {"envmap", 1},
                                     {"float", 4},
                                     {"int", 4},
                                     {"keycode", 28},
                                     {"lineOrder", 1},
                                     {"m33d", 72},
                                     {"m33f", 36},
                                     {"m44d", 128},
                                     {"m44f", 64},
                                     {"rational", 8},
                                     {"tiledesc", 9},
                                     {"timecode", 8},
                                     {"v2d", 16},
                                     {"v2f", 8},
                                     {"v2i", 8},
                                     {"v3d", 24},
                                     {"v3f", 12},
                                     {"v3i", 12}};

void check_value(std::string_view type, std::span<const std::byte> value) {
    for (const FixedType& fixed : fixed_types) {
        if (type == fixed.name && value.size() != fixed.size) fail("an attribute has another size than its type");
    }
    if (type == "preview") {
        Reader reader(value);
        const uint64_t width = reader.u32(), height = reader.u32();
        if (width > value.size() || height > value.size() || 8 + 4 * width * height != value.size())
            fail("its preview has another size");
    } else if (type == "stringvector") {
        for (Reader reader(value); !reader.empty();)
            reader.take(reader.u32());
    } else if (type == "floatvector") {
        if (value.size() % 4 != 0) fail("an attribute has another size than its type");
    } else if (type == "idmanifest") {
        fail("it has a manifest of deep data, which is not read");
    }
}

}  // namespace

void check_exr_header(std::span<const std::byte> bytes, const DecodeLimits& limits) {
    Reader reader(bytes);
    reader.u32();
    const uint32_t version = reader.u32();
    constexpr uint32_t deep = 0x800, several_parts = 0x1000;
    if ((version & 0xff) != 2) fail("its version is not 2");
    if ((version & deep) != 0) fail("it holds deep data, which is not read");
    if ((version & several_parts) != 0) fail("it has several parts, which are not read");

    std::optional<Window> window;
    uint64_t pixel_bytes = 0;
    std::optional<Window> tile;
    for (std::string name = reader.name(); !name.empty(); name = reader.name()) {
        const std::string type = reader.name();
        const std::span<const std::byte> value = reader.take(reader.u32());
        check_value(type, value);
        if (name == "dataWindow" && type == "box2i") window = read_window(value);
        if (type == "chlist") pixel_bytes = std::max(pixel_bytes, read_channels(value));
        if (name == "tiles" && type == "tiledesc") {
            Reader sides(value);
            const int64_t width = sides.u32(), height = sides.u32();
            tile = Window{width, height};
        }
    }
    if (!window) fail("it has no data window");
    check_size(static_cast<uint64_t>(window->width), static_cast<uint64_t>(window->height), limits, sizeof(Vec4));

    // What the decoder holds at once: the lines of one compressed block (256 at most, with DWAB), or a row of tiles.
    constexpr int64_t most_lines = 256;
    uint64_t held = static_cast<uint64_t>(window->width * std::min(window->height, most_lines));
    if (tile) {
        if (tile->width == 0 || tile->height == 0) fail("its tiles have no pixels");
        check_size(static_cast<uint64_t>(tile->width), static_cast<uint64_t>(tile->height), limits);
        const int64_t across = (window->width + tile->width - 1) / tile->width;
        const int64_t down = (window->height + tile->height - 1) / tile->height;
        if (static_cast<uint64_t>(across * down) > bytes.size() / sizeof(uint64_t)) fail("it has too few tiles");
        held = static_cast<uint64_t>(across * tile->width * tile->height);
    }
    if (pixel_bytes != 0 && held > limits.max_memory_bytes / pixel_bytes) {
        throw ImageError("its channels take " + std::to_string(pixel_bytes) +
                         " bytes for each pixel, too many for the " + std::to_string(limits.max_memory_bytes) +
                         " bytes of the memory limit; --limit-memory raises it");
    }
}

}  // namespace candela
