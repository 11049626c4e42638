// SPDX-License-Identifier: MIT
// The GLB container (glTF 2.0, section 4): a 12-byte header, a JSON chunk, an optional BIN chunk.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace candela {

struct GlbChunks {
    std::string_view json;
    std::optional<std::span<const std::byte>> bin;  // with its padding
};

bool looks_like_glb(std::span<const std::byte> bytes);

// Views into bytes. Chunks of unknown type are skipped, as the specification asks; bytes after the declared length are
// not read. Throws std::runtime_error with the reason.
GlbChunks parse_glb(std::span<const std::byte> bytes);

}  // namespace candela
