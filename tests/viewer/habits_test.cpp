// SPDX-License-Identifier: MIT
// Flying, views as text, reloading, panels by keyboard, and what goes between the viewer and the desktop.
#include <fstream>

#include "app/viewer/desktop.h"
#include "app/viewer/view_text.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/viewer_fixture.h"

namespace candela {
namespace {

using test::difference;
using test::options_for;
using test::ViewerTest;

class Habits : public ViewerTest {
  protected:
    void hold(Key key, bool pressed, Modifiers modifiers = {}) { viewer_->handle(KeyPressed{key, pressed, modifiers}); }
    void frames(int count, double dt_s = 0.1) {
        for (int i = 0; i < count; ++i) {
            now_s_ += dt_s;
            viewer_->update();
            viewer_->draw();
        }
    }
    Vec3 eye() const { return model().view.camera.position(); }
    float scene_size() const { return glm::length(model().job.world->bounds.upper - model().job.world->bounds.lower); }
};

TEST_F(Habits, FlyingMovesWhileKeysAreHeld) {
    start(options_for("assets/cornell_box.glb", 1));
    const OrbitView before = model().view;
    hold(Key::w, true);
    frames(5);
    hold(Key::w, false);
    EXPECT_EQ(model().view, before) << "that key does nothing yet";

    press(Key::f);
    EXPECT_TRUE(model().flying);
    now_s_ += 50;
    hold(Key::w, true);
    EXPECT_TRUE(viewer_->clock_matters());
    frames(5);
    hold(Key::w, false);
    const Vec3 way = eye() - before.camera.position();
    EXPECT_NEAR(glm::dot(way, before.camera.forward()), 0.5f * scene_size() / 8, 1e-3f * scene_size())
        << "half a second at an eighth of the scene's diagonal each; the time before the key does not count";
    EXPECT_LT(glm::length(way - glm::dot(way, before.camera.forward()) * before.camera.forward()), 1e-4f);
    EXPECT_EQ(Mat3(model().view.camera.world_from_camera), Mat3(before.camera.world_from_camera));
    frames(5);
    EXPECT_NEAR(glm::length(way), glm::distance(eye(), before.camera.position()), 1e-5f) << "it goes on by itself";

    // Up, four times as fast; the exposure does not hear of it.
    const Vec3 there = eye();
    hold(Key::shift, true, {.shift = true});
    hold(Key::e, true, {.shift = true});
    frames(5);
    hold(Key::e, false, {.shift = true});
    EXPECT_NEAR(eye().y - there.y, 4 * 0.5f * scene_size() / 8, 1e-3f * scene_size());
    EXPECT_EQ(model().display.tone.exposure_ev, 0);

    // One way is one step of the history.
    press(Key::z, {.ctrl = true});
    EXPECT_LT(glm::distance(eye(), there), 1e-5f);
    press(Key::escape);
    EXPECT_FALSE(model().flying);
    press(Key::e);
    EXPECT_GT(model().display.tone.exposure_ev, 0);
}

TEST_F(Habits, FlyingTurnsTheHeadWithMouseAndArrows) {
    start(options_for("assets/cornell_box.glb", 1));
    press(Key::f);
    const OrbitView before = model().view;
    drag(MouseButton::left, {100, 75}, {130, 75});
    EXPECT_LT(glm::distance(eye(), before.camera.position()), 1e-5f) << "the eye stays";
    // What was in the middle has followed the drag to the right.
    const Vec3 seen = project(model().view.camera, 200.0f / 150, before.pivot);
    EXPECT_NEAR(seen.x, 0.5f + 30.0f / 200, 0.02f);
    hold(Key::right, true);
    frames(4, 0.05);
    hold(Key::right, false);
    EXPECT_NEAR(project(model().view.camera, 200.0f / 150, before.pivot).x, 0.5f, 0.02f)
        << "a fifth of the height in a fifth of a second, back";
}

TEST_F(Habits, AViewGoesThroughTheClipboard) {
    start(options_for("assets/cornell_box.glb", 2));
    press(Key::e);
    const OrbitView view = model().view;
    const ImageRgba8 before = picture();
    press(Key::c, {.ctrl = true});
    const std::optional<std::string> copied = viewer_->take_requests().copied;
    ASSERT_TRUE(copied);
    EXPECT_FALSE(viewer_->take_requests().copied);
    drag(MouseButton::left, {100, 60}, {140, 60});
    press(Key::e);
    viewer_->handle(TextPasted{*copied});
    EXPECT_LT(glm::distance(eye(), view.camera.position()), 1e-5f);
    EXPECT_EQ(model().display.tone.exposure_ev, 0.25f);
    finish();
    now_s_ += 10;
    EXPECT_LT(difference(before, picture()), 1.0);

    // The command line takes the same text, for the same picture.
    std::string problem;
    EXPECT_TRUE(view_from_text(*copied, {}, problem)) << problem;

    viewer_->handle(TextPasted{"not a view"});
    EXPECT_TRUE(model().notice_is_error);
    EXPECT_NE(model().notice.find("holds no view"), std::string::npos) << model().notice;
    EXPECT_LT(glm::distance(eye(), view.camera.position()), 1e-5f);
}

TEST_F(Habits, AChangedFileIsReadAnewAndTheViewStays) {
    const test::TemporaryFolder folder;
    const std::filesystem::path scene = folder.path() / "scene.glb";
    std::filesystem::copy("assets/cornell_box.glb", scene);
    start(options_for(scene.string(), 1));
    drag(MouseButton::left, {100, 60}, {120, 60});
    finish();
    const OrbitView view = model().view;
    const ImageRgba8 before = picture();
    std::filesystem::copy("assets/veach_plates.glb", scene, std::filesystem::copy_options::overwrite_existing);
    viewer_->handle(SceneFileChanged{});
    finish();
    now_s_ += 10;
    EXPECT_EQ(model().view, view);
    const ImageRgba8 other = picture();
    EXPECT_GT(difference(before, other), 4.0);

    // Half of a file: what was shown stays, and comes back without a word when the rest is there.
    std::filesystem::resize_file(scene, 200);
    viewer_->handle(SceneFileChanged{});
    finish();
    EXPECT_TRUE(model().notice_is_error);
    EXPECT_TRUE(model().has_scene());
    std::filesystem::copy("assets/veach_plates.glb", scene, std::filesystem::copy_options::overwrite_existing);
    viewer_->handle(SceneFileChanged{});
    finish();
    now_s_ += 10;
    EXPECT_EQ(model().notice, "");
    EXPECT_EQ(difference(other, picture()), 0.0);
}

TEST_F(Habits, ThePanelsAreUsedByKeyboard) {
    start(options_for("assets/cornell_box.glb", 1));
    const auto key = [&](Key each) {
        press(each);
        frames(2);
    };
    key(Key::down);
    EXPECT_TRUE(model().show_panels);
    EXPECT_TRUE(model().panels_have_keyboard);
    // From the first button on down to the slider of the field of view, which Space holds and the arrows move.
    const float before = model().view.camera.yfov_radians;
    const std::string title = viewer_->title();
    for (int i = 0; i < 12 && model().view.camera.yfov_radians == before; ++i) {
        key(Key::down);
        key(Key::space);
        key(Key::right);
        key(Key::right);
        key(Key::escape);
    }
    EXPECT_NE(model().view.camera.yfov_radians, before);
    EXPECT_EQ(viewer_->title(), title) << "the arrows went to the next file";
    for (int i = 0; i < 4; ++i)
        key(Key::escape);
    EXPECT_FALSE(model().panels_have_keyboard);
    EXPECT_TRUE(model().show_panels);
    key(Key::tab);
    EXPECT_FALSE(model().show_panels);
}

TEST_F(Habits, ThemeAndSizeChangeThePanelsAndNothingElse) {
    RenderOptions options = options_for("assets/cornell_box.glb", 1);
    options.style = {Theme::light, 1};
    start(options);
    now_s_ += 10;
    const ImageRgba8 light = picture();
    EXPECT_GT(light(100, 149).r, 200) << "the status line";
    options.style.theme = Theme::dark;
    viewer_.reset();
    context_.reset();
    start(options);
    now_s_ += 10;
    const ImageRgba8 dark = picture();
    EXPECT_LT(dark(100, 149).r, 60);
    EXPECT_EQ(difference(light, dark), 0.0) << "the picture above the status line";
    options.style.scale = 2;
    viewer_.reset();
    context_.reset();
    start(options);
    now_s_ += 10;
    const ImageRgba8 large = picture();
    const auto mean_red = [&](int y) {
        int sum = 0;
        for (int x = 0; x < large.width(); ++x)
            sum += large(x, y).r;
        return sum / large.width();
    };
    EXPECT_GT(mean_red(94), mean_red(97) + 20) << "the status line is 54 pixels high";
    EXPECT_LT(mean_red(97), 60);
}

TEST_F(Habits, ATinyWindowStillShowsThePicture) {
    start(options_for("assets/cornell_box.glb", 1));
    context_->resize({320, 200});
    viewer_->handle(WindowResized{{320, 200}, {320, 200}, 1});
    finish();
    now_s_ += 10;
    const ImageRgba8 before = picture();
    for (const std::vector<Key>& keys :
         std::vector<std::vector<Key>>{{Key::tab}, {Key::z}, {Key::h}, {Key::tab, Key::z, Key::h}}) {
        for (const Key key : keys)
            press(key);
        finish();
        now_s_ += 10;
        const ImageRgba8 after = picture();
        size_t covered = 0;
        for (size_t i = 0; i < after.size(); ++i)
            covered += after.pixels()[i] != before.pixels()[i] ? 1 : 0;
        EXPECT_LT(covered, 7 * after.size() / 10);
        EXPECT_GT(covered, after.size() / 10);
        for (const Key key : keys)
            press(key);
        finish();
    }
}

TEST_F(Habits, WhatIsOpenedIsRememberedAndOffered) {
    const test::TemporaryFolder folder;
    const std::filesystem::path scene = folder.path() / "a scene.glb", settings = folder.path() / "c" / "settings.json";
    std::filesystem::copy("assets/veach_plates.glb", scene);
    RememberedSettings remembered;
    remembered.recent = {"/before.glb"};
    remembered.style.theme = Theme::light;
    write_settings(settings, remembered);
    start(options_for("assets/cornell_box.glb", 1));
    std::string clipboard, warning;
    Desktop desktop({settings, remembered, false, [&](const std::string& text) { clipboard = text; },
                     [](const std::string& line) { FAIL() << line; }},
                    *viewer_, {200, 150});
    EXPECT_EQ(model().recent, remembered.recent);
    desktop.serve(*viewer_, {200, 150});
    EXPECT_EQ(read_settings(settings, warning).recent.size(), 1u) << "the program's own scenes are not remembered";

    // The panel asks for it; the answer is an event.
    PanelEdits edits;
    edits.open_recent = scene.string();
    edits.copy_view = true;
    viewer_->apply(edits);
    EXPECT_FALSE(model().loading);
    desktop.serve(*viewer_, {200, 150});
    EXPECT_EQ(clipboard.substr(0, 6), "--eye ");
    EXPECT_EQ(desktop.longest_sleep_s(), 0);
    std::vector<InputEvent> events;
    desktop.add_events(*viewer_, now_s_, events);
    ASSERT_EQ(events.size(), 1u);
    viewer_->handle(events[0]);
    finish();
    desktop.serve(*viewer_, {200, 150});
    EXPECT_EQ(viewer_->title(), "candela - a scene.glb");
    EXPECT_EQ(read_settings(settings, warning).recent, (std::vector<std::string>{scene.string(), "/before.glb"}));
    EXPECT_EQ(model().recent.front(), scene.string());

    press(Key::t);
    press(Key::tab);
    desktop.remember(*viewer_, {300, 200});
    const RememberedSettings after = read_settings(settings, warning);
    EXPECT_EQ(after.tone.curve, model().display.tone.curve);
    EXPECT_TRUE(after.panels);
    EXPECT_EQ(after.window, Vec2u(300, 200));
    EXPECT_EQ(after.style.theme, Theme::light) << "what was not touched here stays";

    // What stands there broken may be somebody's work.
    std::ofstream(settings) << R"({"theme": )";
    desktop.remember(*viewer_, {320, 200});
    EXPECT_EQ(read_settings(settings, warning).window, Vec2u(320, 200));
    EXPECT_EQ(warning, "");
    read_settings(settings.string() + ".broken", warning);
    EXPECT_NE(warning, "");
}

TEST_F(Habits, AWatchedSceneAndItsFilesAreSeenToChange) {
    const test::TemporaryFolder folder;
    const std::filesystem::path data = folder.path() / "data.bin", scene = folder.path() / "scene.gltf";
    const std::vector<float> positions = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
    std::ofstream(data, std::ios::binary)
        .write(reinterpret_cast<const char*>(positions.data()), static_cast<std::streamsize>(positions.size() * 4));
    std::ofstream(scene) << R"({
        "asset": {"version": "2.0"}, "buffers": [{"uri": "data.bin", "byteLength": 36}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "images": [{"uri": "to%20come.png"}],
        "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0})";
    start(options_for(scene.string(), 1));
    EXPECT_EQ(model().job.rest->files,
              (std::vector<std::string>{data.string(), (folder.path() / "to come.png").string()}));
    Desktop desktop({{}, {}, true, {}, {}}, *viewer_, {200, 150});
    const auto changes = [&] {
        int told = 0;
        for (int i = 0; i < 5; ++i) {
            std::vector<InputEvent> events;
            now_s_ += FileWatch::look_seconds + 0.01;
            desktop.add_events(*viewer_, now_s_, events);
            for (const InputEvent& event : events)
                told += std::get_if<SceneFileChanged>(&event) != nullptr ? 1 : 0;
        }
        return told;
    };
    EXPECT_EQ(changes(), 0);
    std::ofstream(data, std::ios::binary | std::ios::app) << "more";
    EXPECT_EQ(changes(), 1);
    std::ofstream(folder.path() / "to come.png") << "something";
    EXPECT_EQ(changes(), 1);
    EXPECT_EQ(changes(), 0);
}

TEST_F(Habits, WithoutAProgramForTheDialogItSaysWhatWouldHelp) {
    start(options_for("assets/cornell_box.glb", 1));
    Desktop desktop({{}, {}, false, {}, {}}, *viewer_, {200, 150});
    const char* before = std::getenv("PATH");
    const std::string path = before != nullptr ? before : "";
    setenv("PATH", "/nowhere", 1);
    press(Key::o, {.ctrl = true});
    desktop.serve(*viewer_, {200, 150});
    setenv("PATH", path.c_str(), 1);
    EXPECT_NE(model().notice.find("zenity or kdialog"), std::string::npos) << model().notice;
}

}  // namespace
}  // namespace candela
