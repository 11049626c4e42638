// SPDX-License-Identifier: MIT
#include <glm/gtc/matrix_transform.hpp>

#include "tests/io/document.h"

namespace candela {
namespace {

using namespace test;

class Nodes : public GltfTest {
  protected:
    static Document with_nodes(const Json& nodes) {
        Document document = Document::triangle();
        document.json["nodes"] = nodes;
        return document;
    }
    static float difference(const Mat4& a, const Mat4& b) {
        float sum = 0;
        for (int c = 0; c < 4; ++c)
            sum += glm::distance(a[c], b[c]);
        return sum;
    }
};

TEST_F(Nodes, TranslationRotationScaleInThisOrder) {
    const float half = std::sqrt(0.5f);
    const Scene scene = load(with_nodes(
        {{{"mesh", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, 0, half, half}}, {"scale", {2, -3, 4}}}}));
    // A quarter turn about +Z: x becomes y, y becomes -x.
    const Mat4 expected(Vec4(0, 2, 0, 0), Vec4(3, 0, 0, 0), Vec4(0, 0, 4, 0), Vec4(1, 2, 3, 1));
    EXPECT_LT(difference(scene.instances.at(0).world_from_object, expected), 1e-5f);
}

TEST_F(Nodes, MatricesAreColumnMajorAndMultiplyDownTheTree) {
    const Scene scene =
        load(with_nodes({{{"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}, {"children", {1}}},
                         {{"mesh", 0}, {"translation", {1, 0, 0}}}}));
    EXPECT_EQ(Vec3(scene.instances.at(0).world_from_object[3]), Vec3(5, 1, 0));
    EXPECT_EQ(scene.nodes.at(1).parent.value, 0u);
    EXPECT_EQ(scene.nodes[0].children.at(0).value, 1u);
}

TEST_F(Nodes, ZeroScaleIsLoadedAndInfiniteIsSaid) {
    EXPECT_EQ(load(with_nodes({{{"mesh", 0}, {"scale", {0, 0, 0}}}})).instances.size(), 1u);
    const Json huge = {{{"scale", {1e30, 1e30, 1e30}}, {"children", {1}}},
                       {{"mesh", 0}, {"scale", {1e30, 1e30, 1e30}}}};
    EXPECT_TRUE(load(with_nodes(huge)).instances.empty());
    EXPECT_TRUE(warned("/nodes/1", "not finite")) << all_warnings();
    EXPECT_EQ(failure(with_nodes({{{"mesh", 0}, {"scale", {1e300, 1, 1}}}})),
              "/nodes/0/scale/0: is beyond the range of single precision");
}

TEST_F(Nodes, OnlyTreesAreAccepted) {
    EXPECT_EQ(failure(with_nodes({{{"children", {1}}}, {{"children", {0}}}})),
              "/nodes/0: is its own ancestor; nodes must form a tree");
    EXPECT_EQ(failure(with_nodes({{{"mesh", 0}}, {{"children", {1}}}})),
              "/nodes/1: is its own ancestor; nodes must form a tree");
    EXPECT_EQ(failure(with_nodes({{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}})),
              "/nodes/1/children/0: /nodes/2 has two parents, this one and /nodes/0; nodes must form a tree");
}

TEST_F(Nodes, ChainsMayBeLongerThanTheStack) {
    Json nodes = Json::array();
    constexpr int length = 100000;
    for (int i = 0; i < length; ++i)
        nodes.push_back({{"children", {i + 1}}, {"translation", {0.001, 0, 0}}});
    nodes.push_back({{"mesh", 0}});
    const Scene scene = load(with_nodes(nodes));
    EXPECT_NEAR(scene.instances.at(0).world_from_object[3].x, 100.0f, 1e-3f);
}

TEST_F(Nodes, ScenesAreChosenByOptionThenFileThenFirst) {
    Document document = with_nodes({{{"mesh", 0}, {"name", "a"}}, {{"mesh", 0}, {"name", "b"}}, {{"name", "c"}}});
    document.json["scenes"] = {
        {{"name", "one"}, {"nodes", {0}}}, {{"name", "two"}, {"nodes", {1, 1}}}, {{"name", "none"}}};
    document.json["scene"] = 1;
    Scene scene = load(document);
    EXPECT_EQ(scene.scene_names, (std::vector<std::string>{"one", "two", "none"}));
    EXPECT_EQ(scene.active_scene, 1u);
    ASSERT_EQ(scene.instances.size(), 1u) << "a node listed twice is shown once";
    EXPECT_EQ(scene.instances[0].node.value, 1u);
    EXPECT_FALSE(scene.nodes[0].in_active_scene);
    EXPECT_TRUE(scene.nodes[1].in_active_scene);

    options_.scene = 0;
    EXPECT_EQ(load(document).instances.at(0).node.value, 0u);
    options_.scene = 3;
    EXPECT_EQ(failure(document), "/scenes: scene 3 was asked for, but the file has 3 scenes, counted from 0");
    options_.scene.reset();
    document.json.erase("scene");
    EXPECT_EQ(load(document).active_scene, 0u);
    document.json.erase("scenes");
    EXPECT_EQ(load(document).instances.size(), 2u);
    EXPECT_TRUE(warned("/scenes", "no scene"));
}

TEST_F(Nodes, CamerasAreRigidWhateverTheirNodeScales) {
    Document document = with_nodes({{{"translation", {1, 2, 3}}, {"scale", {-2, 5, 3}}, {"children", {1, 2}}},
                                    {{"camera", 0}, {"name", "node name"}, {"rotation", {0, 1, 0, 0}}},
                                    {{"camera", 1}}});
    document.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}, {"aspectRatio", 1.5}}}},
        {{"type", "orthographic"},
         {"name", "plan"},
         {"orthographic", {{"xmag", 3}, {"ymag", -2}, {"znear", 0}, {"zfar", 9}}}}};
    const Scene scene = load(document);
    ASSERT_EQ(scene.cameras.size(), 2u);
    const Camera& eye = scene.cameras[0].camera;
    EXPECT_EQ(scene.cameras[0].name, "node name");
    EXPECT_EQ(eye.projection, Projection::perspective);
    EXPECT_EQ(eye.yfov_radians, 0.5f);
    EXPECT_EQ(eye.aspect, 1.5f);
    EXPECT_EQ(eye.position(), Vec3(1, 2, 3));
    // Half a turn about Y: it looks along +Z.
    EXPECT_NEAR(glm::distance(eye.forward(), Vec3(0, 0, 1)), 0.0f, 1e-6f);
    const Mat3 rotation(eye.world_from_camera);
    EXPECT_NEAR(glm::determinant(rotation), 1.0f, 1e-6f);
    EXPECT_NEAR(glm::distance(rotation[1], Vec3(0, 1, 0)), 0.0f, 1e-6f);
    EXPECT_EQ(scene.cameras[1].name, "plan");
    EXPECT_EQ(scene.cameras[1].camera.projection, Projection::orthographic);
    EXPECT_EQ(scene.cameras[1].camera.ortho_half_height_m, 2.0f);
    EXPECT_EQ(scene.cameras[1].camera.aspect, 1.5f);

    document.json["cameras"][0]["perspective"]["yfov"] = 0;
    EXPECT_EQ(failure(document), "/cameras/0/perspective/yfov: must be an angle between 0 and pi, in radians");
}

