// SPDX-License-Identifier: MIT
// Paths that are shared: the same picture as of paths each alone, with less noise; the same in both drivers.
#include "renderer/integrator/path_reuse.h"

#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <set>

#include "tests/support/scenes.h"
#include "tests/support/tiles.h"

namespace candela {
namespace {

void add_mapped_material(Scene& scene, Material& material) {
    ImageRgba8 image(8, 8);
    for (uint32_t i = 0; Rgba8 & texel : image.pixels()) {
        texel = Rgba8(128 + (i * 37) % 100 - 50, 128 + (i * 61) % 100 - 50, 220, 255);
        ++i;
    }
    scene.images.emplace_back().pixels = std::make_shared<const ImageRgba8>(std::move(image));
    Texture texture;
    texture.image = {static_cast<uint32_t>(scene.images.size() - 1)};
    scene.textures.push_back(texture);
    material.normal.texture = {static_cast<uint32_t>(scene.textures.size() - 1)};
}

// A room with all that a vertex can be: matt, glossy, clear-coated, normal-mapped, a blended card, a pane, a rough
// pane, a ball of glass, a lamp, a spot, a sky through the open front.
std::shared_ptr<const World> furnished_room() {
    Scene scene;
    const auto add = [&](const Material& material) {
        scene.materials.push_back(material);
        return MaterialId{static_cast<uint32_t>(scene.materials.size() - 1)};
    };
    const auto ball = [&](const Vec3& centre, float radius, const Material& material) {
        test::add_object(scene, test::make_sphere(Vec3(0), radius, 24, 12), add(material),
                         glm::translate(Mat4(1), centre));
    };
    const MaterialId white = test::add_lambert(scene, Vec3(0.7f));
    test::add_object(scene, test::make_quad(Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4)), white);
    test::add_object(scene, test::make_quad(Vec3(-2, 4, -2), Vec3(4, 0, 0), Vec3(0, 0, 4)), white);
    Material bumpy;
    bumpy.metallic_factor = 0;
    bumpy.base_color_factor = Vec4(0.6f, 0.3f, 0.2f, 1);
    add_mapped_material(scene, bumpy);
    test::add_object(scene, test::make_quad(Vec3(-2, 0, -2), Vec3(4, 0, 0), Vec3(0, 4, 0)), add(bumpy));
    test::add_object(scene, test::make_quad(Vec3(-0.5f, 3.9f, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1)),
                     test::add_emitter(scene, Vec3(5, 4, 3)));

    Material glossy, coated, glass, pane;
    glossy.metallic_factor = 1;
    glossy.roughness_factor = 0.35f;
    ball(Vec3(-1.2f, 0.5f, 0), 0.5f, glossy);
    coated.metallic_factor = 0;
    coated.roughness_factor = 0.6f;
    coated.clearcoat.factor = 1;
    ball(Vec3(1.2f, 0.5f, -1), 0.5f, coated);
    glass.metallic_factor = 0;
    glass.roughness_factor = 0;
    glass.transmission.factor = 1;
    glass.volume.thickness_factor = 1;
    ball(Vec3(0, 0.5f, 0.4f), 0.4f, glass);
    pane.metallic_factor = 0;
    pane.roughness_factor = 0;
    pane.transmission.factor = 0.8f;
    test::add_object(scene, test::make_quad(Vec3(-1.8f, 0.2f, 0.8f), Vec3(1.2f, 0, 0), Vec3(0, 1.4f, 0)), add(pane));
    pane.roughness_factor = 0.5f;
    test::add_object(scene, test::make_quad(Vec3(0.8f, 0.2f, 0.8f), Vec3(1, 0, 0), Vec3(0, 1.4f, 0)), add(pane));
    const MaterialId card = test::add_lambert(scene, Vec3(0.2f, 0.9f, 0.3f));
    scene.materials[card.value].alpha_mode = AlphaMode::blend;
    scene.materials[card.value].base_color_factor.a = 0.5f;
    test::add_object(scene, test::make_quad(Vec3(-0.5f, 1.5f, 1), Vec3(1, 0, 0), Vec3(0, 1, 0)), card);

