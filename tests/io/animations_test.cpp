// SPDX-License-Identifier: MIT
// Animations, skins and morph targets of files: what is read, what is refused, what is mended and said.
#include "renderer/scene/animation.h"

#include "renderer/scene/deform.h"
#include "renderer/scene/pose.h"
#include "tests/io/document.h"

namespace candela {
namespace {

using namespace test;

class Animations : public GltfTest {
  protected:
    // A triangle that moves along x in a second.
    static Document moving() {
        Document document = Document::triangle();
        const int times = document.add_accessor<float>({0, 1}, "SCALAR", f32);
        const int places = document.add_accessor<float>({0, 0, 0, 4, 0, 0}, "VEC3", f32);
        document.json["animations"] = {
            {{"name", "go"},
             {"samplers", {{{"input", times}, {"output", places}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
        return document;
    }
    static Json& channel(Document& document) { return document.json["animations"][0]["channels"][0]; }
    static Json& sampler(Document& document) { return document.json["animations"][0]["samplers"][0]; }
    static void drive(Document& document, const std::string& pointer) {
        channel(document)["target"] = {{"path", "pointer"},
                                       {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
    }
    static Document skinned() {
        Document document = Document::triangle();
        const int joints = document.add_accessor<uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4", u8);
        const int weights = document.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}, "VEC4", f32);
        document.json["meshes"][0]["primitives"][0]["attributes"].update(
            {{"JOINTS_0", joints}, {"WEIGHTS_0", weights}});
        document.json["nodes"] = {
            {{"mesh", 0}, {"skin", 0}}, {{"translation", {0, 0, 1}}}, {{"translation", {0, 0, 3}}}};
        document.json["skins"] = {{{"joints", {1, 2}}}};
        document.json["scenes"][0]["nodes"] = {0, 1, 2};
        return document;
    }
    static Json& attributes(Document& document) { return document.json["meshes"][0]["primitives"][0]["attributes"]; }
    size_t channels_of(const Document& document) { return load(document).animations.at(0)->channels.size(); }
    Primitive shown(const Document& document) {
        const Scene scene = load(document);
        return scene.mesh(scene.instances.at(0).mesh).primitives.at(0);
    }
};

TEST_F(Animations, AreReadAndPosed) {
    const auto rest = std::make_shared<const Scene>(load(moving()));
    EXPECT_EQ(all_warnings(), "");
    ASSERT_EQ(rest->animations.size(), 1u);
    EXPECT_EQ(rest->animations[0]->name, "go");
    EXPECT_EQ(rest->animations[0]->duration_s, 1.0f);
    EXPECT_TRUE(rest->instances.at(0).moves);
    EXPECT_EQ(posed_scene(rest, 0, 0.25f)->instances.at(0).world_from_object[3].x, 1.0f);
}

TEST_F(Animations, BrokenReferencesAreRefused) {
    Document document = moving();
    channel(document)["sampler"] = 1;
    EXPECT_EQ(failure(document),
              "/animations/0/channels/0/sampler: points to /animations/0/samplers/1, but there are only 1");
    document = moving();
    channel(document)["target"]["node"] = 5;
    EXPECT_EQ(failure(document), "/animations/0/channels/0/target/node: points to /nodes/5, but there are only 1");
    document = moving();
    sampler(document)["output"] = 9;
    EXPECT_EQ(failure(document), "/animations/0/samplers/0/output: points to /accessors/9, but there are only 4");
    document = moving();
    sampler(document)["output"] = 2;
    EXPECT_EQ(failure(document), "/animations/0/samplers/0/output: /accessors/2 is not of type VEC3");
    document = moving();
    sampler(document)["input"] = 3;
    EXPECT_EQ(failure(document), "/animations/0/samplers/0/input: /accessors/3 is not of type SCALAR");
    document = moving();
    document.json["animations"][0].erase("channels");
    EXPECT_EQ(failure(document), "/animations/0/channels: is required but missing");
    document = moving();
    drive(document, "/nodes/7/translation");
    EXPECT_EQ(failure(document),
              "/animations/0/channels/0/target/extensions/KHR_animation_pointer/pointer: /nodes/7/translation points "
              "to nothing: there are only 1");
}

TEST_F(Animations, SenselessKeysAreSaidAndLeftOut) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto with = [&](const std::vector<float>& times, const std::vector<float>& places) {
        Document document = moving();
        sampler(document)["input"] = document.add_accessor<float>(times, "SCALAR", f32);
        sampler(document)["output"] = document.add_accessor<float>(places, "VEC3", f32);
        return document;
    };
    EXPECT_EQ(channels_of(with({1, 0}, {0, 0, 0, 1, 0, 0})), 0u);
    EXPECT_TRUE(warned("/animations/0/samplers/0/input", "times that go back")) << all_warnings();
    EXPECT_EQ(channels_of(with({0, nan}, {0, 0, 0, 1, 0, 0})), 0u);
    EXPECT_TRUE(warned("/animations/0/samplers/0/input", "not finite")) << all_warnings();
    EXPECT_EQ(channels_of(with({0, 1}, {0, 0, 0, 1, nan, 0})), 0u);
    EXPECT_TRUE(warned("/animations/0/samplers/0/output", "not finite")) << all_warnings();
    EXPECT_EQ(channels_of(with({0, 1}, {0, 0, 0})), 0u);
    EXPECT_TRUE(warned("/animations/0/samplers/0/output", "has 1 elements, but 2 keys need 2")) << all_warnings();
    EXPECT_EQ(channels_of(with({0, 1}, {0, 0, 0, 1, 0, 0, 2, 0, 0})), 1u);
    EXPECT_TRUE(warned("/animations/0/samplers/0/output", "the others are ignored")) << all_warnings();
    EXPECT_EQ(channels_of(with({0, 0}, {0, 0, 0, 1, 0, 0})), 1u);
    EXPECT_TRUE(warned("/animations/0/samplers/0/input", "the same time twice")) << all_warnings();
    Document document = moving();
    sampler(document)["interpolation"] = "CUBICSPLINE";
    EXPECT_EQ(channels_of(document), 0u);
    EXPECT_TRUE(warned("/animations/0/samplers/0/output", "has 2 elements, but 2 keys need 6")) << all_warnings();
    sampler(document)["interpolation"] = "ROUND";
    EXPECT_EQ(channels_of(document), 1u);
    EXPECT_TRUE(warned("/animations/0/samplers/0/interpolation", "LINEAR is used")) << all_warnings();
}

TEST_F(Animations, UnknownTargetsAreSaidAndLeftOut) {
    Document document = moving();
    drive(document, "/materials/0/unheardOf");
    EXPECT_EQ(channels_of(document), 0u);
    EXPECT_TRUE(
        warned("/animations/0/channels/0/target/extensions/KHR_animation_pointer/pointer", "/materials/0/unheardOf"))
        << all_warnings();
    document = moving();
    channel(document)["target"]["path"] = "colour";
    EXPECT_EQ(channels_of(document), 0u);
    EXPECT_TRUE(warned("/animations/0/channels/0/target/path", "\"colour\"")) << all_warnings();
    document = moving();
    channel(document)["target"].erase("node");
    EXPECT_EQ(channels_of(document), 0u);
    document = moving();
    channel(document)["target"]["path"] = "weights";
    EXPECT_EQ(channels_of(document), 0u);
    EXPECT_TRUE(warned("/animations/0/channels/0/target", "without morph targets")) << all_warnings();
    document = moving();
    document.json["animations"][0]["channels"].push_back(channel(document));
    EXPECT_EQ(channels_of(document), 1u);
    EXPECT_TRUE(warned("/animations/0/channels/1/target", "by another channel already")) << all_warnings();
}

TEST_F(Animations, PointersDriveTextureTransformsFromTheFilesOwnParts) {
    Document document = moving();
    document.json["images"] = {{{"uri", "data:image/png;base64,AAAA"}}};
    document.json["textures"] = {{{"source", 0}}};
    document.json["materials"] = {
        {{"emissiveTexture",
          {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0.25}}, {"scale", {2, 3}}}}}}}}}};
    sampler(document)["output"] = document.add_accessor<float>({0, 1}, "SCALAR", f32);
    drive(document, "/materials/0/emissiveTexture/extensions/KHR_texture_transform/rotation");
    const auto rest = std::make_shared<const Scene>(load(document));
    ASSERT_EQ(rest->animations.at(0)->channels.size(), 1u) << all_warnings();
    const auto posed = posed_scene(rest, 0, 0.5f);
    const glm::mat3x2& m = posed->materials.at(0).emissive.uv_transform;
    const float c = std::cos(0.5f), s = std::sin(0.5f);
    EXPECT_NEAR(glm::distance(m[0], Vec2(2 * c, -2 * s)), 0, 1e-6f);
    EXPECT_NEAR(glm::distance(m[1], Vec2(3 * s, 3 * c)), 0, 1e-6f);
    EXPECT_EQ(m[2], Vec2(0.5f, 0.25f));
}

