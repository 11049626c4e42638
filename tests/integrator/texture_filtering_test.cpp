// SPDX-License-Identifier: MIT
// Filtered textures against the same pictures with every lookup at level 0: less noise, and no blur that stays.
#include <tbb/parallel_for.h>

#include "renderer/image/compare.h"
#include "renderer/math/hash.h"
#include "renderer/scene/color_mips.h"
#include "tests/support/measure.h"
#include "tests/support/scenes.h"

namespace candela {
namespace {

// A primitive that shows a texture of blocks, black and white or of all colours, unlit: all noise is the texture's.
std::shared_ptr<const World> textured_world(Primitive primitive, Vec2i size, int block, bool is_checkerboard) {
    ImageRgba8 image(size.x, size.y);
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const int column = x / block, row = y / block;
            const uint32_t hash = is_checkerboard
                                      ? ((column + row) % 2 == 0 ? 0xe6e6e6u : 0x141414u)
                                      : hash_combine(static_cast<uint32_t>(column), static_cast<uint32_t>(row));
            image(x, y) = Rgba8(hash & 255u, hash >> 8 & 255u, hash >> 16 & 255u, 255);
        }
    }
    Scene scene;
    scene.images.emplace_back().pixels = std::make_shared<const ImageRgba8>(std::move(image));
    scene.textures.emplace_back().image = {0};
    const MaterialId material = test::add_lambert(scene, Vec3(1));
    scene.materials[material.value].base_color.texture = {0};
    scene.materials[material.value].unlit = true;
    test::add_object(scene, std::move(primitive), material);
    scene.environment = test::constant_environment(Vec3(1));
    make_color_mips(scene);
    return test::build(std::move(scene));
}

struct Case {
    const char* name;
    std::shared_ptr<const World> world;
    View view;
    double least_gain_at_1_spp, least_gain_at_16_spp;
};

std::vector<Case> cases() {
    Primitive plane = test::make_quad(Vec3(-200, 0, 200), Vec3(400, 0, 0), Vec3(0, 0, -400));
    for (Vec2& uv : plane.uv[0])
        uv *= 400.0f;
    View horizon, front;
    horizon.camera.world_from_camera = look_at(Vec3(0.3f, 1.5f, 0), Vec3(0.9f, 0.8f, -5), Vec3(0, 1, 0));
    front.camera.world_from_camera = look_at(Vec3(0, 0.5f, 3), Vec3(0), Vec3(0, 1, 0));
    horizon.extent = front.extent = Vec2u(24, 18);
    return {
        {"plane", textured_world(std::move(plane), Vec2i(128), 32, true), horizon, 2.0, 2.0},
        {"sphere", textured_world(test::make_sphere(Vec3(0), 1, 64, 32), Vec2i(512, 256), 2, false), front, 4.0, 1.8}};
}

ImageRgba32f render(const Case& scene, bool filtered, uint32_t spp, uint32_t seed) {
    IntegratorSettings settings;
    settings.filter_textures = filtered;
    settings.seed = seed;
    const Vec2i extent(scene.view.extent);
    ImageRgba32f out(extent.x, extent.y);
    tbb::parallel_for(0, extent.y, [&](int y) {
        std::vector<PixelSample> samples(spp);
        std::vector<RadianceSample> radiance(max_batch);
        RayCounts counts;
        for (int x = 0; x < extent.x; ++x) {
            for (uint32_t i = 0; i < spp; ++i)
                samples[i] = {static_cast<uint16_t>(x), static_cast<uint16_t>(y), i};
            glm::dvec3 sum(0);
            for (uint32_t first = 0; first < spp; first += max_batch) {
                const size_t count = std::min<size_t>(spp - first, max_batch);
                trace_batch(*scene.world, scene.view, settings, std::span(samples).subspan(first, count), radiance,
                            counts);
                for (size_t i = 0; i < count; ++i)
                    sum += glm::dvec3(radiance[i].radiance);
            }
            out(x, y) = Vec4(Vec3(sum / static_cast<double>(spp)), 1);
        }
    });
    return out;
}

double squared(double x) {
    return x * x;
}

double relative_mse(const ImageRgba32f& image, const ImageRgba32f& reference) {
    return compare_images(image, reference).rel_mse;
}

TEST(TextureFiltering, FewSamplesAliasLess) {
    for (const Case& scene : cases()) {
        const ImageRgba32f reference = render(scene, false, 4096, 99);
        for (const auto& [spp, least_gain] : {std::pair{1u, scene.least_gain_at_1_spp},
                                              std::pair{16u, scene.least_gain_at_16_spp}, std::pair{256u, 0.95}}) {
            double filtered = 0, level_0 = 0;
            for (uint32_t seed = 0; seed < 4; ++seed) {
                filtered += relative_mse(render(scene, true, spp, seed), reference);
                level_0 += relative_mse(render(scene, false, spp, seed), reference);
            }
            EXPECT_GT(level_0, least_gain * filtered) << scene.name << ", " << spp << " samples";
        }
    }
}

struct Bias {
    double squared_sum = 0;        // over pixels, estimated without bias from the means of independent renders
    double squared_noise_sum = 0;  // of one render
};

Bias measure_bias(const Case& scene, uint32_t renders, uint32_t spp) {
    std::vector<ImageRgba32f> pictures[2];
    test::BatchMeans brightness[2];
    for (const bool filtered : {false, true}) {
        for (uint32_t seed = 0; seed < renders; ++seed) {
            pictures[filtered].push_back(render(scene, filtered, spp, seed + (filtered ? 100 : 0)));
            double sum = 0;
            for (const Vec4& p : pictures[filtered].back().pixels())
                sum += static_cast<double>(p.g);
            brightness[filtered].add(sum);
        }
    }
    EXPECT_NEAR(brightness[1].mean(), brightness[0].mean(),
                4 * std::hypot(brightness[0].standard_error(), brightness[1].standard_error()))
        << scene.name << ": the picture as a whole is neither brighter nor darker";
    Bias out;
    for (size_t i = 0; i < pictures[0][0].size(); ++i) {
        test::BatchMeans value[2];
        for (const bool filtered : {false, true}) {
            for (const ImageRgba32f& picture : pictures[filtered])
                value[filtered].add(static_cast<double>(picture.pixels()[i].g));
        }
        const double noise = squared(value[1].standard_error());
        out.squared_sum += squared(value[1].mean() - value[0].mean()) - noise - squared(value[0].standard_error());
        out.squared_noise_sum += renders * noise;
    }
    return out;
}

// The blur of a picture falls as 1 / n, so it is soon far below the noise, which falls slower.
TEST(TextureFiltering, ManySamplesShowTheTextureItself) {
    for (const Case& scene : cases()) {
        const Bias bias = measure_bias(scene, 8, 1024);
        EXPECT_LT(bias.squared_sum, 0.03 * bias.squared_noise_sum) << scene.name;
    }
}

}  // namespace
}  // namespace candela
