// SPDX-License-Identifier: MIT
// A world that was built while its pictures were still to come looks, once they have, as one made from nothing.
#include <numeric>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/integrator/integrator.h"
#include "renderer/scene/color_mips.h"
#include "renderer/scene/without_pictures.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

using namespace test;

// A picture of one colour with a square of another in it.
TextureRef add_picture(Scene& scene, const Rgba8& ground, const Rgba8& figure) {
    SceneImage image;
    ImageRgba8 texels(16, 16, ground);
    for (int y = 4; y < 9; ++y) {
        for (int x = 3; x < 11; ++x)
            texels(x, y) = figure;
    }
    image.pixels = std::make_shared<const ImageRgba8>(std::move(texels));
    scene.images.push_back(image);
    Texture texture;
    texture.image = {static_cast<uint32_t>(scene.images.size() - 1)};
    scene.textures.push_back(texture);
    TextureRef out;
    out.texture = {static_cast<uint32_t>(scene.textures.size() - 1)};
    return out;
}

// Every use of a picture that a world knows: colours, normals, metal, masks, blends, lamps, layers.
Scene textured_scene() {
    Scene scene;
    const auto card = [&](const Vec3& at, const auto& edit) {
        Material material;
        edit(material);
        scene.materials.push_back(material);
        Primitive quad = make_quad(at, Vec3(1, 0, 0), Vec3(0, 1, 0));
        quad.tangents.assign(quad.positions.size(), Vec4(1, 0, 0, 1));
        add_object(scene, std::move(quad), {static_cast<uint32_t>(scene.materials.size() - 1)});
    };
    const Rgba8 red(200, 40, 30, 255), green(30, 180, 60, 255);
    card(Vec3(-2, -1, 0), [&](Material& m) { m.base_color = add_picture(scene, red, green); });
    card(Vec3(-0.8f, -1, 0), [&](Material& m) {
        m.normal = add_picture(scene, {128, 128, 255, 255}, {200, 90, 220, 255});
        m.clearcoat.factor = 1;
        m.clearcoat.texture = add_picture(scene, red, green);
        m.clearcoat.normal = m.normal;
        m.metallic_factor = 0;
    });
    card(Vec3(0.4f, -1, 0), [&](Material& m) {
        m.metallic_roughness = add_picture(scene, {0, 60, 255, 255}, {0, 200, 0, 255});
        m.anisotropy.strength = 0.8f;
        m.anisotropy.texture = add_picture(scene, {255, 128, 255, 255}, {128, 255, 100, 255});
        m.sheen.color_factor = Vec3(1);
        m.sheen.color = add_picture(scene, red, green);
    });
    card(Vec3(-2, 0.2f, 0), [&](Material& m) {
        m.alpha_mode = AlphaMode::mask;
        m.base_color = add_picture(scene, red, {30, 180, 60, 0});
    });
    card(Vec3(-0.8f, 0.2f, 0.1f), [&](Material& m) {
        m.alpha_mode = AlphaMode::blend;
        m.base_color = add_picture(scene, red, {30, 180, 60, 100});
    });
    card(Vec3(0.4f, 0.2f, 0.2f), [&](Material& m) {
        m.alpha_mode = AlphaMode::blend;
        m.base_color = add_picture(scene, red, green);
        m.specular_glossiness = true;
        m.specular_glossiness_texture = add_picture(scene, red, green);
    });
    card(Vec3(-1, 2.2f, 1.5f), [&](Material& m) {
        m.double_sided = true;
        m.emissive_factor = Vec3(1);
        m.emissive_strength = 30;
        m.emissive = add_picture(scene, {0, 0, 0, 255}, {255, 240, 200, 255});
    });
    card(Vec3(1.4f, -0.5f, 0.3f), [&](Material& m) {
        m.transmission.factor = 1;
        m.transmission.texture = add_picture(scene, red, green);
        m.iridescence.factor = 1;
        m.iridescence.texture = add_picture(scene, red, green);
    });
    add_object(scene, make_quad(Vec3(-4, -2, -1), Vec3(8, 0, 0), Vec3(0, 6, 0)), add_lambert(scene, Vec3(0.6f)));
    make_color_mips(scene);
    return scene;
}

Scene still_to_come(const Scene& scene) {
    Scene out = scene;
    for (SceneImage& image : out.images) {
        image.pixels.reset();
        image.smaller.reset();
    }
    return out;
}