    PunctualLight spot;
    spot.kind = LightKind::spot;
    spot.intensity = 8;
    scene.lights.push_back(spot);
    scene.light_instances.push_back({{0}, {0}, look_at(Vec3(1.5f, 3, 1.5f), Vec3(0), Vec3(0, 1, 0))});
    scene.environment = test::constant_environment(Vec3(0.2f, 0.3f, 0.4f));
    return test::build(std::move(scene));
}

TEST(PathReuse, GroupsAreWholeAndTouchNowhere) {
    std::map<uint32_t, std::set<std::pair<uint32_t, uint32_t>>> groups;
    for (uint32_t y = 0; y < reuse_tile; ++y) {
        for (uint32_t x = 0; x < reuse_tile; ++x)
            groups[reuse_group(x, y)].insert({x, y});
    }
    EXPECT_EQ(groups.size(), reuse_tile * reuse_tile / max_reuse_group);
    for (const auto& [group, pixels] : groups) {
        EXPECT_EQ(pixels.size(), max_reuse_group);
        for (const auto& [x, y] : pixels) {
            EXPECT_EQ(pixels.count({x + 1, y}), 0u);
            EXPECT_EQ(pixels.count({x, y + 1}), 0u);
            EXPECT_EQ(reuse_group(x + 5 * reuse_tile, y + 3 * reuse_tile), group);
        }
    }
}

TEST(PathReuse, GroupsOfACallHoldWhatBelongsTogether) {
    // Two indices of a tile, a part of another tile, one that does not share, and a pixel that is named too often.
    std::vector<PixelSample> samples;
    for (const auto& [index, x] :
         {std::pair(1u, 0), std::pair(2u, 0), std::pair(1u, 2), std::pair(1u, 16), std::pair(2u, 2), std::pair(1u, 18)})
        samples.push_back({static_cast<uint16_t>(x), 0, index, PathSharing::group});
    samples.push_back({4, 0, 1, PathSharing::none});
    samples.push_back({6, 0, 1, PathSharing::alone});
    samples.insert(samples.end(), 20, {33, 1, 1, PathSharing::group});
    ReuseGroups groups;
    groups.form(samples);
    std::multiset<std::vector<uint16_t>> found;
    for (size_t g = 0; g < groups.count; ++g) {
        ASSERT_LE(groups.group(g).size(), max_reuse_group);
        found.emplace(groups.group(g).begin(), groups.group(g).end());
    }
    for (const std::vector<uint16_t>& expected : {std::vector<uint16_t>{0, 2}, {1, 4}, {3, 5}, {7}})
        EXPECT_EQ(found.count(expected), 1u);
    EXPECT_EQ(found.size(), 4u + 3u);
}

TEST(PathReuse, BothDriversAgreeToTheBit) {
    const auto world = furnished_room();
    const View view = test::room_view(48);
    for (const Estimator estimator : {Estimator::mis, Estimator::light, Estimator::bsdf}) {
        IntegratorSettings settings;
        settings.estimator = estimator;
        RayCounts scalar_counts, batched_counts;
        uint64_t shared = 0;
        for (const PathSharing sharing : {PathSharing::group, PathSharing::alone}) {
            for (uint32_t top = 0; top < 48; top += reuse_tile) {
                const auto samples = test::tile_at(16, top, 3, sharing);
                std::vector<RadianceSample> scalar(samples.size()), batched(samples.size());
                trace_samples(*world, view, settings, samples, scalar, scalar_counts);
                ASSERT_TRUE(trace_batch(*world, view, settings, samples, batched, batched_counts));
                for (size_t i = 0; i < samples.size(); ++i) {
                    ASSERT_EQ(scalar[i].radiance, batched[i].radiance);
                    ASSERT_EQ(scalar[i].shadow_rays, batched[i].shadow_rays);
                    ASSERT_EQ(scalar[i].shared_luminance, batched[i].shared_luminance);
                    ASSERT_EQ(scalar[i].shared_with, batched[i].shared_with);
                    shared += scalar[i].shared_with;
                }
            }
        }
        EXPECT_GT(shared, 1000u);
        EXPECT_EQ(scalar_counts.shadow, batched_counts.shadow);
        EXPECT_EQ(scalar_counts.bounce, batched_counts.bounce);
    }
}

// A path that shares with nobody is the path that it would be without sharing, but for rounding.
TEST(PathReuse, APathAloneIsThePath) {
    const auto world = furnished_room();
    const View view = test::room_view(32);
    for (const Estimator estimator : {Estimator::mis, Estimator::light, Estimator::bsdf}) {
        IntegratorSettings settings;
        settings.estimator = estimator;
        RayCounts counts;
        size_t with_shared = 0;
        for (uint32_t index = 0; index < 4; ++index) {
            const auto alone = test::tile_at(8, 8, index, PathSharing::alone),
                       none = test::tile_at(8, 8, index, PathSharing::none);
            std::vector<RadianceSample> a(alone.size()), b(alone.size());
            ASSERT_TRUE(trace_batch(*world, view, settings, alone, a, counts));
            ASSERT_TRUE(trace_batch(*world, view, settings, none, b, counts));
            for (size_t i = 0; i < a.size(); ++i) {
                with_shared += a[i].shared_luminance > 0 ? 1 : 0;
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(a[i].radiance[c], b[i].radiance[c], 2e-3f * (1e-3f + std::abs(b[i].radiance[c])));
            }
        }
        EXPECT_GT(with_shared, 100u);
    }
}

struct Mean {
    std::vector<double> of_runs;
};

// Means of pieces of the picture, over pictures of different seeds.
std::vector<Mean> means_of(const World& world, const View& view, IntegratorSettings settings, PathSharing sharing,
                           const Vec2u& piece, uint32_t runs, uint32_t spp) {
    const Vec2u pieces = view.extent / piece;
    std::vector<Mean> out(size_t{pieces.x} * pieces.y);
    RayCounts counts;
    std::vector<RadianceSample> traced(size_t{reuse_tile} * reuse_tile);
    for (uint32_t run = 0; run < runs; ++run) {
        settings.seed = run;
        std::vector<double> sums(out.size());
        for (uint32_t index = 0; index < spp; ++index) {
            for (uint32_t top = 0; top < view.extent.y; top += reuse_tile) {
                for (uint32_t left = 0; left < view.extent.x; left += reuse_tile) {
                    const auto samples = test::tile_at(left, top, index, sharing);
                    trace_batch(world, view, settings, samples, traced, counts);
                    for (size_t i = 0; i < samples.size(); ++i)
                        sums[size_t{samples[i].y} / piece.y * pieces.x + samples[i].x / piece.x] +=
                            static_cast<double>(luminance(traced[i].radiance)) / (spp * piece.x * piece.y);
                }
            }
        }
        for (size_t p = 0; p < out.size(); ++p)
            out[p].of_runs.push_back(sums[p]);
    }
    return out;
}

double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values)
        sum += v / static_cast<double>(values.size());
    return sum;
}

