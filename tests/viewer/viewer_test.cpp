// SPDX-License-Identifier: MIT
// The whole viewer off-screen: events in, pictures out.
#include "app/viewer/validation_readings.h"

#include <fstream>

#include "tests/viewer/viewer_fixture.h"

namespace candela {
namespace {

using test::difference;
using test::extent;
using test::options_for;
using test::ViewerTest;

TEST_F(ViewerTest, OpensRendersAndIsIdle) {
    start(options_for("assets/cornell_box.glb"));
    ASSERT_TRUE(model().has_scene());
    EXPECT_EQ(model().status.spp, 4u);
    EXPECT_EQ(viewer_->title(), "candela - cornell_box.glb");
    EXPECT_GT(viewer_->seconds_until_update(), 0.1) << "idle, but not at rest";
    EXPECT_FALSE(viewer_->update());
}

TEST_F(ViewerTest, AnOrbitedViewReturnsToTheSamePictureToTheBit) {
    start(options_for("assets/cornell_box.glb"));
    const OrbitView view = model().view;
    const ImageRgba8 before = picture();
    drag(MouseButton::left, {100, 60}, {140, 60});
    finish();
    EXPECT_GT(difference(before, picture()), 2.0);
    press(Key::c);
    finish();
    now_s_ += 10;
    EXPECT_EQ(view.camera, model().view.camera);
    EXPECT_EQ(difference(before, picture()), 0.0);
}

TEST_F(ViewerTest, TheWheelComesNearerToTheCursorAndBack) {
    start(options_for("assets/cornell_box.glb"));
    const Vec3 eye = model().view.camera.position();
    viewer_->handle(MouseMoved{{60, 80}});
    for (int i = 0; i < 3; ++i)
        viewer_->handle(Scrolled{{0, 1}});
    EXPECT_GT(glm::distance(eye, model().view.camera.position()), 0.05f);
    for (int i = 0; i < 3; ++i)
        viewer_->handle(Scrolled{{0, -1}});
    EXPECT_LT(glm::distance(eye, model().view.camera.position()), 1e-3f);
}

TEST_F(ViewerTest, ADoubleClickRecentresAndASlowOneDoesNot) {
    start(options_for("assets/cornell_box.glb"));
    const OrbitView view = model().view;
    click({60, 90});
    now_s_ += 2;
    click({60, 90});
    EXPECT_EQ(model().view, view);
    now_s_ += 2;
    click({60, 90});
    now_s_ += 0.1;
    click({60, 90});
    EXPECT_NE(model().view, view);
    const Vec3 seen = project(model().view.camera, 200.0f / 150, model().view.pivot);
    EXPECT_NEAR(seen.x, 0.5f, 1e-3f);
    EXPECT_NEAR(seen.y, 0.5f, 1e-3f);
}

TEST_F(ViewerTest, AClickWhereAStrokeBeganIsNoDoubleClick) {
    start(options_for("assets/cornell_box.glb"));
    drag(MouseButton::left, {60, 90}, {80, 90});
    const OrbitView view = model().view;
    click({60, 90});
    EXPECT_EQ(model().view, view);
    click({60, 90});
    EXPECT_NE(model().view, view);
}

TEST_F(ViewerTest, ExposureAndToneCurveRedrawWithoutARestart) {
    start(options_for("assets/cornell_box.glb"));
    const uint64_t epoch = model().status.epoch;
    const ImageRgba8 before = picture();
    press(Key::e);
    EXPECT_GT(difference(before, picture()), 1.0);
    press(Key::e, {.shift = true});
    EXPECT_EQ(difference(before, picture()), 0.0);
    press(Key::t);
    EXPECT_GT(difference(before, picture()), 1.0);
    finish();
    EXPECT_EQ(model().status.epoch, epoch);
}

TEST_F(ViewerTest, ASceneThatFailsShowsWhyAndTheOldOneStays) {
    const std::filesystem::path broken = std::filesystem::temp_directory_path() / "candela viewer broken.gltf";
    std::ofstream(broken) << "{ this is no JSON";
    start(options_for("assets/cornell_box.glb"));
    const ImageRgba8 before = picture();
    viewer_->handle(FilesDropped{{broken.string()}, {}});
    finish();
    std::filesystem::remove(broken);
    EXPECT_TRUE(model().has_scene());
    EXPECT_EQ(viewer_->title(), "candela - cornell_box.glb");
    EXPECT_TRUE(model().notice_is_error);
    EXPECT_NE(model().notice.find("broken.gltf"), std::string::npos) << model().notice;
    EXPECT_EQ(viewer_->load_status(), ExitStatus::unreadable_scene);
    EXPECT_GT(difference(before, picture()), 0.5) << "the notice is not seen";
    press(Key::escape);
    EXPECT_EQ(difference(before, picture()), 0.0);
}

TEST_F(ViewerTest, ADroppedSceneReplacesTheOld) {
    start(options_for("assets/cornell_box.glb"));
    const ImageRgba8 before = picture();
    viewer_->handle(FilesDropped{{"assets/veach_plates.glb"}, {}});
    EXPECT_TRUE(model().loading);
    finish();
    EXPECT_EQ(viewer_->title(), "candela - veach_plates.glb");
    EXPECT_GT(difference(before, picture()), 5.0);
}

TEST_F(ViewerTest, TheNewestOfSeveralDroppedScenesWins) {
    start(options_for("assets/cornell_box.glb"));
    for (const char* scene : {"assets/veach_plates.glb", "assets/many_lights.glb", "assets/glass_slab.glb"})
        viewer_->handle(FilesDropped{{scene}, {}});
    finish();
    EXPECT_EQ(viewer_->title(), "candela - glass_slab.glb");
}

// A cube with two variants, and two scenes of which the second has none.
std::filesystem::path write_variants() {
    const std::vector<float> positions = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "candela viewer variants";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "data.bin", std::ios::binary)
        .write(reinterpret_cast<const char*>(positions.data()), static_cast<std::streamsize>(positions.size() * 4));
    std::ofstream(folder / "variants.gltf") << R"({
        "asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_variants"],
        "extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "blue"}]}},
        "buffers": [{"uri": "data.bin", "byteLength": 36}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.8, 0.8, 1], "metallicFactor": 0}},
                      {"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0, 0, 1], "metallicFactor": 0}},
                      {"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0.8, 1], "metallicFactor": 0}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0,
            "extensions": {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [0]},
                                                                   {"material": 2, "variants": [1]}]}}}]}],
        "nodes": [{"mesh": 0}, {"mesh": 0, "scale": [1, 0.3, 1]}],
        "scenes": [{"name": "whole", "nodes": [0]}, {"name": "flat", "nodes": [1]}], "scene": 0})";
    return folder / "variants.gltf";
}

