// SPDX-License-Identifier: MIT
// A pixel under the glass, and edits of the scene with their undoing.
#include <fstream>

#include "app/viewer/environment_files.h"
#include "app/viewer/panels.h"
#include "renderer/integrator/ledger.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/viewer_fixture.h"

namespace candela {
namespace {

using test::difference;
using test::extent;
using test::options_for;
using test::ViewerTest;

constexpr Modifiers ctrl{.ctrl = true}, ctrl_shift{.shift = true, .ctrl = true};

TEST_F(ViewerTest, AClickShowsThePixelAndReplaysItsBrightestSample) {
    start(options_for("assets/cornell_box.glb", 8));
    const OrbitView view = model().view;
    const ImageRgba8 plain = picture();
    click({100, 20});
    finish();
    ASSERT_TRUE(model().inspection.has_value());
    const Inspection& inspection = *model().inspection;
    EXPECT_EQ(inspection.pixel, Vec2u(100, 20));
    EXPECT_EQ(inspection.value, viewer_->frame()->image(100, 20));
    EXPECT_GT(inspection.error, 0);
    EXPECT_EQ(inspection.samples, 8);
    EXPECT_TRUE(inspection.hit.hit);
    EXPECT_EQ(model().edited_material, inspection.hit.material);
    ASSERT_TRUE(inspection.ledger.has_value());
    EXPECT_EQ(inspection.ledger->samples, 8u);
    RayCounts counts;
    const RenderRequest& request = model().job.request;
    EXPECT_EQ(
        inspection.ledger->path.radiance,
        trace_sample(*request.world, request.view, request.settings, inspection.ledger->path.sample, counts).radiance);
    EXPECT_EQ(model().view, view);
    EXPECT_GT(difference(plain, picture()), 2);

    press(Key::escape);
    EXPECT_FALSE(model().inspection.has_value());
    EXPECT_EQ(difference(plain, picture()), 0);
    // A drag is no click, and another view puts the glass away.
    drag(MouseButton::left, {60, 20}, {80, 20});
    EXPECT_FALSE(model().inspection.has_value());
    finish();
    click({100, 20});
    finish();
    EXPECT_TRUE(model().inspection.has_value());
    press(Key::digit_7);
    finish();
    EXPECT_FALSE(model().inspection.has_value());
}

TEST(PixelPanel, ItHidesNeitherThePixelNorOtherPanels) {
    const PanelArea room{{10, 10}, {910, 610}}, statistics{{10, 10}, {500, 300}};
    const Vec2 size(300, 200);
    const auto corner = [&](Vec2 pixel, const PanelArea& taken) {
        return free_corner(room, size, {pixel - 15.0f, pixel + 15.0f}, {taken}).pivot;
    };
    EXPECT_EQ(corner({100, 100}, {}), Vec2(1, 1));
    EXPECT_EQ(free_height(room, 300, {{485, 385}, {515, 415}}), 600) << "there is room beside the pixel";
    EXPECT_EQ(free_height(room, 500, {{485, 385}, {515, 415}}), 375) << "above it";
    EXPECT_EQ(free_height(room, 500, {{485, 85}, {515, 115}}), 495) << "below it";
    EXPECT_EQ(corner({700, 500}, {}), Vec2(1, 0));
    EXPECT_EQ(corner({600, 400}, {}), Vec2(1, 0)) << "its edge would touch the pixel";
    EXPECT_EQ(corner({500, 400}, {{600, 10}, {910, 610}}), Vec2(0, 1));
    EXPECT_EQ(corner({700, 500}, {{600, 10}, {910, 610}}), Vec2(0, 1));
    EXPECT_EQ(corner({200, 500}, {{600, 10}, {910, 610}}), Vec2(0, 0));
    const FreeCorner large = free_corner(room, {800, 400}, {{800, 500}, {830, 530}}, {statistics});
    EXPECT_TRUE(large.hides);
    EXPECT_EQ(large.pivot, Vec2(1, 0)) << "rather the statistics are hidden than the pixel";
    const FreeCorner small = free_corner(room, size, {{100, 500}, {130, 530}}, {statistics, {{600, 300}, {910, 610}}});
    EXPECT_FALSE(small.hides);
    EXPECT_EQ(small.pivot, Vec2(1, 0)) << "all other corners are taken";
}

TEST(Notices, TheyStandBesideStatisticsAndPanelsOrUnderThem) {
    const PanelArea statistics{{15, 15}, {503, 494}};
    for (const Vec2 window : {Vec2(1280, 720), Vec2(800, 600), Vec2(2560, 1440), Vec2(320, 640)}) {
        for (const float side_panel : {0.0f, std::min(300.0f, window.x - 30)}) {
            const PanelArea room = notice_room(window, 15, statistics, side_panel);
            EXPECT_FALSE(room.overlaps(statistics)) << window.x;
            EXPECT_GE(room.high.x - room.low.x, 18 * 15) << window.x;
            const float taken = side_panel > 0 && window.x > 700 ? side_panel + 15 : 0;
            EXPECT_LE(room.high.x, window.x - 15 - taken);
        }
    }
    EXPECT_EQ(notice_room({1280, 720}, 15, {}, 0), (PanelArea{{15, 15}, {1265, 705}}));
}

TEST_F(ViewerTest, TabThatIsHeldTypesNothing) {
    start(options_for("assets/cornell_box.glb", 1));
    viewer_->handle(KeyPressed{Key::tab, true, {}});
    for (int i = 0; i < 6; ++i) {
        now_s_ += 0.3;
        picture();
    }
    viewer_->handle(KeyPressed{Key::tab, false, {}});
    picture();
    const float exposure_ev = model().display.tone.exposure_ev;
    press(Key::e);
    EXPECT_GT(model().display.tone.exposure_ev, exposure_ev) << "the panels took the key";
}

TEST_F(ViewerTest, EditsOfMaterialsKeepTheGeometryAndAreUndone) {
    start(options_for("assets/cornell_box.glb"));
    const ImageRgba32f before = viewer_->frame()->image;
    const std::shared_ptr<const World> world = model().job.world;
    // As the panel leaves it: the first step of a drag, and another of the same.
    ViewerModel& edited = const_cast<ViewerModel&>(model());
    PanelEdits edits;
    edits.before_edit = editable_of(edited);
    edits.scene_edited = true;
    for (Material& material : edited.materials)
        material.base_color_factor = Vec4(0.1f, 0.1f, 0.9f, 1);
    viewer_->apply(edits);
    edits.before_edit.reset();
    edited.materials[0].roughness_factor = 0.3f;
    viewer_->apply(edits);
    finish();
    const ImageRgba32f blue = viewer_->frame()->image;
    EXPECT_NE(before.pixels(), blue.pixels());
    EXPECT_EQ(model().job.world->fixed.parts, world->fixed.parts) << "nothing of the geometry is built anew";

    // What a world made from nothing would show, to the bit.
    RenderRequest request = model().job.request;
    auto scene = std::make_shared<Scene>(*world->scene);
    scene->materials = edited.materials;
    request.world = build_world(scene);
    SessionOptions session_options;
    session_options.publish_frames = false;
    RenderSession session(session_options);
    session.submit(request);
    session.wait_until_done();
    EXPECT_EQ(session.latest()->image.pixels(), blue.pixels());

    press(Key::z, ctrl);
    finish();
    EXPECT_EQ(viewer_->frame()->image.pixels(), before.pixels());
    press(Key::z, ctrl_shift);
    finish();
    EXPECT_EQ(viewer_->frame()->image.pixels(), blue.pixels());
    press(Key::z, ctrl_shift);
    EXPECT_EQ(model().notice, "nothing was undone");
}

TEST_F(ViewerTest, AnEnvironmentIsChosenAmongThoseThatLieNear) {
    const test::TemporaryFolder folder;
    std::filesystem::copy("assets/sky.hdr", folder.path() / "b.hdr");
    std::ofstream(folder.path() / "a.EXR");
    std::ofstream(folder.path() / "c.png");
    const std::vector<std::string> files = environment_files("assets/cornell_box.glb", (folder.path() / "x").string());
    ASSERT_GE(files.size(), 3u);
    EXPECT_EQ(files[0], (folder.path() / "a.EXR").string());
    EXPECT_EQ(files[1], (folder.path() / "b.hdr").string());
    EXPECT_EQ(std::filesystem::path(files[2]).filename(), "sky.hdr");
    EXPECT_GT(environment_files("", "").size(), 0u);

    start(options_for("assets/cornell_box.glb"));
    const ImageRgba32f before = viewer_->frame()->image;
    PanelEdits edits;
    edits.environment_file = files[1];
    viewer_->apply(edits);
    finish();
    EXPECT_EQ(model().options.hdri, files[1]);
    EXPECT_NE(viewer_->frame()->image.pixels(), before.pixels());
}

TEST_F(ViewerTest, MovesOfTheCameraAreUndoneToo) {
    start(options_for("assets/cornell_box.glb"));
    const OrbitView first = model().view;
    drag(MouseButton::middle, {60, 20}, {80, 30});
    const OrbitView second = model().view;
    drag(MouseButton::left, {60, 20}, {80, 30});
    EXPECT_NE(second, first);
    press(Key::z, ctrl);
    EXPECT_EQ(model().view, second);
    press(Key::z, ctrl);
    EXPECT_EQ(model().view, first);
    press(Key::z, ctrl);
    EXPECT_EQ(model().notice, "there is nothing to undo");
    // A click on a panel, here on its margin, is no move of the camera.
    press(Key::tab);
    for (int i = 0; i < 3; ++i)
        picture();
    click({181, 19});
    EXPECT_FALSE(model().inspection) << "the picture was clicked";
    press(Key::tab);
    for (int i = 0; i < 3; ++i)
        picture();
    press(Key::z, ctrl);
    EXPECT_EQ(model().view, first);
    press(Key::z, ctrl_shift);
    EXPECT_EQ(model().view, second);
    // Nor is each step of the wheel one by itself.
    viewer_->handle(MouseMoved{{60, 20}});
    for (int i = 0; i < 3; ++i) {
        now_s_ += 0.1;
        viewer_->handle(Scrolled{{0, 1}});
    }
    const OrbitView third = model().view;
    now_s_ += 1;
    viewer_->handle(Scrolled{{0, 1}});
    EXPECT_NE(model().view, third);
    press(Key::z, ctrl);
    EXPECT_EQ(model().view, third);
    press(Key::z, ctrl);
    EXPECT_EQ(model().view, second);
    // A new move ends what could be redone.
    drag(MouseButton::left, {60, 20}, {70, 30});
    press(Key::z, ctrl_shift);
    EXPECT_EQ(model().notice, "nothing was undone");
}

}  // namespace
}  // namespace candela