double variance_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values)
        sum += (v - mean_of(values)) * (v - mean_of(values)) / static_cast<double>(values.size() - 1);
    return sum;
}

void expect_same_picture(const World& world, const View& view, const IntegratorSettings& settings, const Vec2u& piece,
                         uint32_t runs, double largest_error) {
    const auto alone = means_of(world, view, settings, PathSharing::none, piece, runs, 8);
    const auto shared = means_of(world, view, settings, PathSharing::group, piece, runs, 8);
    double difference = 0, variance = 0, whole = 0;
    for (size_t p = 0; p < alone.size(); ++p) {
        const double d = mean_of(shared[p].of_runs) - mean_of(alone[p].of_runs);
        const double v = (variance_of(shared[p].of_runs) + variance_of(alone[p].of_runs)) / runs;
        EXPECT_LE(std::abs(d), 5 * std::sqrt(v)) << "piece " << p << " of " << mean_of(alone[p].of_runs);
        difference += d;
        variance += v;
        whole += mean_of(alone[p].of_runs);
    }
    EXPECT_LE(std::abs(difference), 4 * std::sqrt(variance)) << difference / whole;
    EXPECT_LE(std::sqrt(variance), largest_error * whole) << "the test would see little";
}

TEST(PathReuse, SharedPathsShowTheSamePicture) {
    const auto world = furnished_room();
    for (const Estimator estimator : {Estimator::mis, Estimator::bsdf}) {
        IntegratorSettings settings;
        settings.estimator = estimator;
        settings.max_depth = 6;
        expect_same_picture(*world, test::room_view(32), settings, Vec2u(8), 32, 4e-3);
    }
}

