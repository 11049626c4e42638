// SPDX-License-Identifier: MIT
// A model in other forms: in one .glb, with everything in data URIs, meshopt-compressed, with WebP textures. None of
// them loses anything, so that all must load as the same scene.
#pragma once

#include <filesystem>

#include "tests/io/raw_gltf.h"

namespace candela::test {

class Repacker {
  public:
    explicit Repacker(const std::filesystem::path& file);

    // Each writes files to the folder and returns the one to load.
    std::filesystem::path as_glb(const std::filesystem::path& folder) const;
    std::filesystem::path as_embedded(const std::filesystem::path& folder) const;
    std::filesystem::path as_meshopt(const std::filesystem::path& folder) const;
    // Only the textures that are PNGs are replaced.
    std::filesystem::path as_webp(const std::filesystem::path& folder) const;

    size_t png_count() const;

  private:
    using Json = RawGltf::Json;

    // The document with its pictures outside of its buffers: URIs replaced by those of `uri_of`.
    Json with_images(const std::vector<std::string>& uris) const;
    std::vector<std::string> write_images(const std::filesystem::path& folder) const;

    RawGltf gltf_;
    std::vector<std::string> images_;  // bytes of each picture
};

}  // namespace candela::test
