// SPDX-License-Identifier: MIT
// EXT_mesh_gpu_instancing and KHR_node_visibility: what of the node tree is placed, and where.
#include "tests/io/document.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

using namespace test;

class Instancing : public GltfTest {
  protected:
    static Document with_attributes(Document document, const Json& attributes) {
        document.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
        document.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
        document.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = {{"attributes", attributes}};
        return document;
    }
    const std::string place_ = "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes";
};

TEST_F(Instancing, TransformsAreScaleThenRotationThenTranslationBelowTheNode) {
    Document document = Document::triangle();
    const int translations = document.add_accessor<float>({1, 2, 3, 0, 0, 5}, "VEC3", f32);
    // A quarter turn about z in 16 bits, and none.
    const int rotations =
        document.add_accessor<int16_t>({0, 0, 23170, 23170, 0, 0, 0, 32767}, "VEC4", i16, {{"normalized", true}});
    const int scales = document.add_accessor<float>({2, 3, 4, 1, 1, 1}, "VEC3", f32);
    const int numbers = document.add_accessor<float>({7, 8}, "SCALAR", f32);
    document.json["nodes"][0]["translation"] = {10, 0, 0};
    const Scene scene = load(with_attributes(
        document, {{"TRANSLATION", translations}, {"ROTATION", rotations}, {"SCALE", scales}, {"_ID", numbers}}));
    ASSERT_EQ(scene.instances.size(), 2u) << all_warnings();
    const auto placed = [&](size_t instance, const Vec3& p) {
        return Vec3(scene.instances[instance].world_from_object * Vec4(p, 1.0f));
    };
    EXPECT_NEAR(glm::distance(placed(0, {1, 0, 0}), Vec3(11, 4, 3)), 0.0f, 1e-3f);
    EXPECT_NEAR(glm::distance(placed(0, {0, 1, 1}), Vec3(8, 2, 7)), 0.0f, 1e-3f);
    EXPECT_NEAR(glm::distance(placed(1, {1, 1, 0}), Vec3(11, 1, 5)), 0.0f, 1e-3f);
    EXPECT_EQ(scene.instances[0].mesh, scene.instances[1].mesh);
    EXPECT_TRUE(diagnostics_.warnings().empty()) << all_warnings();
}

TEST_F(Instancing, WhatDoesNotFitIsRefused) {
    Document document = Document::triangle();
    const int two = document.add_accessor<float>({1, 2, 3, 0, 0, 5}, "VEC3", f32);
    const int three = document.add_accessor<float>({1, 1, 1, 1, 1, 1, 1, 1, 1}, "VEC3", f32);
    EXPECT_EQ(failure(with_attributes(document, {{"TRANSLATION", two}, {"SCALE", three}})),
              place_ + "/SCALE: has 3 elements, but another attribute has 2");
    EXPECT_EQ(failure(with_attributes(document, {{"ROTATION", two}})).rfind(place_ + "/ROTATION: ", 0), 0u);
    EXPECT_EQ(failure(with_attributes(document, {{"TRANSLATION", 99}})).rfind(place_ + "/TRANSLATION: points to", 0),
              0u);
    EXPECT_EQ(load(with_attributes(document, {{"_ID", two}})).instances.size(), 1u);
    EXPECT_TRUE(warned(place_, "the mesh is placed once")) << all_warnings();
    // A count without data needs no file of that size: what it would fill is booked.
    document.json["accessors"].push_back({{"componentType", f32}, {"count", 1'000'000'000}, {"type", "VEC3"}});
    const int many = static_cast<int>(document.json["accessors"].size()) - 1;
    EXPECT_NE(failure(with_attributes(document, {{"TRANSLATION", many}})).find("memory limit"), std::string::npos);
}

TEST_F(Instancing, SharedModelHasItsCubes) {
    const auto file = shared_data() / "models/SimpleInstancing/glTF/SimpleInstancing.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "skipped: no shared data";
    EXPECT_EQ(load_file(file).instances.size(), 125u);
}

TEST_F(Instancing, HiddenNodesAndAllBelowThemAreNotPlacedButForCameras) {
    Document document = Document::triangle();
    document.json["extensionsUsed"] = {"KHR_node_visibility", "KHR_lights_punctual"};
    document.json["extensionsRequired"] = {"KHR_node_visibility"};
    document.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    document.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    const Json hidden = {{"KHR_node_visibility", {{"visible", false}}}};
    document.json["nodes"] = {
        {{"mesh", 0}, {"children", {1, 3}}},
        {{"children", {2}}, {"extensions", hidden}},
        {{"mesh", 0}, {"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
        {{"mesh", 0}, {"extensions", {{"KHR_node_visibility", Json::object()}}}},
    };
    const Scene scene = load(document);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].node.value, 0u);
    EXPECT_EQ(scene.instances[1].node.value, 3u) << "visible is the default";
    EXPECT_TRUE(scene.light_instances.empty());
    EXPECT_EQ(scene.cameras.size(), 1u);
    document.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = true;
    EXPECT_EQ(load(document).instances.size(), 3u);
    EXPECT_EQ(load(document).light_instances.size(), 1u);
    document.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = 1;
    EXPECT_EQ(failure(document), "/nodes/1/extensions/KHR_node_visibility/visible: should be true or false");
}

}  // namespace
}  // namespace candela
