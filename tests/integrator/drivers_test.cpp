// SPDX-License-Identifier: MIT
// The batched driver gives the scalar driver's samples to the bit; settings mean what they say.
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/integrator/aov.h"
#include "renderer/integrator/integrator.h"
#include "renderer/math/hash.h"
#include "renderer/scene/color_mips.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

// A box with a mirror-like ball, a blended card, a lamp, a spot and a sky through the open front.
std::shared_ptr<const World> busy_world() {
    Scene scene;
    const MaterialId white = test::add_lambert(scene, Vec3(0.7f));
    test::add_object(scene, test::make_quad(Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4)), white);
    test::add_object(scene, test::make_quad(Vec3(-2, 0, -2), Vec3(4, 0, 0), Vec3(0, 4, 0)), white);
    test::add_object(scene, test::make_quad(Vec3(-0.5f, 3.9f, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1)),
                     test::add_emitter(scene, Vec3(5, 4, 3)));
    Material metal;
    metal.metallic_factor = 1.0f;
    metal.roughness_factor = 0.2f;
    scene.materials.push_back(metal);
    const MaterialId metal_id{static_cast<uint32_t>(scene.materials.size() - 1)};
    test::add_object(scene, test::make_sphere(Vec3(0), 0.6f, 32, 16), metal_id,
                     glm::translate(Mat4(1), Vec3(-0.8f, 0.6f, 0)));
    scene.instances.push_back(
        {scene.instances.back().mesh, scene.instances.back().node,
         glm::translate(Mat4(1), Vec3(0.9f, 0.6f, 0.3f)) * glm::scale(Mat4(1), Vec3(0.8f, -1, 1))});
    const MaterialId card = test::add_lambert(scene, Vec3(0.2f, 0.9f, 0.3f));
    scene.materials[card.value].alpha_mode = AlphaMode::blend;
    scene.materials[card.value].base_color_factor.a = 0.5f;
    test::add_object(scene, test::make_quad(Vec3(-0.5f, 0.5f, 1), Vec3(1, 0, 0), Vec3(0, 1, 0)), card);
    PunctualLight spot;
    spot.kind = LightKind::spot;
    spot.intensity = 8;
    scene.lights.push_back(spot);
    scene.light_instances.push_back({{0}, {0}, look_at(Vec3(1.5f, 3, 1.5f), Vec3(0), Vec3(0, 1, 0))});
    scene.environment = test::constant_environment(Vec3(0.2f, 0.3f, 0.4f));
    return test::build(std::move(scene));
}

View busy_view() {
    View view;
    view.camera.world_from_camera = look_at(Vec3(0, 1.5f, 5), Vec3(0, 1.2f, 0), Vec3(0, 1, 0));
    view.extent = Vec2u(32, 24);
    return view;
}

void expect_equal_samples(const World& world, const View& view, const IntegratorSettings& settings,
                          const std::vector<PixelSample>& samples) {
    RayCounts scalar_counts, batched_counts;
    uint64_t segments = 0, shadow_rays = 0;
    for (size_t first = 0; first < samples.size(); first += 97) {
        const auto batch = std::span(samples).subspan(first, std::min<size_t>(97, samples.size() - first));
        std::vector<RadianceSample> out(batch.size());
        ASSERT_TRUE(trace_batch(world, view, settings, batch, out, batched_counts));
        for (size_t i = 0; i < batch.size(); ++i) {
            const RadianceSample expected = trace_sample(world, view, settings, batch[i], scalar_counts);
            ASSERT_EQ(out[i].radiance, expected.radiance);
            ASSERT_EQ(out[i].alpha, expected.alpha);
            ASSERT_EQ(out[i].segments, expected.segments);
            ASSERT_EQ(out[i].shadow_rays, expected.shadow_rays);
            segments += out[i].segments;
            shadow_rays += out[i].shadow_rays;
        }
    }
    EXPECT_EQ(scalar_counts.camera, batched_counts.camera);
    EXPECT_EQ(scalar_counts.bounce, batched_counts.bounce);
    EXPECT_EQ(scalar_counts.shadow, batched_counts.shadow);
    EXPECT_EQ(segments, batched_counts.camera + batched_counts.bounce) << "what the paths say of themselves";
    EXPECT_EQ(shadow_rays, batched_counts.shadow);
}

// One sample of each pixel, of indices below `indices`.
std::vector<PixelSample> samples_of(const View& view, uint32_t indices) {
    std::vector<PixelSample> out;
    for (uint32_t y = 0; y < view.extent.y; ++y) {
        for (uint32_t x = 0; x < view.extent.x; ++x)
            out.push_back({static_cast<uint16_t>(x), static_cast<uint16_t>(y), x % indices});
    }
    return out;
}

