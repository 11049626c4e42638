// SPDX-License-Identifier: MIT
#include "renderer/io/materials.h"
#include "tests/io/document.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

using namespace test;

class Materials : public GltfTest {
  protected:
    static Document with_material(const Json& material) {
        Document document = Document::triangle();
        const int uv = document.add_accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2", f32);
        Json& primitive = document.json["meshes"][0]["primitives"][0];
        primitive["attributes"]["TEXCOORD_0"] = uv;
        primitive["attributes"]["TEXCOORD_1"] = uv;
        primitive["material"] = 0;
        document.json["materials"] = {material};
        document.json["images"] = {{{"uri", "a.png"}}, {{"uri", "b.webp"}}};
        document.json["samplers"] = {{{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}}};
        document.json["textures"] = {{{"source", 0}, {"sampler", 0}},
                                     {{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}},
                                     {{"sampler", 0}}};
        return document;
    }
    Material material_of(const Json& material) { return load(with_material(material)).materials.at(0); }
};

TEST_F(Materials, DefaultsAreTheSpecifications) {
    const Material m = material_of(Json::object());
    EXPECT_EQ(m.base_color_factor, Vec4(1));
    EXPECT_EQ(m.metallic_factor, 1.0f);
    EXPECT_EQ(m.roughness_factor, 1.0f);
    EXPECT_EQ(m.emissive_factor, Vec3(0));
    EXPECT_EQ(m.emissive_strength, 1.0f);
    EXPECT_EQ(m.alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(m.alpha_cutoff, 0.5f);
    EXPECT_FALSE(m.double_sided || m.unlit);
    EXPECT_EQ(m.ior, 1.5f);
    EXPECT_EQ(m.specular.factor, 1.0f);
    EXPECT_FALSE(m.base_color.valid() || m.metallic_roughness.valid() || m.normal.valid() || m.occlusion.valid() ||
                 m.emissive.valid());
}

TEST_F(Materials, FactorsTexturesAndModes) {
    const Material m = material_of({{"name", "paint"},
                                    {"pbrMetallicRoughness",
                                     {{"baseColorFactor", {0.25, 0.5, 0.75, 1}},
                                      {"metallicFactor", 0},
                                      {"roughnessFactor", 0.25},
                                      {"baseColorTexture", {{"index", 1}, {"texCoord", 1}}},
                                      {"metallicRoughnessTexture", {{"index", 0}}}}},
                                    {"normalTexture", {{"index", 0}, {"scale", 2}, {"texCoord", 1}}},
                                    {"occlusionTexture", {{"index", 0}, {"strength", 0.5}}},
                                    {"emissiveTexture", {{"index", 1}}},
                                    {"emissiveFactor", {1, 0.5, 0}},
                                    {"alphaMode", "MASK"},
                                    {"alphaCutoff", 0.75},
                                    {"doubleSided", true}});
    EXPECT_EQ(m.name, "paint");
    EXPECT_EQ(m.base_color_factor, Vec4(0.25f, 0.5f, 0.75f, 1));
    EXPECT_EQ(m.metallic_factor, 0.0f);
    EXPECT_EQ(m.roughness_factor, 0.25f);
    EXPECT_EQ(m.base_color.texture.value, 1u);
    EXPECT_EQ(m.base_color.uv_set, 1u);
    EXPECT_EQ(m.metallic_roughness.texture.value, 0u);
    EXPECT_EQ(m.normal.uv_set, 1u);
    EXPECT_EQ(m.normal_scale, 2.0f);
    EXPECT_EQ(m.occlusion.texture.value, 0u);
    EXPECT_EQ(m.emissive.texture.value, 1u);
    EXPECT_EQ(m.emissive_factor, Vec3(1, 0.5f, 0));
    EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(m.alpha_cutoff, 0.75f);
    EXPECT_TRUE(m.double_sided);
    EXPECT_EQ(material_of({{"alphaMode", "BLEND"}}).alpha_mode, AlphaMode::blend);
    EXPECT_EQ(material_of({{"alphaMode", "FOG"}}).alpha_mode, AlphaMode::opaque);
    EXPECT_TRUE(warned("/materials/0/alphaMode", "FOG"));
}

TEST_F(Materials, SamplersAndWebp) {
    const Scene scene = load(with_material(Json::object()));
    EXPECT_EQ(scene.textures.at(0).wrap_u, WrapMode::clamp_to_edge);
    EXPECT_EQ(scene.textures[0].wrap_v, WrapMode::mirrored_repeat);
    EXPECT_EQ(scene.textures[0].mag_filter, TextureFilter::nearest);
    EXPECT_EQ(scene.textures.at(1).wrap_u, WrapMode::repeat);
    EXPECT_EQ(scene.textures[1].mag_filter, TextureFilter::linear);
    EXPECT_EQ(scene.textures[1].image.value, 1u) << "EXT_texture_webp replaces the source";
    EXPECT_FALSE(scene.textures.at(2).image.valid());
    EXPECT_TRUE(warned("/textures/2", "no image"));
}

TEST_F(Materials, Extensions) {
    const Material m =
        material_of({{"emissiveFactor", {1, 1, 1}},
                     {"extensions",
                      {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5000000000}}},
                       {"KHR_materials_ior", {{"ior", 2}}},
                       {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1, 2, 0.5}}}},
                       {"KHR_materials_unlit", Json::object()}}}});
    EXPECT_EQ(m.emissive_strength, 5e9f) << "beyond 32 bits";
    EXPECT_EQ(m.ior, 2.0f);
    EXPECT_EQ(m.specular.factor, 0.5f);
    EXPECT_EQ(m.specular.color_factor, Vec3(1, 2, 0.5f));
    EXPECT_TRUE(m.unlit);
    EXPECT_FALSE(m.emits());
}