TEST_F(Animations, MatricesOfAnimatedNodesAreTakenApart) {
    Document document = moving();
    document.json["nodes"][0]["matrix"] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, -1, 0, 7, 8, 9, 1};
    const auto rest = std::make_shared<const Scene>(load(document));
    EXPECT_TRUE(warned("/animations/0/channels/0/target", "is a matrix")) << all_warnings();
    const Mat4& before = rest->instances.at(0).world_from_object;
    const Mat4 after = posed_scene(rest, 0, 1.0f)->instances.at(0).world_from_object;
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(glm::distance(before[c], after[c]), 0, 1e-6f);
    EXPECT_EQ(Vec3(after[3]), Vec3(4, 0, 0));
}

TEST_F(Animations, SkinsAreReadAndCheckedAgainstTheirMeshes) {
    const Primitive shape = shown(skinned());
    EXPECT_EQ(all_warnings(), "");
    EXPECT_EQ(shape.positions.at(0), Vec3(0, 0, 1));
    EXPECT_EQ(shape.positions.at(1), Vec3(1, 0, 3));
    EXPECT_EQ(shape.positions.at(2), Vec3(0, 1, 2));

    Document document = skinned();
    document.json["skins"][0]["joints"] = {1};
    EXPECT_EQ(failure(document), "/nodes/0/skin: /skins/0 has 1 joints, but /meshes/0 uses joint 1");
    document = skinned();
    document.json["skins"][0]["joints"] = {1, 3};
    EXPECT_EQ(failure(document), "/skins/0/joints/1: points to /nodes/3, but there are only 3");
    document = skinned();
    document.json["skins"][0]["inverseBindMatrices"] =
        document.add_accessor<float>(std::vector<float>(16, 1.0f), "MAT4", f32);
    EXPECT_EQ(failure(document), "/skins/0/inverseBindMatrices: has 1 matrices for 2 joints");
    document = skinned();
    document.json["skins"][0]["inverseBindMatrices"] =
        document.add_accessor<float>(std::vector<float>(32, std::numeric_limits<float>::infinity()), "MAT4", f32);
    EXPECT_EQ(failure(document), "/skins/0/inverseBindMatrices: matrix 0 is not finite");
    document = skinned();
    attributes(document)["JOINTS_0"] = document.add_accessor<float>(std::vector<float>(12, 0.0f), "VEC4", f32);
    EXPECT_EQ(failure(document),
              "/meshes/0/primitives/0/attributes/JOINTS_0: /accessors/4 is not of unsigned 8-bit "
              "or 16-bit integers");
    document = skinned();
    attributes(document)["WEIGHTS_0"] = document.add_accessor<float>(std::vector<float>(8, 0.5f), "VEC4", f32);
    EXPECT_EQ(failure(document), "/meshes/0/primitives/0/attributes/WEIGHTS_0: has 2 elements, but POSITION has 3");
    // A joint that hangs from itself is a loop of nodes.
    document = skinned();
    document.json["nodes"][1]["children"] = {2};
    document.json["nodes"][2]["children"] = {1};
    EXPECT_NE(failure(document).find("is its own ancestor"), std::string::npos);
}