std::vector<Vec3> picture(const World& world) {
    View view;
    view.camera.world_from_camera = look_at(Vec3(0, 0.5f, 5), Vec3(0, 0.3f, 0), Vec3(0, 1, 0));
    view.extent = Vec2u(40, 30);
    std::vector<Vec3> out;
    RayCounts counts;
    for (uint16_t y = 0; y < view.extent.y; ++y) {
        for (uint16_t x = 0; x < view.extent.x; ++x) {
            for (uint32_t i = 0; i < 2; ++i)
                out.push_back(trace_sample(world, view, {}, {x, y, i}, counts).radiance);
        }
    }
    return out;
}

class Pictures : public ::testing::Test {
  protected:
    std::shared_ptr<const Scene> scene_ = std::make_shared<const Scene>(textured_scene());
    std::shared_ptr<const World> early_world(const std::optional<Environment>& environment) const {
        BuildOptions options;
        options.environment = environment;
        return build_world(std::make_shared<const Scene>(without_pictures(still_to_come(*scene_))), options);
    }
};

TEST_F(Pictures, ThatComeLaterGiveTheWorldMadeFromNothingToTheBit) {
    const auto early = early_world(constant_environment(Vec3(1)));
    const auto late = with_pictures(early, scene_, false);
    EXPECT_EQ(picture(*late), picture(*build_world(scene_)));
    EXPECT_NE(picture(*late), picture(*early));
    EXPECT_EQ(late->accel->work().trees_built, 0u);
    EXPECT_EQ(late->accel->fixed_tree(), early->accel->fixed_tree());
    // The lamp's picture decides how it is cut.
    EXPECT_TRUE(early->lights.triangles.empty());
    EXPECT_EQ(late->lights.triangles.size(), build_world(scene_)->lights.triangles.size());
    EXPECT_GT(late->lights.triangles.size(), 100u);
}

TEST_F(Pictures, KeepTheEnvironmentOrTakeAnother) {
    BuildOptions blue;
    blue.environment = constant_environment(Vec3(0.1f, 0.2f, 0.9f));
    const auto early = early_world(blue.environment);
    EXPECT_EQ(picture(*with_pictures(early, scene_, true)), picture(*build_world(scene_, blue)));
    BuildOptions red;
    red.environment = constant_environment(Vec3(0.9f, 0.2f, 0.1f));
    EXPECT_EQ(picture(*with_pictures(early, scene_, false, red)), picture(*build_world(scene_, red)));
}

TEST_F(Pictures, AreMissedWithoutHarm) {
    const std::vector<Vec3> seen = picture(*early_world(constant_environment(Vec3(1))));
    EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), is_finite));
    const Vec3 sum = std::accumulate(seen.begin(), seen.end(), Vec3(0));
    EXPECT_GT(luminance(sum) / static_cast<float>(seen.size()), 0.2f);
}

// White in the place of what is missing would be a mirror, a lamp, or a tilted surface.
TEST_F(Pictures, AreStoodInForByWhatMostOfThemShow) {
    const std::vector<Material> seen = without_pictures(still_to_come(*scene_)).materials;
    EXPECT_FALSE(seen[1].normal.valid() || seen[1].clearcoat.normal.valid());
    EXPECT_EQ(seen[1].clearcoat.factor, 0.0f);
    EXPECT_EQ(seen[2].metallic_factor, 0.0f);
    EXPECT_FALSE(seen[2].anisotropy.texture.valid());
    EXPECT_EQ(seen[2].sheen.color_factor, Vec3(0));
    EXPECT_EQ(seen[5].roughness_factor, 1.0f);
    EXPECT_EQ(seen[5].specular.color_factor, Vec3(0.04f));
    EXPECT_EQ(seen[6].emissive_factor, Vec3(0));
    EXPECT_EQ(seen[7].iridescence.factor, 0.0f);
    EXPECT_EQ(seen[7].transmission.factor, 1.0f) << "decides on trees";
}

// A head that says "no alpha" spares the tree the opacity function; the picture is the same.
TEST_F(Pictures, KnownToBeOpaqueAreNotSeenThrough) {
    Scene coming = still_to_come(*scene_);
    const uint32_t opaque_blend = coming.textures[coming.materials[5].base_color.texture.value].image.value;
    const auto opacity_asked = [&](const Scene& scene) {
        const auto world = build_world(std::make_shared<const Scene>(without_pictures(scene)));
        return std::count(world->fixed.has_opacity.begin(), world->fixed.has_opacity.end(), uint8_t{1});
    };
    const auto before = opacity_asked(coming);
    coming.images[opaque_blend].alpha = ImageAlpha::opaque;
    EXPECT_EQ(opacity_asked(coming), before - 1);
}

}  // namespace
}  // namespace candela