TEST(Drivers, BatchedEqualsScalarToTheBit) {
    const auto world = busy_world();
    const View view = busy_view();
    for (const Estimator estimator : {Estimator::mis, Estimator::light, Estimator::bsdf}) {
        for (const SamplerKind sampler : {SamplerKind::sobol, SamplerKind::independent}) {
            IntegratorSettings settings;
            settings.estimator = estimator;
            settings.sampler = sampler;
            expect_equal_samples(*world, view, settings, samples_of(view, 5));
        }
    }
}

// Random texels, no two alike for long, so that any other level, filter or coordinate gives another colour.
TextureId add_noise_texture(Scene& scene, int size, Texture sampler = {}) {
    const auto number = static_cast<uint32_t>(scene.images.size());
    ImageRgba8 image(size, size);
    for (uint32_t i = 0; Rgba8 & texel : image.pixels()) {
        const uint32_t hash = hash_combine(number, i++);
        texel = Rgba8(hash, hash >> 8, hash >> 16, hash >> 24);
    }
    scene.images.emplace_back().pixels = std::make_shared<const ImageRgba8>(std::move(image));
    sampler.image = {number};
    scene.textures.push_back(sampler);
    return {static_cast<uint32_t>(scene.textures.size() - 1)};
}

// Every use of a texture: a floor to the horizon, mapped metal with leaning normals, a cut-out and a blended card, a
// textured lamp, tinted glass, and a mirrored copy in an instance.
std::shared_ptr<const World> textured_world() {
    Scene scene;
    const auto with_texture = [&](MaterialId id, TextureRef Material::*use, TextureId texture) {
        (scene.materials[id.value].*use).texture = texture;
        return id;
    };
    const MaterialId floor =
        with_texture(test::add_lambert(scene, Vec3(0.8f)), &Material::base_color, add_noise_texture(scene, 64));
    scene.materials[floor.value].base_color.uv_transform = {30, 4, -4, 30, 0.3f, 0.7f};
    test::add_object(scene, test::make_quad(Vec3(-50, 0, 50), Vec3(100, 0, 0), Vec3(0, 0, -100)), floor);

    Texture mirrored;
    mirrored.wrap_u = WrapMode::mirrored_repeat;
    mirrored.wrap_v = WrapMode::clamp_to_edge;
    mirrored.mip_filter = MipFilter::nearest;
    Material metal;
    metal.base_color.texture = add_noise_texture(scene, 256, mirrored);
    metal.base_color.uv_transform = {3, 0, 0, 3, -1, -1};
    metal.metallic_roughness.texture = add_noise_texture(scene, 32);
    metal.normal.texture = add_noise_texture(scene, 16);
    metal.normal_scale = 0.3f;
    scene.materials.push_back(metal);
    test::add_object(scene, test::make_sphere(Vec3(0), 0.6f, 32, 16),
                     {static_cast<uint32_t>(scene.materials.size() - 1)},
                     glm::translate(Mat4(1), Vec3(-0.8f, 0.6f, 0)));
    scene.instances.push_back({scene.instances.back().mesh, scene.instances.back().node,
                               glm::translate(Mat4(1), Vec3(0.9f, 0.6f, 0.3f)) * glm::scale(Mat4(1), Vec3(1, -1, 1))});

    Texture blocky;
    blocky.mag_filter = blocky.min_filter = TextureFilter::nearest;
    for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
        const MaterialId card = with_texture(test::add_lambert(scene, Vec3(0.9f)), &Material::base_color,
                                             add_noise_texture(scene, 128, blocky));
        scene.materials[card.value].alpha_mode = mode;
        const float x = mode == AlphaMode::mask ? -1.5f : 0.5f;
        test::add_object(scene, test::make_quad(Vec3(x, 0.4f, 1), Vec3(1, 0, 0), Vec3(0, 1, 0)), card);
    }
    const MaterialId lamp =
        with_texture(test::add_emitter(scene, Vec3(6, 5, 4)), &Material::emissive, add_noise_texture(scene, 64));
    test::add_object(scene, test::make_quad(Vec3(-1, 3, -1), Vec3(2, 0, 0), Vec3(0, 0, 2)), lamp);
    Material glass;
    glass.metallic_factor = 0;
    glass.roughness_factor = 0.1f;
    glass.transmission.factor = 1;
    glass.transmission.texture.texture = glass.base_color.texture = add_noise_texture(scene, 64);
    glass.volume.thickness_factor = 1;
    scene.materials.push_back(glass);
    test::add_object(scene, test::make_sphere(Vec3(0, 0.4f, 1.4f), 0.4f, 24, 12),
                     {static_cast<uint32_t>(scene.materials.size() - 1)});
    scene.environment = test::constant_environment(Vec3(0.2f, 0.3f, 0.4f));
    make_color_mips(scene);
    return test::build(std::move(scene));
}

