// SPDX-License-Identifier: MIT
// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/image/codec.h"

namespace candela {

// Writes the bytes to a new file beside path, flushes it to the disk and renames it to path. On failure the new file is
// removed, whatever stood at path stays, and ImageError names the reason.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

// The whole of a regular file: pipes and devices may never end. Throws ImageError, also where it has more bytes than
// the memory limit.
std::vector<std::byte> read_file(const std::filesystem::path& path, const DecodeLimits& limits = {});

}  // namespace candela