TEST_F(Animations, WeightsAreScaledToOneAndRoundingIsNotSaid) {
    Document document = skinned();
    const int rounded = document.add_accessor<uint8_t>({254, 0, 0, 0, 255, 0, 0, 0, 127, 127, 0, 0}, "VEC4", u8,
                                                       {{"normalized", true}});
    attributes(document)["WEIGHTS_0"] = rounded;
    EXPECT_EQ(shown(document).positions.at(2), Vec3(0, 1, 2));
    EXPECT_EQ(all_warnings(), "");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    attributes(document)["WEIGHTS_0"] =
        document.add_accessor<float>({nan, 0, 0, 0, 3, 0, 0, 0, 2, 2, -1, 0}, "VEC4", f32);
    const Primitive shape = shown(document);
    EXPECT_EQ(shape.positions.at(0), Vec3(0, 0, 0)) << "follows no joint";
    EXPECT_EQ(shape.positions.at(1), Vec3(1, 0, 3));
    EXPECT_EQ(shape.positions.at(2), Vec3(0, 1, 2));
    const std::string place = "/meshes/0/primitives/0/attributes/WEIGHTS_0";
    EXPECT_TRUE(warned(place, "negative or not finite")) << all_warnings();
    EXPECT_TRUE(warned(place, "do not sum to 1")) << all_warnings();
    EXPECT_TRUE(warned(place, "follow no joint")) << all_warnings();
}