TEST_F(Materials, LayersWithTheirTextures) {
    const auto texture = [](int uv_set) { return Json{{"index", 0}, {"texCoord", uv_set}}; };
    const Material m = material_of(
        {{"extensions",
          {{"KHR_materials_specular", {{"specularTexture", texture(0)}, {"specularColorTexture", texture(1)}}},
           {"KHR_materials_clearcoat",
            {{"clearcoatFactor", 0.5},
             {"clearcoatTexture", texture(0)},
             {"clearcoatRoughnessFactor", 0.25},
             {"clearcoatRoughnessTexture", texture(1)},
             {"clearcoatNormalTexture", {{"index", 0}, {"scale", 2}}}}},
           {"KHR_materials_sheen",
            {{"sheenColorFactor", {0.1, 0.2, 0.3}},
             {"sheenColorTexture", texture(1)},
             {"sheenRoughnessFactor", 0.75},
             {"sheenRoughnessTexture", texture(1)}}},
           {"KHR_materials_iridescence",
            {{"iridescenceFactor", 0.5},
             {"iridescenceTexture", texture(0)},
             {"iridescenceIor", 1.4},
             {"iridescenceThicknessMinimum", 50},
             {"iridescenceThicknessMaximum", 500},
             {"iridescenceThicknessTexture", texture(1)}}},
           {"KHR_materials_anisotropy",
            {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 1.5}, {"anisotropyTexture", texture(0)}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 0.5}, {"transmissionTexture", texture(0)}}},
           {"KHR_materials_diffuse_transmission",
            {{"diffuseTransmissionFactor", 0.25},
             {"diffuseTransmissionTexture", texture(0)},
             {"diffuseTransmissionColorFactor", {0.5, 0.25, 1}},
             {"diffuseTransmissionColorTexture", texture(1)}}},
           {"KHR_materials_volume",
            {{"thicknessFactor", 0.5}, {"attenuationDistance", 2}, {"attenuationColor", {0.5, 1, 0.25}}}},
           {"KHR_materials_dispersion", {{"dispersion", 0.5}}}}}});
    EXPECT_EQ(m.specular.texture.uv_set, 0u);
    EXPECT_EQ(m.specular.color.uv_set, 1u);
    EXPECT_EQ(m.clearcoat.factor, 0.5f);
    EXPECT_EQ(m.clearcoat.roughness_factor, 0.25f);
    EXPECT_EQ(m.clearcoat.roughness.uv_set, 1u);
    EXPECT_TRUE(m.clearcoat.normal.valid());
    EXPECT_EQ(m.clearcoat.normal_scale, 2.0f);
    EXPECT_EQ(m.sheen.color_factor, Vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(m.sheen.roughness_factor, 0.75f);
    EXPECT_EQ(m.iridescence.ior, 1.4f);
    EXPECT_EQ(m.iridescence.thickness_minimum_nm, 50.0f);
    EXPECT_EQ(m.iridescence.thickness_maximum_nm, 500.0f);
    EXPECT_EQ(m.anisotropy.strength, 0.5f);
    EXPECT_EQ(m.anisotropy.rotation_radians, 1.5f);
    EXPECT_EQ(m.transmission.factor, 0.5f);
    EXPECT_EQ(m.diffuse_transmission.color_factor, Vec3(0.5f, 0.25f, 1));
    EXPECT_EQ(m.volume.attenuation_distance_m, 2.0f);
    EXPECT_EQ(m.volume.attenuation_color, Vec3(0.5f, 1, 0.25f));
    EXPECT_EQ(m.volume.dispersion, 0.5f);
    EXPECT_TRUE(m.has_volume());
    EXPECT_EQ(texture_slots(m).size(), 13u);
}

