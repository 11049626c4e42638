// SPDX-License-Identifier: MIT
#include "renderer/image/ktx2_container.h"

#include <bit>

#include "renderer/image/byte_order.h"
#include "renderer/image/codecs.h"

namespace candela {

namespace {

[[noreturn]] void throw_broken(const std::string& what) {
    throw ImageError("broken KTX2: " + what);
}

[[noreturn]] void throw_forbidden(const std::string& what) {
    throw ImageError("the KTX2 file " + what + ", which KHR_texture_basisu does not allow");
}

std::span<const std::byte> section(std::span<const std::byte> file, uint64_t offset, uint64_t length,
                                   const std::string& name) {
    if (offset > file.size() || length > file.size() - offset) throw_broken(name + " lies outside of the file");
    return file.subspan(offset, length);
}

enum class Supercompression : uint32_t { none = 0, basis_lz = 1, zstandard = 2 };

// KTX 2.0, "Header": what precedes the level index.
struct Header {
    static constexpr size_t bytes = 80;
    explicit Header(std::span<const std::byte> file) : raw(section(file, 0, bytes, "the header")) {}
    uint32_t field(size_t index) const { return read_u32(raw, 12 + 4 * index); }

    std::span<const std::byte> raw;
    uint32_t vk_format = field(0), type_size = field(1);
    uint32_t width = field(2), height = field(3), depth = field(4);
    uint32_t layers = field(5), faces = field(6), levels = field(7);
    Supercompression supercompression{field(8)};
    uint32_t descriptor_offset = field(9), descriptor_length = field(10);
    uint32_t text_offset = field(11), text_length = field(12);
    uint64_t global_offset = read_u64(raw, 64), global_length = read_u64(raw, 72);
};

// The extension's "2D" type, and no format but Basis Universal.
void check_type(const Header& header) {
    if (header.vk_format != 0) throw_forbidden("holds Vulkan format " + std::to_string(header.vk_format));
    if (header.height == 0) throw_forbidden("is a one-dimensional texture");
    if (header.depth != 0) throw_forbidden("is a three-dimensional texture");
    if (header.faces == 6) throw_forbidden("is a cube map");
    if (header.faces != 1) throw_broken("it has " + std::to_string(header.faces) + " faces");
    if (header.layers > 1) throw_forbidden("is an array of " + std::to_string(header.layers) + " textures");
    if (header.supercompression > Supercompression::zstandard) {
        throw_forbidden("has supercompression scheme " + std::to_string(header.field(8)));
    }
}

// Khronos Data Format Specification, "Basic descriptor".
void read_descriptor(std::span<const std::byte> file, const Header& header, Ktx2File& out) {
    constexpr size_t total_bytes = 4, block_header_bytes = 24, sample_bytes = 16;
    const auto whole = section(file, header.descriptor_offset, header.descriptor_length, "the data format descriptor");
    if (whole.size() < total_bytes + block_header_bytes) throw_broken("the data format descriptor is too short");
    const auto block = whole.subspan(total_bytes);
    if (read_u32(block, 0) != 0) throw_broken("the first data format descriptor is not the basic one");
    const size_t block_bytes = read_u16(block, 6);
    if (block_bytes > block.size() || block_bytes < block_header_bytes + sample_bytes)
        throw_broken("the data format descriptor has an impossible size");
    const size_t samples = (block_bytes - block_header_bytes) / sample_bytes;
    const auto channel = [&](size_t sample) {
        return read_u16(block, block_header_bytes + sample * sample_bytes + 2) >> 8 & 15u;
    };

    const auto model = static_cast<uint8_t>(block[8]), transfer = static_cast<uint8_t>(block[10]);
    const auto flags = static_cast<uint8_t>(block[11]);
    constexpr uint8_t model_etc1s = 163, model_uastc = 166;
    constexpr uint8_t last_transfer = 2, flag_premultiplied = 1;
    if (transfer > last_transfer) throw_forbidden("has transfer function " + std::to_string(transfer));
    if ((flags & flag_premultiplied) != 0) throw_forbidden("has premultiplied alpha");
    out.transfer = Ktx2File::Transfer{transfer};

    using Channels = Ktx2File::Channels;
    const std::string odd_channels = "has channels of another kind than RGB, RGBA, red or red-green";
    if (model == model_etc1s) {
        out.blocks = Ktx2File::Blocks::etc1s;
        if (header.supercompression != Supercompression::basis_lz) throw_forbidden("holds ETC1S without BasisLZ");
        constexpr unsigned rgb = 0, red = 3, green = 4, alpha = 15;
        const unsigned first = channel(0);
        if (samples == 1 && (first == rgb || first == red)) {
            out.channels = first == rgb ? Channels::rgb : Channels::red;
        } else if (samples == 2 && first == rgb && channel(1) == alpha) {
            out.channels = Channels::rgba;
        } else if (samples == 2 && first == red && channel(1) == green) {
            out.channels = Channels::red_green;
        } else {
            throw_forbidden(odd_channels);
        }
    } else if (model == model_uastc) {
        out.blocks = Ktx2File::Blocks::uastc;
        if (header.supercompression == Supercompression::basis_lz) throw_forbidden("holds UASTC under BasisLZ");
        out.zstandard = header.supercompression == Supercompression::zstandard;
        constexpr unsigned rgb = 0, rgba = 3, red = 4, red_green = 6;
        if (samples != 1) throw_forbidden(odd_channels);
        switch (channel(0)) {
            case rgb:
                out.channels = Channels::rgb;
                break;
            case rgba:
                out.channels = Channels::rgba;
                break;
            case red:
                out.channels = Channels::red;
                break;
            case red_green:
                out.channels = Channels::red_green;
                break;
            default:
                throw_forbidden(odd_channels);
        }
    } else {
        throw_forbidden("holds colour model " + std::to_string(model));
    }
}

// "Key/Value Data": pairs of text, each with its length and padded to 4 bytes. Only two of the keys matter.
void check_texts(std::span<const std::byte> file, const Header& header) {
    auto rest = section(file, header.text_offset, header.text_length, "the key/value data");
    while (rest.size() >= 4) {
        const uint32_t length = read_u32(rest, 0);
        const auto bytes = section(rest.subspan(4), 0, length, "an entry of the key/value data");
        const std::string_view entry(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        const size_t end_of_key = std::min(entry.find('\0'), entry.size());
        const std::string_view key = entry.substr(0, end_of_key);
        std::string_view value = entry.substr(std::min(end_of_key + 1, entry.size()));
        value = value.substr(0, value.find('\0'));
        if (key == "KTXorientation" && value != "rd") throw_forbidden("is not oriented right and down");
        if (key == "KTXswizzle" && value != "rgba") throw_forbidden("has its channels swizzled");
        rest = rest.subspan(std::min<size_t>(rest.size(), 4 + (size_t{length} + 3) / 4 * 4));
    }
}

// "Level Index".
void read_levels(std::span<const std::byte> file, const Header& header, Ktx2File& out) {
    constexpr size_t entry_bytes = 24;
    const uint32_t count = std::max(header.levels, 1u);
    const uint32_t largest = std::max(header.width, header.height);
    if (count > static_cast<uint32_t>(std::bit_width(largest))) {
        throw_broken("it has " + std::to_string(count) + " mip levels, more than its size allows");
    }
    const auto index = section(file, Header::bytes, count * entry_bytes, "the level index");
    for (uint32_t i = 0; i < count; ++i) {
        const auto entry = index.subspan(i * entry_bytes, entry_bytes);
        Ktx2File::Level level;
        level.data = section(file, read_u64(entry, 0), read_u64(entry, 8), "mip level " + std::to_string(i));
        level.uncompressed_bytes = read_u64(entry, 16);
        level.width = static_cast<int>(std::max(header.width >> i, 1u));
        level.height = static_cast<int>(std::max(header.height >> i, 1u));
        out.levels.push_back(level);
    }
}

}  // namespace

Ktx2File parse_ktx2(std::span<const std::byte> bytes, const DecodeLimits& limits) {
    if (sniff_format(bytes) != ImageFormat::ktx2) throw_broken("it does not begin with the identifier of KTX 2.0");
    const Header header(bytes);
    check_type(header);
    check_size(header.width, header.height, limits);
    Ktx2File out;
    read_descriptor(bytes, header, out);
    check_texts(bytes, header);
    read_levels(bytes, header, out);
    if (out.blocks == Ktx2File::Blocks::etc1s)
        out.global_data = section(bytes, header.global_offset, header.global_length, "the global data");
    return out;
}

}  // namespace candela