TEST_F(ViewerTest, VariantsAndScenesAreChosenInThePanel) {
    start(options_for(write_variants().string()));
    const ImageRgba8 own = picture();
    const OrbitView view = model().view;
    PanelEdits edits;
    edits.variant = std::optional<uint32_t>(1);
    viewer_->apply(edits);
    finish();
    const Rgba8 blue = picture()(100, 75);
    EXPECT_GT(blue.b, blue.r + 50);
    EXPECT_EQ(model().options.variant, "blue");
    EXPECT_EQ(model().job.world->accel->work().trees_built, 0u) << "the geometry stays";
    EXPECT_GT(model().job.world->accel->work().trees_shared, 0u);
    EXPECT_EQ(model().view, view) << "the person's view stays";
    edits.variant = std::optional<uint32_t>();
    viewer_->apply(edits);
    finish();
    now_s_ += 10;
    EXPECT_EQ(difference(own, picture()), 0.0) << "back to the file's own materials, to the bit";

    // A variant given on the command line stays when the scene changes.
    edits.variant = std::optional<uint32_t>(0);
    viewer_->apply(edits);
    finish();
    PanelEdits other;
    other.scene = 1;
    viewer_->apply(other);
    finish();
    EXPECT_EQ(model().job.world->scene->active_scene, 1u);
    EXPECT_EQ(model().job.world->scene->active_variant, std::optional<uint32_t>(0));
    const Rgba8 red = picture()(100, 75);
    EXPECT_GT(red.r, red.b + 50);
    std::filesystem::remove_all(write_variants().parent_path());
}

TEST_F(ViewerTest, ADroppedEnvironmentLightsTheScene) {
    start(options_for("assets/validation/furnace_sphere.glb"));
    viewer_->handle(FilesDropped{{"assets/sky.hdr"}, {}});
    finish();
    ASSERT_NE(model().job.environment, nullptr);
    EXPECT_GT(model().job.environment->radiance.width(), 1);
    EXPECT_TRUE(model().job.world->lights.environment);
    const ImageRgba8 before = picture();
    drag(MouseButton::right, {50, 50}, {120, 50}, {.shift = true});
    finish();
    EXPECT_NE(model().options.hdri_rotation_degrees, 0);
    EXPECT_GT(difference(before, picture()), 1.0) << "a turned environment looks the same";
}

