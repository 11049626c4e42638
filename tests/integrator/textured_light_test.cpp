// SPDX-License-Identifier: MIT
// Lamps whose texture shines unevenly: sampled by what they emit, and right whatever the estimator.
#include "renderer/image/image.h"
#include "tests/support/measure.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

using namespace test;

// A lamp over a white plane that shines in one texel of 8 × 8 only.
Scene lamp_with_one_bright_texel(bool mirrored) {
    Scene scene;
    SceneImage image;
    ImageRgba8 texels(8, 8, Rgba8{0, 0, 0, 255});
    texels(5, 2) = Rgba8{255, 255, 255, 255};
    image.pixels = std::make_shared<const ImageRgba8>(std::move(texels));
    scene.images.push_back(image);
    Texture texture;
    texture.image = {0};
    texture.wrap_u = texture.wrap_v = WrapMode::clamp_to_edge;
    scene.textures.push_back(texture);
    add_object(scene, make_quad(Vec3(-9, 0, 9), Vec3(18, 0, 0), Vec3(0, 0, -18)), add_lambert(scene, Vec3(1)));
    const MaterialId lamp = add_emitter(scene, Vec3(1));
    scene.materials[lamp.value].emissive_factor = Vec3(1);
    scene.materials[lamp.value].emissive_strength = 100;
    scene.materials[lamp.value].emissive.texture = {0};
    const Mat4 mirror(Vec4(-1, 0, 0, 0), Vec4(0, 1, 0, 0), Vec4(0, 0, 1, 0), Vec4(0, 0, 0, 1));
    add_object(scene, make_quad(Vec3(-1, 1, -1), Vec3(2, 0, 0), Vec3(0, 0, 2)), lamp, mirrored ? mirror : Mat4(1));
    return scene;
}

TEST(TexturedLight, AllEstimatorsAgree) {
    for (const bool mirrored : {false, true}) {
        const auto world = build(lamp_with_one_bright_texel(mirrored));
        EXPECT_GT(world->lights.triangles.size(), 32u) << "the two triangles are cut into cells";
        const View view = look_at_point(Vec3(0.2f, 0.4f, 0.3f), Vec3(0.1f, 0, 0.2f), Vec3(0, 1, 0));
        const BatchMeans light = measure(*world, view, {Estimator::light}, 64, 1024);
        const BatchMeans bsdf = measure(*world, view, {Estimator::bsdf}, 64, 16384);
        const BatchMeans mis = measure(*world, view, {Estimator::mis}, 64, 1024);
        EXPECT_GT(bsdf.mean(), 0);
        EXPECT_LT(bsdf.standard_error(), 1e-2 * bsdf.mean());
        EXPECT_NEAR(light.mean(), bsdf.mean(), 4 * std::hypot(light.standard_error(), bsdf.standard_error()));
        EXPECT_NEAR(mis.mean(), bsdf.mean(), 4 * std::hypot(mis.standard_error(), bsdf.standard_error()));
    }
}

TEST(TexturedLight, CellsTakeMostOfTheNoise) {
    const View view = look_at_point(Vec3(0.2f, 0.4f, 0.3f), Vec3(0.1f, 0, 0.2f), Vec3(0, 1, 0));
    const auto cut = build(lamp_with_one_bright_texel(false));
    // The same lamp as two whole triangles.
    auto whole = std::make_shared<World>(*cut);
    whole->lights.triangles.clear();
    whole->lights.cells.clear();
    for (const EmissiveTriangle& cell : cut->lights.triangles) {
        if (cell.corner != Vec2(0) || cell.scale < 0) continue;
        EmissiveTriangle triangle = cell;
        triangle.edge1 /= cell.scale;
        triangle.edge2 /= cell.scale;
        triangle.scale = 1;
        triangle.mean_radiance = 1;
        whole->lights.cells.push_back({static_cast<uint32_t>(whole->lights.triangles.size()), 1});
        whole->lights.triangles.push_back(triangle);
    }
    ASSERT_EQ(whole->lights.triangles.size(), 2u);
    finish_lights(whole->lights, whole->bounds);
    const Technique technique{Estimator::light, SamplerKind::independent};
    const BatchMeans with = measure(*cut, view, technique, 64, 1024),
                     without = measure(*whole, view, technique, 64, 1024);
    EXPECT_NEAR(with.mean(), without.mean(), 4 * std::hypot(with.standard_error(), without.standard_error()));
    // One texel of 64, blurred over its neighbours by the filter: whole triangles hit it once in about 30 samples.
    const double gain = std::pow(without.standard_error() / with.standard_error(), 2);
    EXPECT_GT(gain, 8) << "of variance";
    RecordProperty("variance_gain", std::to_string(gain));
}

}  // namespace
}  // namespace candela
