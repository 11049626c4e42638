// SPDX-License-Identifier: MIT
// Light kept apart by where it comes from: the parts make the whole, and each is what its light alone would give.
#include "renderer/integrator/light_groups.h"

#include <cmath>

#include "tests/support/scenes.h"

namespace candela {
namespace {

// A floor and a mirror ball under two lamps of different colours, a point light and a sky.
Scene lit_scene(Vec3 first, Vec3 second, Vec3 sky) {
    Scene scene;
    test::add_object(scene, test::make_quad(Vec3(-3, 0, 3), Vec3(6, 0, 0), Vec3(0, 0, -6)),
                     test::add_lambert(scene, Vec3(0.7f)));
    test::add_object(scene, test::make_sphere(Vec3(0, 0.7f, 0), 0.7f, 24, 12),
                     test::add_lambert(scene, Vec3(0.8f, 0.6f, 0.5f)));
    for (const auto& [x, radiance] : {std::pair(-2.0f, first), std::pair(1.0f, second)}) {
        const MaterialId material = test::add_emitter(scene, radiance);
        scene.materials[material.value].name = x < 0 ? "left" : "right";
        test::add_object(scene, test::make_quad(Vec3(x, 3, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1)), material);
    }
    scene.environment = test::constant_environment(sky);
    return scene;
}

View view_of_it() {
    View view;
    view.camera.world_from_camera = look_at(Vec3(0.5f, 2.0f, 5), Vec3(0, 1, 0), Vec3(0, 1, 0));
    view.extent = Vec2u(24, 18);
    return view;
}

struct Traced {
    std::vector<RadianceSample> samples;
    std::vector<Vec3> by_light;
    RayCounts counts;
};

Traced trace_all(const World& world, const LightGroups& groups, uint32_t spp, const IntegratorSettings& settings = {}) {
    const View view = view_of_it();
    Traced out;
    std::vector<PixelSample> tile;
    const auto flush = [&] {
        const size_t first = out.samples.size();
        out.samples.resize(first + tile.size());
        out.by_light.resize(out.samples.size() * groups.size());
        ASSERT_TRUE(trace_grouped(world, view, settings, groups, tile, std::span(out.samples).subspan(first),
                                  std::span(out.by_light).subspan(first * groups.size()), out.counts));
        tile.clear();
    };
    for (uint32_t index = 0; index < spp; ++index) {
        for (uint16_t y = 0; y < view.extent.y; ++y) {
            for (uint16_t x = 0; x < view.extent.x; ++x) {
                tile.push_back({x, y, index});
                if (tile.size() == max_batch) flush();
            }
        }
    }
    flush();
    return out;
}

size_t group_named(const LightGroups& groups, const std::string& name) {
    for (size_t i = 0; i < groups.size(); ++i) {
        if (groups.names[i] == name) return i;
    }
    ADD_FAILURE() << "no group " << name;
    return 0;
}

TEST(LightGroups, TheTotalIsThatOfThePlainDriversToTheBitAndThePartsAddUpToIt) {
    const std::shared_ptr<const World> world = test::build(lit_scene(Vec3(9, 4, 1), Vec3(1, 3, 8), Vec3(0.3f)));
    const std::shared_ptr<const LightGroups> groups = make_light_groups(*world);
    ASSERT_EQ(groups->size(), 4u);
    EXPECT_EQ(groups->names.front(), "environment");
    EXPECT_EQ(groups->names.back(), "the rest");
    for (const Estimator estimator : {Estimator::mis, Estimator::light, Estimator::bsdf}) {
        IntegratorSettings settings;
        settings.estimator = estimator;
        settings.clamp_indirect = estimator == Estimator::light ? 0.5f : 0.0f;
        const Traced traced = trace_all(*world, *groups, 2, settings);
        RayCounts counts;
        size_t i = 0;
        for (uint32_t index = 0; index < 2; ++index) {
            for (uint16_t y = 0; y < 18; ++y) {
                for (uint16_t x = 0; x < 24; ++x, ++i) {
                    const RadianceSample plain = trace_sample(*world, view_of_it(), settings, {x, y, index}, counts);
                    ASSERT_EQ(traced.samples[i].radiance, plain.radiance);
                    ASSERT_EQ(traced.samples[i].segments, plain.segments);
                    ASSERT_EQ(traced.samples[i].shadow_rays, plain.shadow_rays);
                    Vec3 sum(0);
                    for (size_t g = 0; g < groups->size(); ++g)
                        sum += traced.by_light[i * groups->size() + g];
                    ASSERT_LE(max_component(glm::abs(sum - plain.radiance)),
                              1e-6f * std::max(max_component(plain.radiance), 1.0f));
                }
            }
        }
        EXPECT_EQ(traced.counts.total(), counts.total());
    }
}

TEST(LightGroups, EachPartIsWhatItsLightAloneGives) {
    const Vec3 first(9, 4, 1), second(1, 3, 8), sky(0.3f);
    const std::shared_ptr<const World> all = test::build(lit_scene(first, second, sky));
    const std::shared_ptr<const LightGroups> groups = make_light_groups(*all);
    constexpr uint32_t spp = 48;
    const Traced traced = trace_all(*all, *groups, spp);

    // Means over the picture of batches of passes, and how far they scatter.
    const auto mean = [&](const auto& value, size_t count) {
        constexpr size_t batches = 12;
        std::array<double, batches> means{};
        for (size_t i = 0; i < count; ++i)
            means[i * batches / count] += static_cast<double>(value(i)) * batches / static_cast<double>(count);
        double sum = 0, squares = 0;
        for (const double m : means) {
            sum += m / batches;
            squares += m * m / batches;
        }
        return std::pair(sum, std::sqrt(std::max(squares - sum * sum, 0.0) / (batches - 1)));
    };
    const auto compare = [&](const std::string& name, const Scene& alone) {
        const std::shared_ptr<const World> world = test::build(Scene(alone));
        const std::shared_ptr<const LightGroups> own = make_light_groups(*world);
        const Traced wanted = trace_all(*world, *own, spp);
        const size_t group = group_named(*groups, name);
        for (int channel = 0; channel < 3; ++channel) {
            const auto [a, a_error] = mean(
                [&](size_t i) { return traced.by_light[i * groups->size() + group][channel]; }, traced.samples.size());
            const auto [b, b_error] =
                mean([&](size_t i) { return wanted.samples[i].radiance[channel]; }, wanted.samples.size());
            EXPECT_NEAR(a, b, 4.5 * std::hypot(a_error, b_error) + 1e-4 * b) << name << " " << channel;
            EXPECT_GT(a, 0.001);
        }
    };
    compare("left", lit_scene(first, Vec3(0), Vec3(0)));
    compare("right", lit_scene(Vec3(0), second, Vec3(0)));
    compare("environment", lit_scene(Vec3(0), Vec3(0), sky));
}

TEST(LightGroups, TheMostPowerfulHaveTheirOwnAndABackgroundIsTheRest) {
    Scene scene = lit_scene(Vec3(1), Vec3(2), Vec3(0.5f));
    for (int i = 0; i < 12; ++i) {
        const MaterialId material = test::add_emitter(scene, Vec3(100.0f + static_cast<float>(i)));
        scene.materials[material.value].name = "bulb " + std::to_string(i);
        test::add_object(scene, test::make_quad(Vec3(-3, 4, static_cast<float>(i)), Vec3(1, 0, 0), Vec3(0, 0, 1)),
                         material);
    }
    const std::shared_ptr<const World> world = test::build(std::move(scene));
    const std::shared_ptr<const LightGroups> groups = make_light_groups(*world);
    EXPECT_EQ(groups->size(), most_light_groups);
    EXPECT_EQ(groups->names[1], "bulb 11");
    EXPECT_EQ(groups->names[7], "bulb 5");

    View up;
    up.camera.world_from_camera = look_at(Vec3(0, 8, 0), Vec3(0, 20, 0.1f), Vec3(0, 0, 1));
    IntegratorSettings settings;
    RadianceSample sample;
    std::vector<Vec3> parts(groups->size());
    RayCounts counts;
    const PixelSample first{0, 0, 0};
    trace_grouped(*world, up, settings, *groups, {&first, 1}, {&sample, 1}, parts, counts);
    EXPECT_EQ(parts.front(), Vec3(0.5f)) << "the sky is the environment's";
    settings.background = BackgroundKind::color;
    settings.background_color = Vec3(0.1f, 0.2f, 0.3f);
    trace_grouped(*world, up, settings, *groups, {&first, 1}, {&sample, 1}, parts, counts);
    EXPECT_EQ(parts.front(), Vec3(0));
    EXPECT_EQ(parts.back(), Vec3(0.1f, 0.2f, 0.3f));
}

}  // namespace
}  // namespace candela