TEST_F(Materials, EveryTextureThatAMaterialReadsIsDecoded) {
    // One material for each textureInfo, and an image each that no other reads.
    const std::pair<const char*, const char*> places[] = {
        {"KHR_materials_specular", "specularTexture"},
        {"KHR_materials_specular", "specularColorTexture"},
        {"KHR_materials_clearcoat", "clearcoatTexture"},
        {"KHR_materials_clearcoat", "clearcoatRoughnessTexture"},
        {"KHR_materials_clearcoat", "clearcoatNormalTexture"},
        {"KHR_materials_sheen", "sheenColorTexture"},
        {"KHR_materials_sheen", "sheenRoughnessTexture"},
        {"KHR_materials_iridescence", "iridescenceTexture"},
        {"KHR_materials_iridescence", "iridescenceThicknessTexture"},
        {"KHR_materials_anisotropy", "anisotropyTexture"},
        {"KHR_materials_transmission", "transmissionTexture"},
        {"KHR_materials_diffuse_transmission", "diffuseTransmissionTexture"},
        {"KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture"},
        {"KHR_materials_pbrSpecularGlossiness", "diffuseTexture"},
        {"KHR_materials_pbrSpecularGlossiness", "specularGlossinessTexture"}};
    const std::string png =
        "data:image/"
        "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEElEQVR4nGNocFAAIgYIBQAaDgOBnA45xwAAAABJRU5ErkJggg="
        "=";
    Document document = with_material(Json::object());
    document.json["materials"] = Json::array();
    document.json["images"] = Json::array();
    document.json["textures"] = Json::array();
    for (const auto& [extension, name] : places) {
        const auto index = document.json["images"].size();
        document.json["images"].push_back({{"uri", png}});
        document.json["textures"].push_back({{"source", index}});
        document.json["materials"].push_back({{"extensions", {{extension, {{name, {{"index", index}}}}}}}});
    }
    options_.decode_images = true;
    const Scene scene = load(document);
    for (size_t i = 0; i < std::size(places); ++i)
        EXPECT_EQ(scene.images[i].pixels->width(), 2) << places[i].second << "\n" << all_warnings();
}

