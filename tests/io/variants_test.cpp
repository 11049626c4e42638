// SPDX-License-Identifier: MIT
// KHR_materials_variants: names, mappings, and the choice of one.
#include "tests/io/document.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

using namespace test;

constexpr const char* name = "KHR_materials_variants";

class Variants : public GltfTest {
  protected:
    static Document two_variants() {
        Document document = Document::triangle();
        document.json["extensionsUsed"] = {name};
        document.json["extensions"][name]["variants"] = {{{"name", "red"}}, {{"name", "blue"}}};
        document.json["materials"] = {{{"name", "own"}}, {{"name", "r"}}, {{"name", "b"}}};
        Json& primitive = document.json["meshes"][0]["primitives"][0];
        primitive["material"] = 0;
        primitive["extensions"][name]["mappings"] = {{{"material", 1}, {"variants", {0}}},
                                                     {{"material", 2}, {"variants", {1}}}};
        return document;
    }
    std::string material_with(const Document& document, const std::string& variant) {
        options_.variant = variant;
        const Scene scene = load(document);
        options_.variant.clear();
        const MaterialId id = material_of(scene, first(scene));
        return id.valid() ? scene.materials[id.value].name : "default";
    }
};

TEST_F(Variants, NameTheMaterialOfEachPrimitive) {
    Document document = two_variants();
    EXPECT_EQ(material_with(document, ""), "own");
    EXPECT_EQ(material_with(document, "red"), "r");
    EXPECT_EQ(material_with(document, "blue"), "b");
    // A primitive that a variant does not mention keeps its own.
    document.json["meshes"][0]["primitives"][0]["extensions"][name]["mappings"].erase(1);
    EXPECT_EQ(material_with(document, "blue"), "own");
    // The first of two mappings counts.
    document.json["meshes"][0]["primitives"][0]["extensions"][name]["mappings"].push_back(
        {{"material", 2}, {"variants", {0}}});
    EXPECT_EQ(material_with(document, "red"), "r");
    EXPECT_TRUE(warned(std::string("/meshes/0/primitives/0/extensions/") + name, "maps variant 0 twice"));
}

TEST_F(Variants, AnUnknownNameIsTheCallersMistake) {
    options_.variant = "green";
    const auto expect_choice_error = [&](const Document& document, const char* text) {
        try {
            load(document);
            ADD_FAILURE() << "loaded";
        } catch (const ChoiceError& error) {
            EXPECT_NE(error.reason().find(text), std::string::npos) << error.what();
        }
    };
    expect_choice_error(two_variants(), "has only \"red\", \"blue\"");
    expect_choice_error(Document::triangle(), "has no variants");
    options_.variant.clear();
    options_.scene = 4;
    expect_choice_error(two_variants(), "scene 4 was asked for, but the file has 1 scene, 0");
}

TEST_F(Variants, IndicesAreChecked) {
    Document document = two_variants();
    Json& mapping = document.json["meshes"][0]["primitives"][0]["extensions"][name]["mappings"][0];
    const std::string place = std::string("/meshes/0/primitives/0/extensions/") + name + "/mappings/0";
    mapping["variants"][0] = 2;
    EXPECT_EQ(failure(document).rfind(place + "/variants/0: points to", 0), 0u);
    mapping["variants"][0] = 0;
    mapping["material"] = 3;
    EXPECT_EQ(failure(document).rfind(place + "/material: points to", 0), 0u);
}

TEST_F(Variants, TangentsServeEveryVariant) {
    Document document = two_variants();
    Json& primitive = document.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["NORMAL"] = document.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", f32);
    primitive["attributes"]["TEXCOORD_0"] = document.add_accessor<float>({0, 1, 1, 1, 0, 0}, "VEC2", f32);
    document.json["images"] = {{{"uri", "n.png"}}};
    document.json["textures"] = {{{"source", 0}}};
    EXPECT_TRUE(first(load(document)).tangents.empty());
    document.json["materials"][2]["normalTexture"] = {{"index", 0}};
    EXPECT_FALSE(first(load(document)).tangents.empty()) << "one of the variants has a normal texture";
}

TEST_F(Variants, SharedModel) {
    const auto file = shared_data() / "models/MaterialsVariantsCube/18_variants.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "skipped: no shared data";
    EXPECT_EQ(load_file(file).variant_names, (std::vector<std::string>{"Variant_Red", "Variant_Blue"}));
}

}  // namespace
}  // namespace candela
