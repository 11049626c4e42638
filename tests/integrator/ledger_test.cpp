// SPDX-License-Identifier: MIT
#include "renderer/integrator/ledger.h"

#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "renderer/io/load_gltf.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

constexpr Vec2u extent(32, 24);

struct Box {
    std::shared_ptr<const World> world;
    View view;
};

Box cornell_box() {
    static const Box box = [] {
        Diagnostics diagnostics;
        const auto scene = std::make_shared<const Scene>(load_gltf("assets/cornell_box.glb", diagnostics));
        return Box{build_world(scene), {scene->cameras.front().camera, extent}};
    }();
    return box;
}

TEST(Ledger, IsTheSampleOfThePictureToTheBit) {
    const Box box = cornell_box();
    for (uint16_t i = 0; i < 200; ++i) {
        const PixelSample sample{static_cast<uint16_t>(i % 32), static_cast<uint16_t>(i / 10), i};
        RayCounts counts;
        const RadianceSample traced = trace_sample(*box.world, box.view, {}, sample, counts);
        const Ledger ledger = trace_ledger(*box.world, box.view, {}, sample, 10);
        ASSERT_EQ(ledger.radiance, traced.radiance) << i;
        // Its rows add up to it, and the surfaces to what it cost.
        Vec3 sum(0);
        for (const LedgerVertex& vertex : ledger.vertices)
            sum += vertex.found + vertex.connected;
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(sum[c], traced.radiance[c], 1e-4f * (1 + traced.radiance[c]));
        ASSERT_EQ(ledger.vertices.size(), traced.segments);
    }
}

TEST(Ledger, TellsWhatHappened) {
    // A mirror on the floor that shows a lamp overhead; a pane of glass in between would be passed.
    Scene scene;
    Material mirror;
    mirror.roughness_factor = 0;
    mirror.metallic_factor = 1;
    scene.materials.push_back(mirror);
    test::add_object(scene, test::make_quad(Vec3(-9, 0, 9), Vec3(18, 0, 0), Vec3(0, 0, -18)), MaterialId{0});
    test::add_object(scene, test::make_quad(Vec3(-9, 5, -9), Vec3(18, 0, 0), Vec3(0, 0, 18)),
                     test::add_emitter(scene, Vec3(2), Vec3(0)));
    const std::shared_ptr<const World> world = test::build(std::move(scene));
    View view;
    view.camera.world_from_camera = look_at(Vec3(0, 2, 2), Vec3(0, 0, 0), Vec3(0, 1, 0));
    view.extent = extent;
    const Ledger ledger = trace_ledger(*world, view, {}, {16, 12, 3}, 100);
    ASSERT_EQ(ledger.vertices.size(), 2u);
    EXPECT_STREQ(name_of_scattering(ledger.vertices[0].shading), "specular reflection");
    EXPECT_TRUE(ledger.vertices[0].shading.is_delta);
    EXPECT_EQ(ledger.vertices[0].material, 0u);
    EXPECT_NEAR(ledger.vertices[0].position.y, 0, 1e-5f);
    EXPECT_EQ(ledger.vertices[1].shading.end, PathEnd::absorbed);
    ASSERT_TRUE(ledger.vertices[1].shading.found.has_value());
    EXPECT_EQ(ledger.vertices[1].shading.found->technique, LightTechnique::bsdf_sample);
    EXPECT_EQ(ledger.vertices[1].shading.found->share, 1) << "no light sample could have found it";
    EXPECT_NEAR(ledger.vertices[1].found.g, 2, 1e-4f);
    EXPECT_NEAR(ledger.vertices[1].position.y, 5, 1e-4f);
    EXPECT_EQ(ledger.eye, Vec3(0, 2, 2));
}