TEST_F(Materials, SpecularGlossinessReplacesMetallicRoughness) {
    const Material m = material_of({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}}},
                                    {"extensions",
                                     {{"KHR_materials_pbrSpecularGlossiness",
                                       {{"diffuseFactor", {0.1, 0.2, 0.3, 0.4}},
                                        {"specularFactor", {0.5, 0.6, 0.7}},
                                        {"glossinessFactor", 0.25}}}}}});
    EXPECT_EQ(m.base_color_factor, Vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.specular.color_factor, Vec3(0.5f, 0.6f, 0.7f));
    EXPECT_EQ(m.roughness_factor, 0.75f);
    EXPECT_EQ(m.metallic_factor, 0.0f);
}

TEST_F(Materials, AnAttenuationDistanceOfNothingAbsorbsNothing) {
    const Material m =
        material_of({{"extensions", {{"KHR_materials_volume", {{"thicknessFactor", 1}, {"attenuationDistance", 0}}}}}});
    EXPECT_EQ(m.volume.attenuation_distance_m, infinity);
    EXPECT_TRUE(warned("/materials/0/extensions/KHR_materials_volume/attenuationDistance", "greater than 0"));
}

TEST_F(Materials, ValuesOutOfRangeAreClampedAndSaid) {
    const Material m = material_of({{"pbrMetallicRoughness", {{"metallicFactor", 3}, {"roughnessFactor", -1}}},
                                    {"extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}}}});
    EXPECT_EQ(m.metallic_factor, 1.0f);
    EXPECT_EQ(m.roughness_factor, 0.0f);
    EXPECT_EQ(m.ior, 1.0f);
    EXPECT_TRUE(warned("/materials/0/pbrMetallicRoughness/metallicFactor", "clamped")) << all_warnings();
    EXPECT_TRUE(warned("/materials/0/pbrMetallicRoughness/roughnessFactor", "clamped"));
    EXPECT_TRUE(warned("/materials/0/extensions/KHR_materials_ior/ior", "clamped"));
}

TEST_F(Materials, TextureTransformScalesThenTurnsThenMoves) {
    const auto transformed = [&](const Json& transform, const Vec2& uv) {
        const Material m = material_of(
            {{"pbrMetallicRoughness",
              {{"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}}}});
        return m.base_color.uv_transform * Vec3(uv, 1);
    };
    EXPECT_EQ(transformed({{"offset", {0.5, 0.25}}, {"scale", {2, 3}}}, Vec2(1, 1)), Vec2(2.5f, 3.25f));
    // A quarter turn counter-clockwise takes u (right) to up, which is -v.
    const Vec2 turned = transformed({{"rotation", 1.5707963267948966}}, Vec2(1, 0));
    EXPECT_NEAR(glm::distance(turned, Vec2(0, -1)), 0.0f, 1e-6f);
    const Vec2 all = transformed({{"rotation", 1.5707963267948966}, {"scale", {2, 3}}, {"offset", {1, 1}}}, Vec2(0, 1));
    EXPECT_NEAR(glm::distance(all, Vec2(4, 1)), 0.0f, 1e-6f);

    const Material m = material_of(
        {{"normalTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"texCoord", 1}}}}}}}});
    EXPECT_EQ(m.normal.uv_set, 1u) << "the extension's texCoord replaces the textureInfo's";
}

// The sample model marks where its arrow's tip must appear: at the marker, the transformed coordinates are the tip's.
TEST_F(Materials, TextureTransformAgreesWithTheMarkersOfTheSampleModel) {
    const auto file = shared_data() / "models/TextureTransformTest/glTF/TextureTransformTest.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "skipped: no shared data";
    const Scene scene = load_file(file);
    const auto node_named = [&](const std::string& name) -> const Node& {
        return *std::find_if(scene.nodes.begin(), scene.nodes.end(), [&](const Node& n) { return n.name == name; });
    };
    const auto uv_at = [](const Node& marker) {
        const Vec2 p(marker.parent_from_node[3]);
        return Vec2(p.x + 0.5f, 0.5f - p.y);
    };
    const Primitive& quad = scene.meshes.at(3)->primitives.at(0);
    for (size_t i = 0; i < quad.positions.size(); ++i) {
        ASSERT_EQ(quad.uv[0][i], Vec2(quad.positions[i].x + 0.5f, 0.5f - quad.positions[i].y));
    }
    const Vec2 tip = uv_at(node_named("Rotation - Not Supported"));
    const Vec2 read = scene.materials.at(3).base_color.uv_transform * Vec3(uv_at(node_named("Rotation - Correct")), 1);
    EXPECT_NEAR(glm::distance(read, tip), 0.0f, 0.01f);
    const Vec2 all = scene.materials.at(5).base_color.uv_transform * Vec3(uv_at(node_named("All - Correct")), 1);
    EXPECT_NEAR(glm::distance(all, tip), 0.0f, 0.05f);
}

TEST_F(Materials, ThirdUvSetIsSaid) {
    const Material m = material_of({{"emissiveTexture", {{"index", 0}, {"texCoord", 2}}}});
    EXPECT_FALSE(m.emissive.valid());
    EXPECT_TRUE(warned("/materials/0/emissiveTexture/texCoord", "only TEXCOORD_0 and TEXCOORD_1")) << all_warnings();
}

// 1 × 1 RGBA PNG, red.
const char* const red_png =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8DwHwAFBQIAX8jx0gAAAABJRU5ErkJggg==";

TEST_F(Materials, ImagesThatCannotBeReadBecomeWhiteAndLeaveNormalsAlone) {
    options_.decode_images = true;
    Document document = with_material(
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 1}}}}},
         {"normalTexture", {{"index", 0}}},
         {"occlusionTexture", {{"index", 3}}}});
    document.json["images"].push_back({{"uri", "never read.png"}});
    document.json["textures"].push_back({{"source", 2}});
    write("b.webp", "this is no image");
    const Scene scene = load(document);
    for (const SceneImage& image : scene.images) {
        ASSERT_EQ(image.pixels->size(), 1u);
        EXPECT_EQ((*image.pixels)(0, 0), Rgba8(255));
    }
    EXPECT_TRUE(scene.materials.at(0).base_color.valid());
    EXPECT_FALSE(scene.materials[0].normal.valid()) << "white would tilt every normal";
    EXPECT_TRUE(warned("/images/0/uri", "does not exist beside the asset; white")) << all_warnings();
    EXPECT_TRUE(warned("/images/1", "the texture's other image is used")) << all_warnings();
    EXPECT_EQ(diagnostics_.warnings().size(), 3u) << "none of the image that only occlusion reads\n" << all_warnings();
}

TEST_F(Materials, ImagesAreDecodedFromDataUrisFilesAndViews) {
    options_.decode_images = true;
    Document document = with_material(
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}, {"emissiveTexture", {{"index", 1}}}});
    document.json["images"] = {{{"uri", std::string("data:image/png;base64,") + red_png}},
                               {{"uri", std::string("data:;base64,") + red_png}}};
    const Scene scene = load(document);
    for (const SceneImage& image : scene.images)
        EXPECT_EQ((*image.pixels)(0, 0), Rgba8(255, 0, 0, 255)) << all_warnings();

    // The same bytes as a buffer view. The view of 5 bytes is damaged, not out of range.
    std::ifstream source(shared_data() / "models/TextureTransformTest/glTF/Arrow.png", std::ios::binary);
    if (!source) GTEST_SKIP() << "skipped: no shared data";
    const std::string png((std::istreambuf_iterator<char>(source)), {});
    const int view = document.add_view(png.data(), png.size());
    const int cut = document.add_view(png.data(), 5);
    document.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}, {{"bufferView", cut}}};
    const Scene from_views = load(document);
    EXPECT_GT(from_views.images.at(0).pixels->size(), 100u);
    EXPECT_EQ(from_views.images.at(1).pixels->size(), 1u);
    EXPECT_TRUE(warned("/images/1", "the texture's other image is used")) << all_warnings();
}

}  // namespace
}  // namespace candela
