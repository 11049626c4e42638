// SPDX-License-Identifier: MIT
// Each limit: what lies on it opens; what lies over it is refused by a message that names the limit, its value and the
// option that raises it; raised, it opens.
#include "renderer/io/files.h"
#include "renderer/io/images.h"
#include "tests/io/document.h"

namespace candela {
namespace {

using namespace test;

class Limits : public GltfTest {
  protected:
    // The document opens with the limit at `enough` and fails with the message at one less.
    template <typename T>
    void expect_limit(const std::string& text, T LoadLimits::*limit, T enough, const std::string& message) {
        options_.*limit = enough;
        EXPECT_EQ(failure_of_text(text), "loaded");
        options_.*limit = enough - 1;
        EXPECT_EQ(failure_of_text(text), message);
    }
};

TEST_F(Limits, Nesting) {
    std::string extras = "1";
    for (int i = 0; i < 200; ++i)
        extras = "[" + extras + "]";
    // The document itself is one level.
    const std::string text = R"({"asset":{"version":"2.0"},"extras":)" + extras + "}";
    EXPECT_EQ(failure_of_text(text),
              ": JSON is nested deeper than the limit of 128 levels at line 1, column 164; --limit-nesting raises it");
    expect_limit(
        text, &LoadLimits::max_json_nesting, 201,
        ": JSON is nested deeper than the limit of 200 levels at line 1, column 236; --limit-nesting raises it");
    options_.max_json_nesting = std::numeric_limits<int>::max();
    EXPECT_NE(failure_of_text(R"({"asset":{"version":"2.0"},"extras":)" + std::string(100'000, '[')), "loaded")
        << "it cannot be raised beyond what the machine's stack bears";
}

TEST_F(Limits, TextOfTheDocument) {
    const std::string text = R"({"asset":{"version":"2.0"},"extras":"some text"})";
    const uint64_t size = text.size();
    expect_limit(text, &LoadLimits::max_json_bytes, size,
                 ": has " + std::to_string(size) + " bytes of JSON, more than the limit of " +
                     std::to_string(size - 1) + "; --limit-json raises it");
    // Of a .glb only the document's text counts.
    Document document = Document::triangle();
    document.finish("");
    const std::string json = document.json.dump();
    options_.max_json_bytes = (json.size() + 3) / 4 * 4;
    document.bytes.resize(100'000);
    const std::string bin(document.bytes.begin(), document.bytes.end());
    EXPECT_EQ(failure_of([&] { load_file(write("scene.glb", glb_bytes(json, bin))); }), "loaded");
}

TEST_F(Limits, ObjectsOfOneKind) {
    Document nodes;
    nodes.json["nodes"] = Json::array();
    for (int i = 0; i < 50; ++i)
        nodes.json["nodes"].push_back({{"translation", {1, 2, 3}}});
    expect_limit(nodes.json.dump(), &LoadLimits::max_count, uint64_t{50},
                 "/nodes: has 50 elements, more than the limit of 49; --limit-count raises it");

    // Those of all parents together.
    Document document = Document::triangle();
    document.finish("data.bin");
    write("data.bin", {document.bytes.begin(), document.bytes.end()});
    Json& meshes = document.json["meshes"];
    for (int i = 0; i < 4; ++i)
        meshes[0]["primitives"].push_back(meshes[0]["primitives"][0]);
    meshes.push_back(meshes[0]);
    expect_limit(document.json.dump(), &LoadLimits::max_count, uint64_t{10},
                 "/meshes/*/primitives: has 10 elements, more than the limit of 9; --limit-count raises it");
}

TEST_F(Limits, InstancesOfAllNodes) {
    Document document = Document::triangle();
    const int places = document.add_accessor<float>({1, 2, 3, 0, 0, 5, 1, 1, 1}, "VEC3", f32);
    document.finish("data.bin");
    write("data.bin", {document.bytes.begin(), document.bytes.end()});
    document.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    document.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = {{"attributes", {{"TRANSLATION", places}}}};
    document.json["nodes"].push_back(document.json["nodes"][0]);
    expect_limit(document.json.dump(), &LoadLimits::max_instances, uint64_t{6},
                 "/nodes/1/extensions/EXT_mesh_gpu_instancing/attributes: has 6 instances, more than the limit of 5; "
                 "--limit-instances raises it");
}

TEST_F(Limits, Memory) {
    Document document = Document::triangle();
    document.finish("");
    const std::string glb = glb_bytes(document.json.dump(), {document.bytes.begin(), document.bytes.end()});
    const auto failure_with = [&](uint64_t bytes) {
        options_.max_memory_bytes = bytes;
        return failure_of([&] { load_file(write("scene.glb", glb)); });
    };
    EXPECT_EQ(failure_with(uint64_t{1} << 20), "loaded");
    EXPECT_EQ(failure_with(100),
              ": needs " + std::to_string(glb.size()) +
                  " bytes, more than the memory limit of 100 bytes allows; --limit-memory raises it");
    // A file that is nearly all hole is refused by its size, not read.
    const std::filesystem::path sparse = write("sparse.glb", "glTF");
    std::filesystem::resize_file(sparse, uint64_t{1} << 40);
    options_ = {};
    EXPECT_EQ(failure_of([&] { load_file(sparse); }),
              ": needs 1099511627776 bytes, more than the memory limit of 17179869184 bytes allows; --limit-memory "
              "raises it");
}

class ImageLimits : public Limits {
  protected:
    // Whether the picture of 40x30 pixels became the material's texture.
    bool opens() {
        Document document = Document::triangle();
        document.finish("data.bin");
        write("data.bin", {document.bytes.begin(), document.bytes.end()});
        write_png(folder_ / "a.png", ImageRgba8(40, 30, Rgba8(9)), false);
        document.json["images"] = {{{"uri", "a.png"}}};
        document.json["textures"] = {{{"source", 0}}};
        document.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
        document.json["meshes"][0]["primitives"][0]["material"] = 0;
        options_.decode_images = true;
        diagnostics_ = {};
        const Scene scene = load_file(write("scene.gltf", document.json.dump()));
        return scene.images.at(0).pixels->width() == 40;
    }
};

TEST_F(ImageLimits, Sides) {
    options_.max_image_side = 40;
    EXPECT_TRUE(opens()) << all_warnings();
    options_.max_image_side = 39;
    EXPECT_FALSE(opens());
    EXPECT_TRUE(warned("/images/0",
                       "the picture has 40x30 pixels; the limit is 39 a side and 1521 in all; --limit-image raises it"))
        << all_warnings();
}

// Of two pictures of 4800 bytes the second no longer fits.
TEST(ImageMemory, IsThatOfAllPicturesTogether) {
    const TemporaryFolder folder;
    write_png(folder.path() / "a.png", ImageRgba8(40, 30, Rgba8(9)), false);
    const RawBytes png = read_file(folder.path() / "a.png");
    const std::span<const std::byte> both[] = {png, png};
    ImageDecodeOptions options;
    options.threads = 1;
    options.max_total_bytes = 9600;
    for (const DecodedImage& image : decode_images(both, options))
        EXPECT_EQ(image.error, "");
    options.max_total_bytes = 9599;
    const std::vector<DecodedImage> decoded = decode_images(both, options);
    EXPECT_EQ(decoded[0].error, "");
    EXPECT_EQ(decoded[1].error,
              "the picture has 40x30 pixels and so needs 4800 bytes, more than the memory limit leaves for it (4799 "
              "bytes); --limit-memory raises it");
}

}  // namespace
}  // namespace candela