TEST_F(ViewerTest, WhatIsNoSceneIsRefusedByName) {
    start(options_for("assets/cornell_box.glb"));
    viewer_->handle(FilesDropped{{"README.md"}, {}});
    EXPECT_TRUE(model().notice_is_error);
    EXPECT_FALSE(model().loading);
}

TEST_F(ViewerTest, AResizedWindowGetsAPictureOfItsSize) {
    start(options_for("assets/cornell_box.glb"));
    context_->resize({120, 90});
    viewer_->handle(WindowResized{{120, 90}, {120, 90}, 1});
    finish();
    EXPECT_EQ(model().frame_extent, Vec2u(120, 90));
    EXPECT_EQ(model().status.spp, 4u);
}

TEST_F(ViewerTest, ATinyAndAMinimisedWindowAreSurvived) {
    start(options_for("assets/cornell_box.glb"));
    press(Key::tab);
    press(Key::z);
    press(Key::h);
    context_->resize({8, 8});
    viewer_->handle(WindowResized{{8, 8}, {8, 8}, 1});
    finish();
    viewer_->handle(WindowResized{{0, 0}, {0, 0}, 1});
    for (int i = 0; i < 5; ++i)
        viewer_->update();
    viewer_->handle(WindowResized{{8, 8}, {8, 8}, 1});
    finish();
    EXPECT_EQ(model().frame_extent, Vec2u(8, 8));
}

TEST_F(ViewerTest, HighResolutionScreensGetSharperPanelsOfTheSameSize) {
    start(options_for("assets/cornell_box.glb"));
    context_->resize({400, 300});
    viewer_->handle(WindowResized{{200, 150}, {400, 300}, 2});
    finish();
    EXPECT_EQ(model().frame_extent, Vec2u(400, 300));
    // The status line is 27 points high: 54 pixels.
    const ImageRgba8 drawn = picture();
    EXPECT_EQ(drawn(398, 298), drawn(398, 250));
    EXPECT_NE(drawn(398, 298), drawn(398, 240));
}

TEST_F(ViewerTest, PanelsHelpAndStatisticsCanBeShownAndHidden) {
    start(options_for("assets/cornell_box.glb"));
    const ImageRgba8 before = picture();
    for (const Key key : {Key::h, Key::z, Key::tab}) {
        press(key);
        for (int i = 0; i < 3; ++i)
            picture();
        EXPECT_GT(difference(before, picture()), 2.0);
        press(key);
        for (int i = 0; i < 3; ++i)
            picture();
        EXPECT_EQ(difference(before, picture()), 0.0);
    }
}

TEST_F(ViewerTest, DraggingOnAPanelDoesNotTurnTheScene) {
    start(options_for("assets/cornell_box.glb"));
    press(Key::tab);
    for (int i = 0; i < 3; ++i)
        picture();
    const OrbitView view = model().view;
    drag(MouseButton::left, {150, 40}, {150, 80});
    EXPECT_EQ(model().view, view);
}

// A picture of stride 8 is followed by finer ones long before every pixel has two samples.
TEST_F(ViewerTest, EveryRefinementOfAYoungPictureIsShown) {
    context_ = std::make_unique<OsmesaContext>(Vec2u(1280, 960));
    viewer_ =
        std::make_unique<Viewer>(options_for("assets/cornell_box.glb", 1 << 20), *context_, ViewerOptions{false, {}});
    int shown = 0;
    uint64_t last = 0;
    const auto begin = std::chrono::steady_clock::now();
    while (model().status.spp < 2 && std::chrono::steady_clock::now() - begin < std::chrono::seconds(60)) {
        viewer_->update();
        if (model().frame_serial == last) continue;
        last = model().frame_serial;
        ++shown;
    }
    EXPECT_GE(shown, 5);
}

