// SPDX-License-Identifier: MIT
// Opening a scene step by step or with everything at once gives the same picture to the bit, and what is shown before
// the pictures are decoded is sound.
#include "app/exit_status.h"
#include "app/pose_choice.h"
#include "app/render_job.h"
#include "renderer/io/load_gltf.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

std::vector<Vec3> picture(const World& world, View view, uint64_t* not_finite = nullptr) {
    view.extent = Vec2u(32, 24);
    std::vector<Vec3> out;
    RayCounts counts;
    for (uint16_t y = 0; y < view.extent.y; ++y) {
        for (uint16_t x = 0; x < view.extent.x; ++x) {
            for (uint32_t i = 0; i < 2; ++i) {
                out.push_back(trace_sample(world, view, {}, {x, y, i}, counts).radiance);
                if (not_finite != nullptr && !is_finite(out.back())) ++*not_finite;
            }
        }
    }
    return out;
}

// Nothing beside anything else: first all of the file, then the world.
std::shared_ptr<const World> step_by_step(const RenderOptions& options) {
    Diagnostics diagnostics;
    std::vector<std::string> warnings;
    const auto rest = std::make_shared<const Scene>(load_gltf(options.scene, diagnostics));
    BuildOptions build;
    if (options.sky) {
        build.environment.emplace();
        build.environment->radiance = ImageRgb32f(1, 1, *options.sky);
    }
    return build_world(scene_at(rest, choose_animation(options, *rest), options.at_seconds.value_or(0), warnings),
                       build);
}

TEST(Opening, BesideOneAnotherIsTheSameToTheBit) {
    struct Case {
        const char* file;
        std::optional<double> at_seconds;
        bool sky;
        bool has_pictures;
    };
    // Normal maps and blends; lamps of pictures; nothing but pictures that shine; masks and blends; skins; textures
    // moved by an animation; one without pictures.
    for (const Case& each :
         {Case{"FlightHelmet/FlightHelmet.gltf", {}, true, true},
          Case{"EmissiveStrengthTest/glTF/EmissiveStrengthTest.gltf", {}, false, true},
          Case{"TransmissionTest/glTF/TransmissionTest.gltf", {}, false, true},
          Case{"AlphaBlendModeTest/glTF/AlphaBlendModeTest.gltf", {}, true, true},
          Case{"CesiumMan/glTF-Binary/CesiumMan.glb", 0.6, true, true}, Case{"Fox/glTF/Fox.gltf", 1.0, true, true},
          Case{"BoxAnimated/glTF-Binary/BoxAnimated.glb", 0.5, true, false}}) {
        SCOPED_TRACE(each.file);
        RenderOptions options;
        options.scene = (test::shared_data() / "models" / each.file).string();
        if (!std::filesystem::exists(options.scene)) {
            GTEST_SKIP() << "skipped: no shared data";
        }
        options.at_seconds = each.at_seconds;
        if (each.sky) options.sky = Vec3(1);
        int previews = 0;
        std::vector<Vec3> early;
        const RenderJob job = prepare_render(
            options, [](const char*, double) {}, nullptr,
            [&](const RenderJob& preview) {
                ++previews;
                uint64_t not_finite = 0;
                early = picture(*preview.world, preview.request.view, &not_finite);
                EXPECT_EQ(not_finite, 0u);
                float brightest = 0;
                for (const Vec3& radiance : early)
                    brightest = std::max(brightest, max_component(radiance));
                EXPECT_GT(brightest, 0.0f) << "the preview is black";
                EXPECT_EQ(preview.request.world, preview.world);
            });
        EXPECT_EQ(previews, each.has_pictures ? 1 : 0);
        const std::vector<Vec3> together = picture(*job.world, job.request.view);
        EXPECT_EQ(together, picture(*step_by_step(options), job.request.view));
        EXPECT_NE(together, early);
        EXPECT_EQ(job.world->accel->work().trees_built == 0, each.has_pictures) << "built for the preview already";
    }
}

TEST(Opening, IsCancelledWhilePicturesDecode) {
    RenderOptions options;
    options.scene = (test::shared_data() / "models/FlightHelmet/FlightHelmet.gltf").string();
    if (!std::filesystem::exists(options.scene)) GTEST_SKIP() << "skipped: no shared data";
    std::atomic<bool> cancel{false};
    EXPECT_THROW(prepare_render(
                     options, [](const char*, double) {}, &cancel, [&](const RenderJob&) { cancel = true; }),
                 CommandError);
}

}  // namespace
}  // namespace candela
