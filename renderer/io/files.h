// SPDX-License-Identifier: MIT
// The only way a glTF file reaches other files: names inside its own directory, and data: URIs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/image/image.h"

namespace candela {

// Bytes that are written right after there is memory for them, and so need no zeros first.
using RawBytes = std::vector<std::byte, UnfilledAllocator<std::byte>>;

// what() is the reason, one line.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class AssetFiles {
  public:
    // The directory of the asset, symbolic links resolved.
    explicit AssetFiles(const std::filesystem::path& asset);

    // The regular file that a relative URI names (percent-encoding decoded). Throws FileError where it has a scheme, is
    // absolute, leads outside the directory (also through symbolic links), or does not exist.
    std::filesystem::path resolve(std::string_view uri) const;
    // Where that file is or should be; empty where no file of the asset can have that name.
    std::filesystem::path place_of(std::string_view uri) const noexcept;

  private:
    std::filesystem::path directory_;
};

// Bytes of a regular file (devices and pipes are refused). Throws FileError.
uint64_t file_size_bytes(const std::filesystem::path& file);
// The first most_bytes of it, or all; on_all_cores: in pieces at the same time.
RawBytes read_file(const std::filesystem::path& file, uint64_t most_bytes = std::numeric_limits<uint64_t>::max(),
                   bool on_all_cores = false);

bool is_data_uri(std::string_view uri);
// An upper bound of the decoded size, to book memory before decoding.
uint64_t data_uri_bound_bytes(std::string_view uri);
// base64 or percent-encoded, any media type. Throws FileError.
RawBytes decode_data_uri(std::string_view uri);

std::string percent_decode(std::string_view text);

}  // namespace candela