// The fifth influence is as good as the first.
TEST_F(Animations, AnyNumberOfInfluenceSets) {
    Document document = skinned();
    std::vector<uint16_t> joints(12, 0);
    std::vector<float> weights(12, 0.0f);
    joints[8] = 1;
    weights[8] = 1.0f;
    attributes(document)["JOINTS_1"] = document.add_accessor<uint16_t>(joints, "VEC4", u16);
    attributes(document)["WEIGHTS_1"] = document.add_accessor<float>(weights, "VEC4", f32);
    // (1·½ + 3·½ + 3·1) / 2
    EXPECT_EQ(shown(document).positions.at(2), Vec3(0, 1, 2.5f));
    EXPECT_TRUE(warned("/meshes/0/primitives/0/attributes/WEIGHTS_0", "do not sum to 1")) << all_warnings();
    attributes(document).erase("WEIGHTS_1");
    EXPECT_EQ(shown(document).positions.at(2), Vec3(0, 1, 2));
    EXPECT_TRUE(warned("/meshes/0/primitives/0/attributes/JOINTS_1", "no WEIGHTS_1")) << all_warnings();
}

TEST_F(Animations, MorphTargetsMayBeSparseAndBeginWithTheirWeights) {
    Document document = Document::triangle();
    const std::vector<uint16_t> where = {2};
    const std::vector<float> values = {0, 0, 8};
    const int view_of_indices = document.add_view(where.data(), 2),
              view_of_values = document.add_view(values.data(), 12);
    document.json["accessors"].push_back({{"componentType", f32},
                                          {"count", 3},
                                          {"type", "VEC3"},
                                          {"sparse",
                                           {{"count", 1},
                                            {"indices", {{"bufferView", view_of_indices}, {"componentType", u16}}},
                                            {"values", {{"bufferView", view_of_values}}}}}});
    document.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}, {{"POSITION", 2}}};
    document.json["meshes"][0]["weights"] = {0, 0.5};
    EXPECT_EQ(shown(document).positions.at(2), Vec3(0, 1, 4));
    document.json["nodes"][0]["weights"] = {1, 0.25};
    EXPECT_EQ(shown(document).positions.at(2), Vec3(0, 2, 2));
    EXPECT_EQ(all_warnings(), "");
    document.json["nodes"][0]["weights"] = {1};
    EXPECT_EQ(shown(document).positions.at(2), Vec3(0, 2, 0));
    EXPECT_TRUE(warned("/nodes/0/weights", "has 1 weights for 2 morph targets")) << all_warnings();
    document.json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"] = 7;
    EXPECT_EQ(failure(document),
              "/meshes/0/primitives/0/targets/1/POSITION: points to /accessors/7, but there are only 3");
    document.json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"] =
        document.add_accessor<float>({1, 2, 3}, "VEC3", f32);
    EXPECT_EQ(failure(document), "/meshes/0/primitives/0/targets/1/POSITION: has 1 elements, but POSITION has 3");
}

