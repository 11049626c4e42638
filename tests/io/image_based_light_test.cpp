// SPDX-License-Identifier: MIT
// Faces of a cube become the environment that a person inside the cube would see.
#include "renderer/io/image_based_light.h"

#include "renderer/image/codec.h"
#include "renderer/lights/environment_light.h"
#include "tests/io/document.h"

namespace candela {
namespace {

struct Side {
    Vec3 forward, up;
};
const Side sides[6] = {{{1, 0, 0}, {0, 1, 0}},  {{-1, 0, 0}, {0, 1, 0}}, {{0, 1, 0}, {0, 0, -1}},
                       {{0, -1, 0}, {0, 0, 1}}, {{0, 0, 1}, {0, 1, 0}},  {{0, 0, -1}, {0, 1, 0}}};

TEST(ImageBasedLight, FacesAreSeenFromInside) {
    // Each face is dyed in its own blue, red grows to its right and green downwards.
    constexpr int size = 64;
    CubeFaces faces;
    for (size_t i = 0; i < faces.size(); ++i) {
        faces[i] = ImageRgb32f(size, size);
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x)
                faces[i](x, y) = Vec3((static_cast<float>(x) + 0.5f) / size, (static_cast<float>(y) + 0.5f) / size, i);
        }
    }
    for (size_t i = 0; i < faces.size(); ++i) {
        const Vec3 right = glm::cross(sides[i].forward, sides[i].up);
        const Vec3 w = glm::normalize(sides[i].forward + 0.5f * right + 0.25f * sides[i].up);
        const Vec3 seen = radiance_of(faces, w);
        EXPECT_NEAR(seen.x, 0.75f, 1e-5f) << i;
        EXPECT_NEAR(seen.y, 0.375f, 1e-5f) << i;
        EXPECT_EQ(seen.z, static_cast<float>(i));
    }
}

class ImageBasedLightFile : public test::GltfTest {
  protected:
    // The face +X is white over an alpha of 51/255 (radiance 5), the others are black.
    test::Document with_light(const test::Json& more = test::Json::object()) {
        options_.decode_images = true;
        write_png(folder_ / "bright.png", ImageRgba8(4, 4, Rgba8(255, 255, 255, 51)), true);
        write_png(folder_ / "dark.png", ImageRgba8(4, 4, Rgba8(0, 0, 0, 255)), true);
        test::Document document = test::Document::triangle();
        document.json["images"] = {{{"uri", "dark.png"}}, {{"uri", "bright.png"}}};
        test::Json light = {{"specularImageSize", 4}, {"specularImages", {{1, 0, 0, 0, 0, 0}}}};
        light.update(more);
        document.json["extensionsUsed"] = {"EXT_lights_image_based"};
        document.json["extensions"]["EXT_lights_image_based"]["lights"] = test::Json::array({light});
        document.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
        return document;
    }
};

TEST_F(ImageBasedLightFile, BecomesTheEnvironment) {
    const Scene scene = load(with_light({{"intensity", 2}}));
    ASSERT_TRUE(scene.environment);
    const EnvironmentLight light(*scene.environment);
    EXPECT_NEAR(light.radiance({1, 0, 0}).x, 10.0f, 1e-4f);
    for (size_t i = 1; i < 6; ++i)
        EXPECT_EQ(light.radiance(sides[i].forward), Vec3(0)) << i;
    EXPECT_EQ(scene.extensions.at(0).treatment, ExtensionUse::Treatment::rendered);
}

TEST_F(ImageBasedLightFile, IsTurnedByItsQuaternion) {
    // A quarter turn about +Y takes +X to −Z.
    const Scene scene = load(with_light({{"rotation", {0, 0.70710678, 0, 0.70710678}}}));
    ASSERT_TRUE(scene.environment);
    const EnvironmentLight light(*scene.environment);
    EXPECT_NEAR(light.radiance({0, 0, -1}).x, 5.0f, 1e-4f);
    EXPECT_EQ(light.radiance({1, 0, 0}), Vec3(0));
}

TEST_F(ImageBasedLightFile, IsOnlyThatOfTheActiveScene) {
    test::Document document = with_light();
    document.json["scenes"].push_back({{"nodes", {0}}});
    document.json["scene"] = 1;
    EXPECT_FALSE(load(document).environment);
}

TEST_F(ImageBasedLightFile, WithoutAFaceItIsLeftOut) {
    test::Document document = with_light();
    document.json["images"][1]["uri"] = "nothing.png";
    EXPECT_FALSE(load(document).environment);
    EXPECT_TRUE(warned("/extensions/EXT_lights_image_based/lights/0/specularImages/0", "missing"));
    EXPECT_NE(failure(with_light({{"specularImages", {{0, 1}}}})).find("six images"), std::string::npos);
    EXPECT_NE(failure(with_light({{"specularImages", {{0, 1, 2, 3, 4, 5}}}})).find("there are only 2"),
              std::string::npos);
    EXPECT_NE(failure(with_light({{"specularImages", test::Json::array()}})).find("six images"), std::string::npos);
}

}  // namespace
}  // namespace candela
