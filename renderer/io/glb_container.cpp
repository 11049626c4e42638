// SPDX-License-Identifier: MIT
#include "renderer/io/glb_container.h"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace candela {
namespace {

constexpr uint32_t magic_gltf = 0x46546C67u;
constexpr uint32_t chunk_json = 0x4E4F534Au;
constexpr uint32_t chunk_bin = 0x004E4942u;
constexpr size_t header_bytes = 12;
constexpr size_t chunk_header_bytes = 8;

// Little-endian, whatever the machine is.
uint32_t read_u32(std::span<const std::byte> bytes, size_t at) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i)
        value |= std::to_integer<uint32_t>(bytes[at + i]) << (8 * i);
    return value;
}

}  // namespace

bool looks_like_glb(std::span<const std::byte> bytes) {
    return bytes.size() >= 4 && read_u32(bytes, 0) == magic_gltf;
}

GlbChunks parse_glb(std::span<const std::byte> bytes) {
    if (bytes.size() < header_bytes) throw std::runtime_error("GLB header is cut off");
    const uint32_t version = read_u32(bytes, 4);
    if (version != 2) throw std::runtime_error("GLB version " + std::to_string(version) + " is not supported, only 2");
    const size_t length = read_u32(bytes, 8);
    if (length > bytes.size()) {
        throw std::runtime_error("GLB header declares " + std::to_string(length) + " bytes, the file has " +
                                 std::to_string(bytes.size()) + "; it is probably truncated");
    }
    if (length < header_bytes + chunk_header_bytes) throw std::runtime_error("GLB has no JSON chunk");

    GlbChunks chunks;
    size_t at = header_bytes;
    for (size_t index = 0; at + chunk_header_bytes <= length; ++index) {
        const size_t size = read_u32(bytes, at);
        const uint32_t type = read_u32(bytes, at + 4);
        at += chunk_header_bytes;
        if (size > length - at) {
            throw std::runtime_error("GLB chunk " + std::to_string(index) + " of " + std::to_string(size) +
                                     " bytes reaches past the end of the file");
        }
        const std::span<const std::byte> data = bytes.subspan(at, size);
        if (index == 0) {
            if (type != chunk_json) throw std::runtime_error("the first GLB chunk is not JSON");
            chunks.json = {reinterpret_cast<const char*>(data.data()), data.size()};
        } else if (type == chunk_bin && !chunks.bin) {
            chunks.bin = data;
        }
        // Chunks are padded to 4 bytes; writers that forget to are forgiven, as the size says where the next begins.
        at += size;
    }
    return chunks;
}

}  // namespace candela