// Vertices that no triangle uses are dropped, and vertices are split for tangents: targets and joints go along.
TEST_F(Animations, DeformationsFollowTheirVertices) {
    Document document;
    const int positions = document.add_accessor<float>({9, 9, 9, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", f32);
    const int deltas = document.add_accessor<float>({9, 9, 9, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4}, "VEC3", f32);
    const int normals = document.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", f32);
    // Texture coordinates run one way on the first triangle and back on the second.
    const int uv = document.add_accessor<float>({0, 0, 0, 0, 1, 0, 0, 1, 1, 0}, "VEC2", f32);
    const int indices = document.add_accessor<uint16_t>({1, 2, 3, 1, 3, 4}, "SCALAR", u16);
    document.add_primitive({{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uv}}, indices,
                           {{"material", 0}, {"targets", {{{"POSITION", deltas}}}}});
    document.json["meshes"][0]["weights"] = {1};
    document.json["images"] = {{{"uri", "data:image/png;base64,AAAA"}}};
    document.json["textures"] = {{{"source", 0}}};
    document.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    const Primitive shape = shown(document);
    EXPECT_GT(shape.positions.size(), 4u) << "nothing was split";
    const float expected_z[2][3] = {{1, 2, 3}, {1, 3, 4}};
    for (size_t t = 0; t < 2; ++t) {
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(shape.positions.at(shape.triangles.at(t)[c]).z, expected_z[t][c]);
    }
}

// Three components leave opacity alone; what the mesh has not itself is said to be ignored.
TEST_F(Animations, MorphTargetsOfTextureCoordinatesAndColours) {
    Document document;
    const int positions = document.add_accessor<float>({9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", f32);
    const int uv = document.add_accessor<float>({9, 9, 0, 0, 1, 0, 0, 1}, "VEC2", f32);
    const int uv_deltas = document.add_accessor<float>({9, 9, 0.5f, 0, 0, 0, 0, 0.25f}, "VEC2", f32);
    const int colors = document.add_accessor<uint8_t>({0, 0, 0, 0, 255, 0, 0, 51, 0, 255, 0, 255, 0, 0, 255, 255},
                                                      "VEC4", u8, {{"normalized", true}});
    const int color_deltas = document.add_accessor<int8_t>({9, 9, 9, 0, -127, 127, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
                                                           "VEC3", i8, {{"normalized", true}, {"count", 4}});
    document.json["bufferViews"].back()["byteStride"] = 4;
    const int indices = document.add_accessor<uint16_t>({1, 2, 3}, "SCALAR", u16);
    document.add_primitive({{"POSITION", positions}, {"TEXCOORD_0", uv}, {"COLOR_0", colors}}, indices,
                           {{"targets", {{{"TEXCOORD_0", uv_deltas}, {"COLOR_0", color_deltas}, {"TEXCOORD_1", uv}}}}});
    document.json["meshes"][0]["weights"] = {1};
    const Primitive shape = shown(document);
    EXPECT_EQ(shape.uv[0], (std::vector<Vec2>{Vec2(0.5f, 0), Vec2(1, 0), Vec2(0, 1.25f)}));
    EXPECT_EQ(shape.colors.at(0), Vec4(0, 1, 0, 0.2f));
    EXPECT_EQ(shape.colors.at(1), Vec4(0, 1, 0, 1));
    EXPECT_TRUE(warned("/meshes/0/primitives/0/targets/0", "its differences of TEXCOORD_1 are ignored"))
        << all_warnings();
    document.json["meshes"][0]["primitives"][0]["targets"][0]["TEXCOORD_0"] = indices;
    EXPECT_NE(failure(document).find("/meshes/0/primitives/0/targets/0/TEXCOORD_0: "), std::string::npos);
    document.json["meshes"][0]["primitives"][0]["targets"][0]["TEXCOORD_0"] =
        document.add_accessor<float>({1, 2}, "VEC2", f32);
    EXPECT_EQ(failure(document), "/meshes/0/primitives/0/targets/0/TEXCOORD_0: has 1 elements, but POSITION has 4");
}

// The first vertex is dropped: the joints of the others stay theirs.
TEST_F(Animations, InfluencesFollowTheirVertices) {
    Document document = skinned();
    const int positions = document.add_accessor<float>({9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", f32);
    const int indices = document.add_accessor<uint16_t>({1, 2, 3}, "SCALAR", u16);
    const int joints = document.add_accessor<uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0}, "VEC4", u8);
    const int weights =
        document.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}, "VEC4", f32);
    document.json["meshes"][0]["primitives"][0] = {
        {"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}, {"indices", indices}};
    const Primitive shape = shown(document);
    ASSERT_EQ(shape.positions.size(), 3u);
    EXPECT_EQ(shape.positions[0], Vec3(0, 0, 3));
    EXPECT_EQ(shape.positions[1], Vec3(1, 0, 1));
    EXPECT_EQ(shape.positions[2], Vec3(0, 1, 2));
}

TEST_F(Animations, PosedCopiesAreBooked) {
    Document document = skinned();
    Json nodes = document.json["nodes"];
    for (int i = 0; i < 2000; ++i)
        nodes.push_back({{"mesh", 0}, {"skin", 0}});
    document.json["nodes"] = nodes;
    options_.max_memory_bytes = 100000;
    EXPECT_NE(failure(document).find("more than the memory limit"), std::string::npos);
}

}  // namespace
}  // namespace candela