// A room with a lamp, points of light (one of them in a body) and a sky, and things of many materials in it.
Box many_materials() {
    Scene scene;
    const auto add = [&](const Material& material) {
        scene.materials.push_back(material);
        return MaterialId{static_cast<uint32_t>(scene.materials.size() - 1)};
    };
    Material glass;
    glass.metallic_factor = glass.roughness_factor = 0;
    glass.transmission.factor = 1;
    glass.volume = {.thickness_factor = 1, .attenuation_color = Vec3(0.9f, 0.5f, 0.4f), .attenuation_distance_m = 1};
    Material prism = glass;
    prism.roughness_factor = 0.3f;
    prism.volume.dispersion = 0.5f;
    Material pane = glass;
    pane.base_color_factor = Vec4(0.9f, 0.7f, 0.8f, 1);
    pane.volume = {};
    Material coated;
    coated.base_color_factor = Vec4(0.7f, 0.2f, 0.1f, 1);
    coated.metallic_factor = 0.5f;
    coated.roughness_factor = 0.4f;
    coated.clearcoat.factor = 1;
    coated.sheen.color_factor = Vec3(0.3f);
    coated.sheen.roughness_factor = 0.5f;
    Material leaf;
    leaf.metallic_factor = 0;
    leaf.diffuse_transmission.factor = 0.5f;

    test::add_object(scene, test::make_quad(Vec3(-4, 0, 4), Vec3(8, 0, 0), Vec3(0, 0, -8)),
                     test::add_lambert(scene, Vec3(0.7f, 0.6f, 0.5f)));
    test::add_object(scene, test::make_quad(Vec3(-4, 0, -4), Vec3(8, 0, 0), Vec3(0, 5, 0)),
                     test::add_lambert(scene, Vec3(0.2f, 0.6f, 0.5f)));
    test::add_object(scene, test::make_sphere(Vec3(-2, 1, 0), 1, 16, 8), add(glass));
    test::add_object(scene, test::make_sphere(Vec3(0, 1, -1), 1, 16, 8), add(prism));
    test::add_object(scene, test::make_sphere(Vec3(2, 1, 0), 1, 16, 8), add(coated));
    test::add_object(scene, test::make_quad(Vec3(-1, 0.2f, 1.5f), Vec3(1, 0, 0), Vec3(0, 1, 0.2f)), add(pane));
    test::add_object(scene, test::make_quad(Vec3(0.3f, 0.2f, 1.5f), Vec3(1, 0, 0), Vec3(0, 1, 0.2f)), add(leaf));
    test::add_object(scene, test::make_quad(Vec3(-1, 4, -1), Vec3(2, 0, 0), Vec3(0, 0, 2)),
                     test::add_emitter(scene, Vec3(8, 7, 6), Vec3(0.3f)));
    PunctualLight point;
    point.intensity = 9;
    scene.lights.push_back(point);
    for (const Vec3& place : {Vec3(1, 3, 3), Vec3(0, 1, -1)})
        scene.light_instances.push_back({{0}, {}, glm::translate(Mat4(1), place)});
    scene.environment = test::constant_environment(Vec3(0.2f, 0.3f, 0.4f));
    View view;
    view.camera.world_from_camera = look_at(Vec3(0, 2, 7), Vec3(0, 1, 0), Vec3(0, 1, 0));
    view.extent = extent;
    return {test::build(std::move(scene)), view};
}

void expect_near(const Vec3& a, const Vec3& b, const std::string& what) {
    for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(a[c], b[c], 1e-4f * std::abs(b[c]) + 1e-7f) << what;
}