// A square metre of a floor, seen from close above it, that a lit ceiling shines on. What lies just over the eye covers
// it up to the middle of a group of pixels, whose mean hides what each of them gets: so the pieces are half as wide.
View view_from_close() {
    View view;
    view.camera.world_from_camera = look_at(Vec3(0, 0.04f, 0), Vec3(0), Vec3(0, 0, -1));
    view.camera.projection = Projection::orthographic;
    view.camera.ortho_half_height_m = 0.5f;
    view.extent = Vec2u(32);
    return view;
}
constexpr float covered_from = -0.375f, covered_to = -0.125f;  // pixels 4 to 12

Scene floor_and_ceiling(const Vec3& ceiling) {
    Scene scene;
    test::add_object(scene, test::make_quad(Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4)),
                     test::add_lambert(scene, Vec3(0.8f)));
    test::add_object(scene, test::make_quad(Vec3(-2, 2, -2), Vec3(4, 0, 0), Vec3(0, 0, 4)),
                     test::add_lambert(scene, ceiling));
    PunctualLight lamp;
    lamp.intensity = 3;
    scene.lights.push_back(lamp);
    scene.light_instances.push_back({{0}, {0}, glm::translate(Mat4(1), Vec3(0, 1, 0))});
    return scene;
}

Primitive cover() {
    return test::make_quad(Vec3(covered_from, 0.05f, 1), Vec3(covered_to - covered_from, 0, 0), Vec3(0, 0, -2));
}

TEST(PathReuse, WhatIsPassedByChanceCountsForAllWhoMayPassIt) {
    Scene scene = floor_and_ceiling(Vec3(0.8f));
    const MaterialId screen = test::add_lambert(scene, Vec3(0));
    scene.materials[screen.value].alpha_mode = AlphaMode::blend;
    scene.materials[screen.value].base_color_factor.a = 0.8f;
    test::add_object(scene, cover(), screen);
    IntegratorSettings settings;
    settings.max_depth = 2;
    expect_same_picture(*test::build(std::move(scene)), view_from_close(), settings, Vec2u(4, 32), 32, 4e-3);
}

TEST(PathReuse, PanesAreInTheWayOfThoseWhoShare) {
    Scene scene = floor_and_ceiling(Vec3(0.8f));
    Material pane;
    pane.metallic_factor = 0;
    pane.roughness_factor = 0;
    pane.transmission.factor = 1;
    scene.materials.push_back(pane);
    test::add_object(scene, cover(), MaterialId{static_cast<uint32_t>(scene.materials.size() - 1)});
    IntegratorSettings settings;
    settings.max_depth = 2;
    expect_same_picture(*test::build(std::move(scene)), view_from_close(), settings, Vec2u(4, 32), 32, 4e-3);
}

// A wall whose interpolated normals lean far: seen from where they have to be bent, they are others. The nearer to its
// foot, the steeper it is seen; each row of pixels is a piece.
TEST(PathReuse, NormalsThatBendAreSharedByNobody) {
    Scene scene = floor_and_ceiling(Vec3(0));
    const MaterialId white = test::add_lambert(scene, Vec3(0.9f));
    Primitive wall = test::make_quad(Vec3(-1, 0, -0.5f), Vec3(2, 0, 0), Vec3(0, 0.6f, 0));
    wall.flat_normals = false;
    wall.normals.assign(4, glm::normalize(Vec3(0, 1.5f, 1)));
    test::add_object(scene, std::move(wall), white);
    IntegratorSettings settings;
    settings.max_depth = 2;
    expect_same_picture(*test::build(std::move(scene)), view_from_close(), settings, Vec2u(32, 1), 64, 4e-3);
}

}  // namespace
}  // namespace candela