TEST(Drivers, BatchedEqualsScalarToTheBitWithFilteredTextures) {
    const auto world = textured_world();
    const View view = busy_view();
    const std::vector<PixelSample> samples = samples_of(view, 7);
    int filtered_otherwise = 0;
    for (const bool filters : {true, false}) {
        IntegratorSettings settings;
        settings.filter_textures = filters;
        expect_equal_samples(*world, view, settings, samples);
    }
    IntegratorSettings filtered, level_0;
    level_0.filter_textures = false;
    RayCounts counts;
    for (const PixelSample& sample : samples) {
        filtered_otherwise += trace_sample(*world, view, filtered, sample, counts).radiance !=
                              trace_sample(*world, view, level_0, sample, counts).radiance;
    }
    EXPECT_GT(filtered_otherwise, static_cast<int>(samples.size() / 3)) << "smaller levels are looked at";
}

TEST(Drivers, CancelledBatchSaysSo) {
    const auto world = busy_world();
    const std::atomic<uint64_t> epoch{2};
    RayCounts counts;
    const PixelSample sample{3, 4, 0};
    RadianceSample out;
    EXPECT_FALSE(trace_batch(*world, busy_view(), {}, {&sample, 1}, {&out, 1}, counts, &epoch, 1));
    EXPECT_TRUE(trace_batch(*world, busy_view(), {}, {&sample, 1}, {&out, 1}, counts, &epoch, 2));
}

TEST(Settings, MaxDepthOneIsDirectLightOnly) {
    // Two facing mirrors of light: with one scattering event a white floor under a sky shows no interreflection.
    const auto world = busy_world();
    RayCounts counts;
    double direct = 0;
    double full = 0;
    for (uint32_t i = 0; i < 512; ++i) {
        IntegratorSettings settings;
        const PixelSample sample{16, 12, i};
        full += static_cast<double>(luminance(trace_sample(*world, busy_view(), settings, sample, counts).radiance));
        settings.max_depth = 1;
        RayCounts shallow;
        direct += static_cast<double>(luminance(trace_sample(*world, busy_view(), settings, sample, shallow).radiance));
        EXPECT_LE(shallow.bounce, 1u);
        EXPECT_LE(shallow.shadow, 1u);
    }
    EXPECT_LT(direct, full);
    EXPECT_GT(direct, 0.0);
}

TEST(Settings, BackgroundIsWhatCameraRaysSeeAndNothingElse) {
    Scene scene;
    test::add_object(scene, test::make_quad(Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2)),
                     test::add_lambert(scene, Vec3(1)));
    scene.environment = test::constant_environment(Vec3(1));
    const auto world = test::build(std::move(scene));
    IntegratorSettings settings;
    settings.filter = PixelFilter::box;
    View up;
    up.camera.world_from_camera = look_at(Vec3(0, 1, 0), Vec3(0, 2, 0), Vec3(0, 0, 1));
    RayCounts counts;
    EXPECT_EQ(trace_sample(*world, up, settings, {0, 0, 0}, counts).radiance, Vec3(1));
    settings.background = BackgroundKind::color;
    settings.background_color = Vec3(0.1f, 0.2f, 0.3f);
    EXPECT_EQ(trace_sample(*world, up, settings, {0, 0, 0}, counts).radiance, Vec3(0.1f, 0.2f, 0.3f));
    settings.background = BackgroundKind::transparent;
    EXPECT_EQ(trace_sample(*world, up, settings, {0, 0, 0}, counts).alpha, 0.0f);

    // The plane is lit by the environment all the same.
    View down;
    down.camera.world_from_camera = look_at(Vec3(0, 1, 0), Vec3(0), Vec3(0, 0, 1));
    double sum = 0;
    for (uint32_t i = 0; i < 256; ++i) {
        const RadianceSample r = trace_sample(*world, down, settings, {0, 0, i}, counts);
        EXPECT_EQ(r.alpha, 1.0f);
        sum += static_cast<double>(r.radiance.x);
    }
    EXPECT_NEAR(sum / 256, 1.0, 0.05);
}

TEST(Aov, FirstHitReportsTheSurface) {
    Scene scene;
    test::add_object(scene, test::make_quad(Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2)),
                     test::add_lambert(scene, Vec3(0.25f, 0.5f, 0.75f)));
    const auto world = test::build(std::move(scene));
    View down;
    down.camera.world_from_camera = look_at(Vec3(0.5f, 3, 0), Vec3(0.5f, 0, 0), Vec3(0, 0, 1));
    const FirstHit hit = trace_first_hit(*world, down, Vec2(0.5f));
    ASSERT_TRUE(hit.hit);
    EXPECT_NEAR(hit.depth, 3.0f, 1e-5f);
    EXPECT_LT(glm::length(hit.normal - Vec3(0, 1, 0)), 1e-5f);
    EXPECT_LT(glm::length(hit.albedo - Vec3(0.25f, 0.5f, 0.75f)), 1e-3f);
    EXPECT_LT(glm::length(hit.position - Vec3(0.5f, 0, 0)), 1e-5f);
    EXPECT_EQ(hit.instance, 0u);
    EXPECT_FALSE(trace_first_hit(*world, down, Vec2(0.0f, 50.0f)).hit);
}

}  // namespace
}  // namespace candela