TEST(Ledger, ItsFactorsMultiplyToTheRadianceOfTheSample) {
    const Box box = many_materials();
    std::map<std::string, int> lobes;
    int found = 0, connected = 0, hidden = 0, gave_up = 0, survived = 0;
    for (uint32_t i = 0; i < 32 * 24; ++i) {
        const PixelSample sample{static_cast<uint16_t>(i % 32), static_cast<uint16_t>(i / 32), i % 5};
        const Ledger ledger = trace_ledger(*box.world, box.view, {}, sample, 10);
        RayCounts counts;
        ASSERT_EQ(ledger.radiance, trace_sample(*box.world, box.view, {}, sample, counts).radiance) << i;
        Vec3 carried(1), radiance(0);
        for (const LedgerVertex& vertex : ledger.vertices) {
            const VertexRecord& shading = vertex.shading;
            carried *= shading.transmittance;
            if (shading.found) {
                const Vec3 brought = carried * shading.found->light * shading.found->share;
                expect_near(brought, vertex.found, "found");
                radiance += brought;
                ++found;
            }
            if (shading.sampled) {
                const LightRecord& light = *shading.sampled;
                const Vec3 brought =
                    carried * light.scattered * light.light * light.transmittance * light.share * vertex.visibility;
                expect_near(brought, vertex.connected, "connected");
                radiance += brought;
                ++connected;
                if (is_black(vertex.visibility)) ++hidden;
                const float l = light.light_pdf, b = light.bsdf_pdf;
                ASSERT_NEAR(light.share, l * l / (l * l + b * b), 1e-4f);
            }
            if (shading.lobe != bsdf_lobe_count) ++lobes[name_of_scattering(shading)];
            if (shading.end == PathEnd::roulette) ++gave_up;
            if (shading.end != PathEnd::none) continue;
            carried *= shading.weight / shading.survival;
            if (shading.survival < 1) ++survived;
            expect_near(carried, vertex.throughput, "throughput");
        }
        expect_near(radiance, ledger.radiance, "radiance");
        ASSERT_NE(ledger.vertices.back().shading.end, PathEnd::none);
    }
    EXPECT_GT(found, 300);
    EXPECT_GT(connected, 500);
    EXPECT_GT(hidden, 50);
    EXPECT_GT(gave_up, 50);
    EXPECT_GT(survived, 100);
    for (const char* name :
         {"clear coat", "sheen", "specular reflection", "diffuse", "diffuse transmission", "transmission"})
        EXPECT_GT(lobes[name], 3) << name;
    EXPECT_EQ(lobes.size(), 6u);
}

// What the first vertex scatters by, of 200 samples that look down at a floor under a sky.
std::map<std::string, int> lobes_of(const Material& material, const std::function<void(const Ledger&)>& check) {
    Scene scene;
    scene.materials.push_back(material);
    test::add_object(scene, test::make_quad(Vec3(-9, 0, 9), Vec3(18, 0, 0), Vec3(0, 0, -18)), MaterialId{0});
    scene.environment = test::constant_environment(Vec3(1));
    const std::shared_ptr<const World> world = test::build(std::move(scene));
    View view;
    view.camera.world_from_camera = look_at(Vec3(0, 3, 2), Vec3(0, 0, 0), Vec3(0, 1, 0));
    view.extent = extent;
    std::map<std::string, int> out;
    for (uint32_t i = 0; i < 200; ++i) {
        const Ledger ledger = trace_ledger(*world, view, {}, {16, 12, i}, 100);
        ++out[name_of_scattering(ledger.vertices[0].shading)];
        if (ledger.vertices.size() > 1) check(ledger);
    }
    return out;
}

// Where the first vertex sent the path.
Vec3 direction_of(const Ledger& ledger) {
    return glm::normalize(ledger.vertices[1].position - ledger.vertices[0].position);
}

