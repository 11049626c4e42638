// SPDX-License-Identifier: MIT
// The batched driver gives the scalar driver's samples to the bit; settings mean what they say.
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/integrator/aov.h"
#include "renderer/integrator/integrator.h"
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

TEST(Drivers, BatchedEqualsScalarToTheBit) {
    const auto world = busy_world();
    const View view = busy_view();
    for (const Estimator estimator : {Estimator::mis, Estimator::light, Estimator::bsdf}) {
        for (const SamplerKind sampler : {SamplerKind::sobol, SamplerKind::independent}) {
            IntegratorSettings settings;
            settings.estimator = estimator;
            settings.sampler = sampler;
            RayCounts scalar_counts, batched_counts;
            uint64_t segments = 0, shadow_rays = 0;
            std::vector<PixelSample> samples;
            for (uint32_t y = 0; y < view.extent.y; ++y) {
                for (uint32_t x = 0; x < view.extent.x; ++x) {
                    samples.push_back({static_cast<uint16_t>(x), static_cast<uint16_t>(y), x % 5});
                }
            }
            for (size_t first = 0; first < samples.size(); first += 97) {
                const auto batch = std::span(samples).subspan(first, std::min<size_t>(97, samples.size() - first));
                std::vector<RadianceSample> out(batch.size());
                ASSERT_TRUE(trace_batch(*world, view, settings, batch, out, batched_counts));
                for (size_t i = 0; i < batch.size(); ++i) {
                    const RadianceSample expected = trace_sample(*world, view, settings, batch[i], scalar_counts);
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
    }
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