TEST_F(ViewerTest, PauseHoldsAndGoesOn) {
    RenderOptions options = options_for("assets/cornell_box.glb", 1 << 20);
    context_ = std::make_unique<OsmesaContext>(extent);
    viewer_ = std::make_unique<Viewer>(options, *context_, ViewerOptions{true, [this] { return now_s_; }});
    const auto spin_until = [&](const auto& condition) {
        for (int i = 0; i < 20000 && !condition(); ++i) {
            viewer_->update();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return condition();
    };
    ASSERT_TRUE(spin_until([&] { return model().status.spp >= 2; }));
    press(Key::p);
    ASSERT_TRUE(spin_until([&] { return model().status.paused; }));
    const uint32_t spp = model().status.spp;
    for (int i = 0; i < 20; ++i) {
        viewer_->update();
        viewer_->draw();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_LE(model().status.spp, spp + 1);
    EXPECT_GT(viewer_->seconds_until_update(), 0.1);
    press(Key::p);
    EXPECT_TRUE(spin_until([&] { return model().status.spp > spp + 2; }));
}

TEST_F(ViewerTest, SavingWritesBothFilesAndNeverOverwrites) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "candela viewer save";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    const std::filesystem::path home = std::filesystem::current_path();
    start(options_for((home / "assets/cornell_box.glb").string()));
    std::filesystem::current_path(folder);
    press(Key::s, {.ctrl = true});
    press(Key::f12);
    std::filesystem::current_path(home);
    for (const char* name :
         {"candela-cornell_box-001.png", "candela-cornell_box-001.exr", "candela-cornell_box-002.png"})
        EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
    std::filesystem::remove_all(folder);
}

TEST_F(ViewerTest, CtrlQAndTheCloseButtonQuit) {
    start(options_for("assets/cornell_box.glb"));
    EXPECT_FALSE(viewer_->wants_to_close());
    press(Key::q);
    EXPECT_FALSE(viewer_->wants_to_close());
    press(Key::q, {.ctrl = true});
    EXPECT_TRUE(viewer_->wants_to_close());
}

TEST_F(ViewerTest, ClosingWhileASceneLoadsJoinsEverything) {
    start(options_for("assets/cornell_box.glb"));
    viewer_->handle(FilesDropped{{"assets/many_lights.glb"}, {}});
    viewer_.reset();
}

TEST_F(ViewerTest, TheOffScreenPictureIsThatOfTheHeadlessRenderer) {
    RenderOptions options = options_for("assets/cornell_box.glb", 8);
    context_ = std::make_unique<OsmesaContext>(extent);
    viewer_ = std::make_unique<Viewer>(options, *context_, ViewerOptions{false, {}});
    drag(MouseButton::left, {10, 10}, {50, 30});
    finish();
    const ImageRgba8 shown = picture();

    options.resolution = extent;
    const RenderJob job = prepare_render(
        options, [](const char*, double) {}, nullptr);
    SessionOptions session_options;
    session_options.threads = 1;
    session_options.publish_frames = false;
    RenderSession session(session_options);
    session.submit(job.request);
    session.wait_until_done();
    const ImageRgba8 expected = tone_map(session.latest()->image, {});
    for (size_t i = 0; i < shown.size(); ++i) {
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(shown.pixels()[i][c], expected.pixels()[i][c], 1) << i;
    }
}

TEST_F(ViewerTest, ValidationScenesShowTheExactValueBesideThePicture) {
    start(options_for("assets/cornell_box.glb", 24));
    const auto readings = [&] {
        return read_validation(model().job.scene_path, *model().job.world, model().job.request.view, viewer_->frame());
    };
    EXPECT_TRUE(readings().empty()) << "the Cornell box has no exact answer";

    // Inside of an integrating sphere every pixel shows the same exact value.
    const std::vector<ValidationScene>& scenes = validation_scenes();
    const auto open = [&](const char* name) {
        for (size_t i = 0; i < scenes.size(); ++i) {
            if (scenes[i].name == name) viewer_->open_validation_scene(i);
        }
        finish();
    };
    open("integrating_sphere.glb");
    ASSERT_EQ(viewer_->load_error(), "");
    ASSERT_EQ(readings().size(), 1u);
    ASSERT_TRUE(readings()[0].visible && readings()[0].shown);
    // 25 pixels of 24 samples that each scatter by about 40 %: 4 standard errors.
    EXPECT_NEAR(*readings()[0].shown / readings()[0].of->exact, 1, 0.06);

    // A furnace needs its sky, and the next scene must not keep it.
    open("furnace_sphere.glb");
    ASSERT_TRUE(readings().at(0).shown);
    EXPECT_NEAR(*readings()[0].shown, 1, 0.06);
    open("point_light_plane.glb");
    ASSERT_EQ(readings().size(), 5u);
    ASSERT_TRUE(readings()[0].shown) << "the foot of the light is in the middle of the picture";
    EXPECT_NEAR(*readings()[0].shown / readings()[0].of->exact, 1, 0.05);

    // Points that leave the picture say so.
    const Vec2 middle = Vec2(extent) / 2.0f;
    drag(MouseButton::middle, middle, middle + Vec2(0, 5000));
    finish();
    EXPECT_FALSE(readings()[0].visible);
    EXPECT_FALSE(readings()[0].shown);
}

}  // namespace
}  // namespace candela