TEST_F(Nodes, LightsArePlaced) {
    Document document =
        with_nodes({{{"mesh", 0}, {"children", {1}}},
                    {{"translation", {0, 4, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}}});
    document.json["extensionsUsed"] = {"KHR_lights_punctual"};
    document.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 3}},
        {{"type", "spot"},
         {"name", "lamp"},
         {"color", {1, 0.5, 0}},
         {"intensity", 40},
         {"range", 10},
         {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
        {{"type", "point"}, {"intensity", -1}}};
    const Scene scene = load(document);
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::directional);
    EXPECT_EQ(scene.lights[0].intensity, 3.0f);
    const PunctualLight& lamp = scene.lights[1];
    EXPECT_EQ(lamp.kind, LightKind::spot);
    EXPECT_EQ(lamp.name, "lamp");
    EXPECT_EQ(lamp.color, Vec3(1, 0.5f, 0));
    EXPECT_EQ(lamp.intensity, 40.0f);
    EXPECT_EQ(lamp.range, 10.0f);
    EXPECT_EQ(lamp.inner_cone_radians, 0.25f);
    EXPECT_EQ(lamp.outer_cone_radians, 0.5f);
    EXPECT_EQ(scene.lights[2].intensity, 0.0f);
    EXPECT_TRUE(warned("/extensions/KHR_lights_punctual/lights/2", "negative"));
    EXPECT_TRUE(warned("/extensions/KHR_lights_punctual/lights/0", "is on no node")) << all_warnings();
    EXPECT_FALSE(warned("/extensions/KHR_lights_punctual/lights/1", "is on no node"));
    ASSERT_EQ(scene.light_instances.size(), 1u);
    EXPECT_EQ(scene.light_instances[0].light.value, 1u);
    EXPECT_EQ(Vec3(scene.light_instances[0].world_from_light[3]), Vec3(0, 4, 0));
}

}  // namespace
}  // namespace candela