TEST(Ledger, NamesTheLobeThatWasDrawn) {
    const auto is_mirrored = [](const Ledger& ledger) {
        const Vec3 in = glm::normalize(ledger.vertices[0].position - ledger.eye);
        return glm::distance(direction_of(ledger), Vec3(in.x, -in.y, in.z)) < 1e-3f;
    };
    const auto is_named = [](const Ledger& ledger, const std::string& name) {
        return name_of_scattering(ledger.vertices[0].shading) == name;
    };
    using Lobes = std::map<std::string, int>;
    Material matt;
    matt.metallic_factor = 0;
    matt.specular.factor = 0;
    EXPECT_EQ(lobes_of(matt,
                       [](const Ledger& ledger) {
                           EXPECT_NEAR(ledger.vertices[0].shading.pdf, direction_of(ledger).y / pi, 1e-3f);
                       }),
              (Lobes{{"diffuse", 200}}));

    // Through the coat, which is smooth, everything is scattered widely.
    Material coated = matt;
    coated.clearcoat.factor = 1;
    const Lobes of_coat = lobes_of(coated, [&](const Ledger& ledger) {
        EXPECT_EQ(is_mirrored(ledger), is_named(ledger, "clear coat"));
        EXPECT_EQ(is_mirrored(ledger), ledger.vertices[0].shading.is_delta);
    });
    EXPECT_EQ(of_coat.size(), 2u);
    EXPECT_GT(of_coat.at("clear coat"), 5);
    EXPECT_GT(of_coat.at("diffuse"), 100);

    Material glass = matt;
    glass.specular.factor = 1;
    glass.transmission.factor = 1;
    glass.volume.thickness_factor = 1;
    for (const float roughness : {0.0f, 0.4f}) {
        glass.roughness_factor = roughness;
        const Lobes of_glass = lobes_of(glass, [&](const Ledger& ledger) {
            EXPECT_EQ(direction_of(ledger).y < 0, is_named(ledger, "transmission"));
        });
        EXPECT_EQ(of_glass.size(), 2u);
        EXPECT_GT(of_glass.at("transmission"), 100);
        EXPECT_GT(of_glass.at("specular reflection"), 2);
    }

    Material leaf = matt;
    leaf.diffuse_transmission.factor = 0.5f;
    const Lobes of_leaf = lobes_of(leaf, [&](const Ledger& ledger) {
        EXPECT_EQ(direction_of(ledger).y < 0, is_named(ledger, "diffuse transmission"));
    });
    EXPECT_EQ(of_leaf.size(), 2u);
    EXPECT_GT(of_leaf.at("diffuse transmission"), 50);

    Material metal;
    metal.roughness_factor = 0.5f;
    // Some of its facets send light into the surface.
    Lobes of_metal = lobes_of(metal, [](const Ledger&) {});
    EXPECT_EQ(of_metal["specular reflection"] + of_metal["no direction"], 200);
    EXPECT_LT(of_metal["no direction"], 20);
    Material velvet = matt;
    velvet.base_color_factor = Vec4(0, 0, 0, 1);
    velvet.sheen.color_factor = Vec3(1);
    velvet.sheen.roughness_factor = 0.7f;
    EXPECT_EQ(lobes_of(velvet, [](const Ledger&) {}), (Lobes{{"sheen", 200}}));
}

TEST(Ledger, TellsWhyAPathEnds) {
    const Box box = many_materials();
    IntegratorSettings settings;
    settings.max_depth = 2;
    settings.russian_roulette = false;
    for (uint32_t i = 0; i < 100; ++i) {
        const Ledger ledger = trace_ledger(*box.world, box.view, settings, {16, 20, i}, 10);
        const PathEnd end = ledger.vertices.back().shading.end;
        ASSERT_TRUE(end == PathEnd::depth || end == PathEnd::missed || end == PathEnd::absorbed);
        if (end == PathEnd::missed) {
            const std::optional<LightRecord>& sky = ledger.vertices.back().shading.found;
            ASSERT_TRUE(sky.has_value());
            EXPECT_EQ(sky->surface, invalid_index);
            EXPECT_EQ(sky->technique, ledger.vertices.size() == 1 ? LightTechnique::seen : LightTechnique::bsdf_sample);
        }
    }
}

TEST(Ledger, TheBrightestSampleIsTheBrightest) {
    const Box box = cornell_box();
    const std::optional<PixelSample> found = brightest_sample(*box.world, box.view, {}, {9, 20}, 100);
    ASSERT_TRUE(found.has_value());
    float best = -1;
    uint32_t index = 0;
    for (uint32_t i = 0; i < 100; ++i) {
        RayCounts counts;
        const float here = luminance(trace_sample(*box.world, box.view, {}, {9, 20, i}, counts).radiance);
        if (here > best) {
            best = here;
            index = i;
        }
    }
    EXPECT_EQ(found->index, index);
    EXPECT_EQ(found->x, 9);
    EXPECT_EQ(found->y, 20);
    const std::atomic<bool> cancel{true};
    EXPECT_FALSE(brightest_sample(*box.world, box.view, {}, {9, 20}, 100, &cancel).has_value());
}

}  // namespace
}  // namespace candela
