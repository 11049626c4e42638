// SPDX-License-Identifier: MIT
// URIs of buffers and images: data: URIs, percent-encoding, and names that must not leave their folder.
#include <filesystem>
#include <fstream>

#include "renderer/io/files.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace candela;

// A folder with two files in it and one outside, made once.
struct Folder {
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "candela_fuzz_XXXXXX").string();
        fuzz::require(mkdtemp(name.data()) != nullptr, "a temporary folder can be made");
        root = std::filesystem::canonical(name);
        inside = root / "inside";
        std::filesystem::create_directories(inside / "b");
        for (const auto& file : {root / "secret", inside / "a", inside / "b" / "c d"})
            std::ofstream(file) << "x";
        std::filesystem::create_symlink("../secret", inside / "way_out");
        std::filesystem::create_symlink("loop", inside / "loop");
    }
    ~Folder() { std::filesystem::remove_all(root); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::filesystem::path root, inside;
};

void decode(std::string_view uri) {
    fuzz::require(percent_decode(uri).size() <= uri.size(), "percent-decoding never lengthens");
    if (!is_data_uri(uri)) return;
    try {
        fuzz::require(decode_data_uri(uri).size() <= data_uri_bound_bytes(uri), "the booked memory suffices");
    } catch (const FileError&) {
        return;
    }
}

void resolve(std::string_view uri) {
    static const Folder folder;
    static const AssetFiles files(folder.inside / "scene.gltf");
    try {
        const std::string found = files.resolve(uri).string();
        fuzz::require(found.starts_with(folder.inside.string() + "/"), "only files inside of the folder are found");
        fuzz::require(file_size_bytes(found) == 1, "what is found can be read");
    } catch (const FileError& error) {
        fuzz::require(std::string_view(error.what()).size() < 400, "messages are short");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view uri = fuzz::text_of(data, size);
    decode(uri);
    resolve(uri);
    return 0;
}
