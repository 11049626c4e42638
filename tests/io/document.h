// SPDX-License-Identifier: MIT
// glTF documents made in a test: a minimal valid one whose parts can be changed, written to a folder of its own.
#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "renderer/io/load_gltf.h"
#include "tests/support/temporary_folder.h"

namespace candela::test {

using Json = nlohmann::json;

inline constexpr int i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126;

// The document and the bytes of its buffer 0.
class Document {
  public:
    Document() {
        json["asset"] = {{"version", "2.0"}};
        json["scene"] = 0;
        json["scenes"] = {{{"nodes", {0}}}};
        json["nodes"] = {{{"mesh", 0}}};
        json["meshes"] = Json::array();
    }

    // A triangle (0,0,0) (1,0,0) (0,1,0) with indices 0 1 2: accessors 0 and 1, mesh 0.
    static Document triangle() {
        Document document;
        const int positions = document.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", f32);
        const int indices = document.add_accessor<uint16_t>({0, 1, 2}, "SCALAR", u16);
        document.add_primitive({{"POSITION", positions}}, indices);
        return document;
    }

    int add_view(const void* data, size_t size, int stride = 0) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        Json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}};
        if (stride != 0) view["byteStride"] = stride;
        const auto* first = static_cast<const char*>(data);
        bytes.insert(bytes.end(), first, first + size);
        json["bufferViews"].push_back(view);
        return static_cast<int>(json["bufferViews"].size()) - 1;
    }
    template <typename T>
    int add_accessor(const std::vector<T>& values, const std::string& type, int component_type, Json more = {}) {
        const size_t each = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
        Json accessor = {{"bufferView", add_view(values.data(), values.size() * sizeof(T))},
                         {"componentType", component_type},
                         {"count", values.size() / each},
                         {"type", type}};
        if (!more.is_null()) accessor.update(more);
        json["accessors"].push_back(accessor);
        return static_cast<int>(json["accessors"].size()) - 1;
    }
    // Into a new mesh.
    Json& add_primitive(const Json& attributes, int indices = -1, Json more = {}) {
        Json primitive = {{"attributes", attributes}};
        if (indices >= 0) primitive["indices"] = indices;
        if (!more.is_null()) primitive.update(more);
        json["meshes"].push_back({{"primitives", Json::array({primitive})}});
        return json["meshes"].back()["primitives"][0];
    }

    void finish(const std::string& uri) {
        if (bytes.empty()) return;
        json["buffers"] = {{{"byteLength", bytes.size()}}};
        if (!uri.empty()) json["buffers"][0]["uri"] = uri;
    }

    Json json;
    std::vector<char> bytes;
};

inline std::string u32_text(size_t value) {
    std::string out(4, '\0');
    for (int i = 0; i < 4; ++i)
        out[static_cast<size_t>(i)] = static_cast<char>(value >> (8 * i));
    return out;
}

inline std::string glb_bytes(std::string text, std::string bin) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    bin.resize((bin.size() + 3) / 4 * 4, '\0');
    std::string body = u32_text(text.size()) + "JSON" + text;
    if (!bin.empty()) body += u32_text(bin.size()) + std::string("BIN\0", 4) + bin;
    return "glTF" + u32_text(2) + u32_text(12 + body.size()) + body;
}

class GltfTest : public ::testing::Test {
  protected:
    void SetUp() override { options_.decode_images = false; }

    std::filesystem::path write(const std::string& name, const std::string& text) const {
        // A new file each time: overwriting one makes some file systems wait for the disk.
        std::filesystem::remove(folder_ / name);
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    Scene load_file(const std::filesystem::path& path) {
        diagnostics_ = {};
        return load_gltf(path, diagnostics_, options_);
    }
    // As a .gltf with its bytes in data.bin.
    Scene load(Document document) {
        document.finish("data.bin");
        write("data.bin", {document.bytes.begin(), document.bytes.end()});
        return load_file(write("scene.gltf", document.json.dump()));
    }
    // "WHERE: REASON" of the error, or "loaded".
    std::string failure(const Document& document) {
        return failure_of([&] { load(document); });
    }
    std::string failure_of_text(const std::string& text) {
        return failure_of([&] { load_file(write("scene.gltf", text)); });
    }
    template <typename Action>
    std::string failure_of(const Action& action) {
        try {
            action();
        } catch (const LoadError& error) {
            EXPECT_EQ(std::string(error.what()).find(folder_.string()), 0u) << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            return error.where() + ": " + error.reason();
        }
        return "loaded";
    }
    // Whether a warning of the last load has this place and contains this text.
    bool warned(const std::string& where, const std::string& text) const {
        for (const Diagnostic& warning : diagnostics_.warnings()) {
            if (warning.where == where && warning.message.find(text) != std::string::npos) return true;
        }
        return false;
    }
    std::string all_warnings() const {
        std::string out;
        for (const Diagnostic& warning : diagnostics_.warnings())
            out += warning.where + ": " + warning.message + "\n";
        return out;
    }
    static const Primitive& first(const Scene& scene) { return scene.meshes.at(0)->primitives.at(0); }

    const TemporaryFolder own_folder_{"candela_io"};
    const std::filesystem::path folder_ = own_folder_.path();
    Diagnostics diagnostics_;
    LoadOptions options_;
};

}  // namespace candela::test
