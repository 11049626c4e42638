// SPDX-License-Identifier: MIT
// What a person reads when a file is broken: one line, the place in the document, the reason.
#include <atomic>

#include "tests/io/document.h"

namespace candela {
namespace {

using namespace test;

class Faults : public GltfTest {
  protected:
    // The triangle with one place of its document replaced.
    std::string failure_with(const std::string& pointer, const Json& value) {
        Document document = Document::triangle();
        document.finish("data.bin");
        document.json[Json::json_pointer(pointer)] = value;
        write("data.bin", {document.bytes.begin(), document.bytes.end()});
        return failure_of_text(document.json.dump());
    }
    std::string failure_without(const std::string& parent, const std::string& member) {
        Document document = Document::triangle();
        document.json[Json::json_pointer(parent)].erase(member);
        return failure(document);
    }
};

TEST_F(Faults, TypesAndRanges) {
    EXPECT_EQ(failure_with("/nodes/0/mesh", 7), "/nodes/0/mesh: points to /meshes/7, but there are only 1");
    EXPECT_EQ(failure_with("/nodes/0/mesh", -1), "/nodes/0/mesh: points to /meshes/-1, but there are only 1");
    EXPECT_EQ(failure_with("/nodes/0/mesh", 0.5), "/nodes/0/mesh: should be an index");
    EXPECT_EQ(failure_with("/nodes/0/mesh", 0.0), "loaded") << "0.0 is a legal spelling of 0";
    EXPECT_EQ(failure_with("/nodes/0/mesh", 1e300), "/nodes/0/mesh: should be an index");
    EXPECT_EQ(failure_with("/scene", 1), "/scene: points to /scenes/1, but there are only 1");
    EXPECT_EQ(failure_with("/scenes/0/nodes/0", 1), "/scenes/0/nodes/0: points to /nodes/1, but there are only 1");
    EXPECT_EQ(failure_with("/nodes/0/matrix", {1, 2}), "/nodes/0/matrix: has 2 numbers, should have 16");
    EXPECT_EQ(failure_with("/nodes/0/scale", {1, "2", 3}), "/nodes/0/scale/1: should be a number");
    EXPECT_EQ(failure_with("/nodes", 3), "/nodes: should be an array");
    EXPECT_EQ(failure_with("/nodes/0", "x"), "/nodes/0: should be an object");
    EXPECT_EQ(failure_with("/meshes/0/primitives/0/attributes/a~1b~0c", 9),
              "/meshes/0/primitives/0/attributes/a~1b~0c: points to /accessors/9, but there are only 2");
    EXPECT_EQ(failure_with("/accessors/0/count", 0), "/accessors/0/count: is 0, less than 1");
    EXPECT_EQ(failure_with("/bufferViews/0/byteOffset", -4), "/bufferViews/0/byteOffset: is -4, less than 0");
    EXPECT_EQ(failure_without("/accessors/0", "type"), "/accessors/0/type: is required but missing");
    EXPECT_EQ(failure_without("/meshes/0/primitives/0", "attributes"),
              "/meshes/0/primitives/0/attributes: is required but missing");
    EXPECT_EQ(failure_without("", "asset"), "/asset: is required but missing");
    EXPECT_EQ(failure_with("/asset/version", "1.0"), "/asset/version: glTF version \"1.0\" is not supported, only 2.0");
    EXPECT_EQ(failure_with("/asset/version", "2.1"), "loaded");
    EXPECT_EQ(failure_with("/asset/minVersion", "2.1"),
              "/asset/minVersion: glTF version \"2.1\" is not supported, only 2.0");
}

TEST_F(Faults, BytesOutOfRange) {
    EXPECT_EQ(
        failure_with("/bufferViews/0/byteLength", 3600),
        "/bufferViews/0/byteLength: a view at offset 0 of 3600 bytes reaches past the end of /buffers/0, which has "
        "42 bytes");
    EXPECT_EQ(failure_with("/bufferViews/0/byteOffset", 9007199254740992),
              "/bufferViews/0/byteLength: a view at offset 9007199254740992 of 36 bytes reaches past the end of "
              "/buffers/0, which has 42 bytes");
    EXPECT_EQ(failure_with("/accessors/0/count", 4),
              "/accessors/0/count: 4 elements of 12 bytes from offset 0 on reach past the end of /bufferViews/0, which "
              "has 36 bytes");
    EXPECT_EQ(failure_with("/accessors/0/byteOffset", 1).rfind("/accessors/0/count: 3 elements of 12 bytes", 0), 0u);
    EXPECT_EQ(failure_with("/accessors/0/count", 9223372036854775807).rfind("/accessors/0/count: ", 0), 0u);
    EXPECT_EQ(failure_with("/accessors/0/componentType", 5124),
              "/accessors/0/componentType: 5124 is not a component type of glTF");
    EXPECT_EQ(failure_with("/accessors/0/type", "VEC5"), "/accessors/0/type: \"VEC5\" is not an accessor type of glTF");
    EXPECT_EQ(failure_with("/bufferViews/0/byteStride", 4),
              "/bufferViews/0/byteStride: is 4, less than the 12 bytes of an element of /accessors/0");
    EXPECT_EQ(failure_with("/buffers/0/uri", "absent.bin"),
              "/buffers/0/uri: \"absent.bin\" does not exist beside the asset");
}

TEST_F(Faults, Meshes) {
    Document document = Document::triangle();
    document.add_accessor<uint16_t>({0, 1, 3}, "SCALAR", u16);
    document.add_accessor<float>({0, 0, 0, 0}, "VEC2", f32);
    Json& primitive = document.json["meshes"][0]["primitives"][0];
    primitive["indices"] = 2;
    EXPECT_EQ(
        failure(document),
        "/meshes/0/primitives/0/indices: vertex index 3 at element 2 is not below the 3 vertices of /accessors/0");
    primitive["indices"] = 0;
    EXPECT_EQ(failure(document), "/meshes/0/primitives/0/indices: /accessors/0 is not of unsigned integer SCALARs");
    primitive["indices"] = 1;
    primitive["attributes"]["TEXCOORD_0"] = 3;
    EXPECT_EQ(failure(document), "/meshes/0/primitives/0/attributes/TEXCOORD_0: has 2 elements, but POSITION has 3");
    primitive["attributes"] = {{"POSITION", 3}};
    EXPECT_EQ(failure(document), "/meshes/0/primitives/0/attributes/POSITION: /accessors/3 is not of type VEC3");
    primitive["attributes"] = {{"NORMAL", 0}};
    EXPECT_EQ(failure(document), "loaded");
    EXPECT_TRUE(warned("/meshes/0/primitives/0", "has no POSITION")) << all_warnings();
}

TEST_F(Faults, Json) {
    EXPECT_EQ(failure_of_text(""), ": the file holds no JSON");
    EXPECT_EQ(failure_of_text("{\n  \"asset\": {,}\n}"), ": malformed JSON at line 2, column 13");
    EXPECT_EQ(failure_of_text("[]"), ": the JSON root is not an object");
    EXPECT_EQ(failure_of_text("{\"a\": 1e999}"), ": malformed JSON: a number is out of range");
    EXPECT_NE(failure_of_text("{\"a\": \"\xff\"}").find("malformed JSON"), std::string::npos);
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    EXPECT_EQ(failure_of_text("{\"extras\":" + deep + "}"),
              ": JSON is nested deeper than the limit of 128 levels at line 1, column 138; --limit-nesting raises it");
    EXPECT_EQ(failure_of_text("\xef\xbb\xbf{\"asset\":{\"version\":\"2.0\"}}"), "loaded") << "a byte order mark";
    // Brackets in strings do not nest.
    EXPECT_EQ(failure_of_text("{\"asset\":{\"version\":\"2.0\",\"generator\":\"\\\"" + std::string(500, '[') + "\"}}"),
              "loaded");
}

TEST_F(Faults, MemoryIsRefusedBeforeItIsTaken) {
    Document document = Document::triangle();
    document.json["accessors"].push_back({{"componentType", f32}, {"count", 4000000000}, {"type", "VEC3"}});
    document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 2;
    EXPECT_NE(failure(document).find("/accessors/2/count: needs 48000000000 bytes, more than the memory limit"),
              std::string::npos)
        << failure(document);
    document.json["accessors"][2]["count"] = 9223372036854775807;
    EXPECT_NE(failure(document), "loaded");
    // Each of many small things counts.
    options_.max_memory_bytes = 4096;
    EXPECT_NE(failure(Document::triangle()).find("more than the memory limit of 4096 bytes"), std::string::npos);
}

TEST_F(Faults, Extensions) {
    Document document = Document::triangle();
    document.json["extensionsUsed"] = {"KHR_materials_unlit", "KHR_texture_video", "EXT_new", "KHR_xmp_json_ld"};
    document.json["extensionsRequired"] = {"KHR_materials_unlit"};
    const Scene scene = load(document);
    ASSERT_EQ(scene.extensions.size(), 4u);
    EXPECT_EQ(scene.extensions[0].name, "KHR_materials_unlit");
    EXPECT_TRUE(scene.extensions[0].required);
    EXPECT_EQ(scene.extensions[0].treatment, ExtensionUse::Treatment::rendered);
    EXPECT_FALSE(scene.extensions[1].required);
    EXPECT_EQ(scene.extensions[1].treatment, ExtensionUse::Treatment::ignored);
    EXPECT_TRUE(warned("/extensionsUsed/1", "KHR_texture_video is ignored")) << all_warnings();
    EXPECT_TRUE(warned("/extensionsUsed/2", "EXT_new is ignored"));
    EXPECT_EQ(diagnostics_.warnings().size(), 2u);

    document.json["extensionsRequired"] = {"KHR_materials_unlit", "KHR_texture_video"};
    EXPECT_EQ(failure(document),
              "/extensionsRequired/1: the required extension KHR_texture_video is not supported; export the "
              "scene without it");
    document.json["extensionsRequired"] = {"KHR_xmp_json_ld", "KHR_materials_variants"};
    EXPECT_EQ(failure(document), "loaded") << "what they add is no part of the default picture";

    document.json.erase("extensionsRequired");
    document.json["extensionsUsed"] = {"KHR_materials_iridescence"};
    EXPECT_EQ(load(document).extensions.at(0).treatment, ExtensionUse::Treatment::approximated);
    EXPECT_TRUE(warned("/extensionsUsed/0", "is approximated: interference")) << all_warnings();
}

TEST_F(Faults, CompressedViews) {
    Document document = Document::triangle();
    document.json["extensionsUsed"] = {"EXT_meshopt_compression"};
    Json& view = document.json["bufferViews"][0];
    const Json good = {{"buffer", 0}, {"byteLength", 20}, {"byteStride", 12}, {"count", 3}, {"mode", "ATTRIBUTES"}};
    const std::string place = "/bufferViews/0/extensions/EXT_meshopt_compression";
    const auto with = [&](const char* member, const Json& value) {
        view["extensions"]["EXT_meshopt_compression"] = good;
        view["extensions"]["EXT_meshopt_compression"][member] = value;
        return failure(document);
    };
    EXPECT_EQ(with("mode", "ZIP"), place + "/mode: \"ZIP\" is not a mode of EXT_meshopt_compression");
    EXPECT_EQ(with("filter", "X"), place + "/filter: \"X\" is not a filter of EXT_meshopt_compression");
    EXPECT_EQ(with("count", 4), place + "/count: count times byteStride differs from the view's byteLength");
    EXPECT_EQ(with("byteLength", 400).rfind(place + "/byteLength: ", 0), 0u);
    EXPECT_EQ(with("buffer", 2), place + "/buffer: points to /buffers/2, but there are only 1");
    // In range, but no stream of that codec.
    EXPECT_EQ(with("byteOffset", 0).rfind(place + ": ", 0), 0u) << with("byteOffset", 0);
}

TEST_F(Faults, CancelAndProgress) {
    std::atomic<bool> cancel{false};
    std::vector<std::string> words;
    float last = 0.0f;
    options_.cancel = &cancel;
    options_.progress = [&](float fraction, const char* word) {
        EXPECT_GE(fraction, last);
        last = fraction;
        words.emplace_back(word);
    };
    load(Document::triangle());
    EXPECT_EQ(words.front(), "reading");
    EXPECT_EQ(last, 1.0f);
    last = 0.0f;
    options_.progress = [&](float, const char* word) { cancel = std::string(word) == "meshes"; };
    EXPECT_EQ(failure(Document::triangle()), ": cancelled");
}

TEST_F(Faults, RepeatedWarningsAreFolded) {
    Diagnostics diagnostics;
    for (int i = 0; i < 20; ++i)
        diagnostics.warn("/" + std::to_string(i), "again");
    diagnostics.warn("/x", "once");
    EXPECT_EQ(diagnostics.warnings().size(), Diagnostics::max_per_kind + 1);
    EXPECT_EQ(diagnostics.folded(), 20 - Diagnostics::max_per_kind);
}

}  // namespace
}  // namespace candela
