// SPDX-License-Identifier: MIT
// Undoing what is not the scene's own: environment, variants, scenes, lens, display and settings.
#include <fstream>

#include "app/viewer/panels.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/viewer_fixture.h"

namespace candela {
namespace {

using test::options_for;
using test::ViewerTest;

constexpr Modifiers ctrl{.ctrl = true}, ctrl_shift{.shift = true, .ctrl = true};

class UndoTest : public ViewerTest {
  protected:
    ImageRgba32f rendered() {
        finish();
        now_s_ += 10;
        return viewer_->frame()->image;
    }
    void undo() { press(Key::z, ctrl); }
    void redo() { press(Key::z, ctrl_shift); }
    // As a panel leaves a slider that is dragged: one step, and more of the same.
    template <typename Change>
    void slide(Change&& change, PanelEdits what) {
        ViewerModel& edited = const_cast<ViewerModel&>(model());
        what.before_edit = editable_of(edited);
        what.before_edit->scene = false;
        for (int i = 1; i <= 3; ++i) {
            change(edited, i);
            viewer_->apply(what);
            what.before_edit.reset();
            viewer_->update();
        }
    }
};

TEST_F(UndoTest, TheEnvironmentComesBackToTheBitWithItsSamples) {
    RenderOptions options = options_for("assets/cornell_box.glb", 2);
    options.integrator.background = BackgroundKind::environment;
    start(options);
    // Samples of bookmarked views are kept, however soon they are left.
    press(Key::digit_1, ctrl);
    const ImageRgba32f without = rendered();
    PanelEdits edits;
    edits.environment_file = "assets/sky.hdr";
    viewer_->apply(edits);
    const ImageRgba32f sky = rendered();
    EXPECT_NE(sky.pixels(), without.pixels());
    PanelEdits turned;
    turned.environment = true;
    slide([](ViewerModel& m, int i) { m.options.hdri_intensity = 1 + 0.5f * static_cast<float>(i); }, turned);
    const ImageRgba32f brighter = rendered();
    EXPECT_NE(brighter.pixels(), sky.pixels());
    drag(MouseButton::right, {60, 20}, {120, 20}, {.shift = true});
    const ImageRgba32f turned_sky = rendered();
    EXPECT_NE(turned_sky.pixels(), brighter.pixels());

    const auto expect_back = [&](const ImageRgba32f& image, float intensity, const std::string& file) {
        EXPECT_EQ(rendered().pixels(), image.pixels());
        EXPECT_EQ(model().status.resumed_samples, 2u) << "it was rendered again";
        EXPECT_EQ(model().options.hdri_intensity, intensity);
        EXPECT_EQ(model().options.hdri, file);
    };
    undo();
    expect_back(brighter, 2.5f, "assets/sky.hdr");
    EXPECT_EQ(model().options.hdri_rotation_degrees, 0);
    undo();
    expect_back(sky, 1, "assets/sky.hdr");
    undo();
    expect_back(without, 1, "");
    EXPECT_EQ(model().job.environment, nullptr);
    undo();
    EXPECT_EQ(model().notice, "there is nothing to undo");
    redo();
    expect_back(sky, 1, "assets/sky.hdr");
    redo();
    expect_back(brighter, 2.5f, "assets/sky.hdr");
    redo();
    expect_back(turned_sky, 2.5f, "assets/sky.hdr");
}

TEST_F(UndoTest, AnEnvironmentThatIsStillMadeIsUndoneToo) {
    start(options_for("assets/cornell_box.glb", 1));
    const ImageRgba32f without = rendered();
    PanelEdits edits;
    edits.environment_file = "assets/sky.hdr";
    viewer_->apply(edits);
    const ImageRgba32f sky = rendered();
    PanelEdits turned;
    turned.environment = true;
    slide([](ViewerModel& m, int i) { m.options.hdri_rotation_degrees = 20 * static_cast<float>(i); }, turned);
    undo();
    EXPECT_EQ(rendered().pixels(), sky.pixels());
    EXPECT_EQ(model().options.hdri_rotation_degrees, 0);
    // A step that begins before the last one is shown.
    drag(MouseButton::right, {60, 20}, {120, 20}, {.shift = true});
    const ImageRgba32f once = rendered();
    undo();
    rendered();
    for (int i = 0; i < 2; ++i) {
        viewer_->handle(MouseMoved{{60, 20}});
        viewer_->handle(MousePressed{MouseButton::right, true, {.shift = true}});
        viewer_->handle(MouseMoved{{120, 20}});
        viewer_->handle(MousePressed{MouseButton::right, false, {.shift = true}});
    }
    undo();
    EXPECT_EQ(rendered().pixels(), once.pixels());
    // A file that is still read is not waited for.
    const test::TemporaryFolder folder;
    std::filesystem::copy("assets/sky.hdr", folder.path() / "other.hdr");
    edits.environment_file = (folder.path() / "other.hdr").string();
    viewer_->apply(edits);
    viewer_->update();
    undo();
    EXPECT_EQ(rendered().pixels(), sky.pixels());
    EXPECT_EQ(model().options.hdri, "assets/sky.hdr");
    undo();
    EXPECT_EQ(rendered().pixels(), without.pixels());
    // After so many steps that their worlds are gone it is made anew, the same to the bit.
    redo();
    for (int k = 0; k < 5; ++k) {
        slide([k](ViewerModel& m, int i) { m.options.hdri_intensity = 2 + 0.1f * static_cast<float>(3 * k + i); },
              turned);
        finish();
    }
    for (int k = 0; k < 5; ++k)
        undo();
    EXPECT_EQ(rendered().pixels(), sky.pixels());
}

TEST_F(UndoTest, AnEditOfTheSceneAndOneOfTheEnvironmentDoNotMix) {
    start(options_for("assets/cornell_box.glb", 1));
    const ImageRgba32f plain = rendered();
    PanelEdits material;
    material.scene_edited = true;
    material.before_edit = editable_of(model());
    const_cast<ViewerModel&>(model()).materials[0].base_color_factor = Vec4(0.1f, 0.1f, 0.9f, 1);
    viewer_->apply(material);
    const ImageRgba32f blue = rendered();
    PanelEdits edits;
    edits.environment_file = "assets/sky.hdr";
    viewer_->apply(edits);
    const ImageRgba32f both = rendered();
    EXPECT_NE(both.pixels(), blue.pixels());
    undo();
    EXPECT_EQ(rendered().pixels(), blue.pixels());
    undo();
    EXPECT_EQ(rendered().pixels(), plain.pixels());
    // Both at once, before anything of it is made.
    redo();
    redo();
    EXPECT_EQ(rendered().pixels(), both.pixels());
}

TEST_F(UndoTest, WithoutASceneThereIsNothingToUndo) {
    start({});
    press(Key::j);
    press(Key::e);
    undo();
    EXPECT_EQ(model().notice, "there is nothing to undo");
}

TEST_F(UndoTest, ExposureCurveLensAndSettings) {
    start(options_for("assets/cornell_box.glb", 1));
    const OrbitView view = model().view;
    const ImageRgba32f plain = rendered();
    // Presses that follow each other are one step.
    for (int i = 0; i < 3; ++i)
        press(Key::e);
    now_s_ += 2;
    press(Key::e);
    EXPECT_FLOAT_EQ(model().display.tone.exposure_ev, 1);
    undo();
    EXPECT_FLOAT_EQ(model().display.tone.exposure_ev, 0.75f);
    press(Key::t);
    undo();
    EXPECT_EQ(model().display.tone.curve, ToneCurve::neutral);
    undo();
    EXPECT_FLOAT_EQ(model().display.tone.exposure_ev, 0);

    PanelEdits tone, lens, settings;
    tone.tone = lens.view = settings.settings = true;
    slide([](ViewerModel& m, int i) { m.display.tone.exposure_ev = static_cast<float>(i); }, tone);
    slide([](ViewerModel& m, int i) { m.view.camera.aperture_diameter_m = 0.01f * static_cast<float>(i); }, lens);
    slide([](ViewerModel& m, int i) { m.options.integrator.max_depth = static_cast<uint32_t>(i); }, settings);
    press(Key::j);
    finish();
    EXPECT_NE(model().options.integrator.background, BackgroundKind::environment);
    undo();
    EXPECT_EQ(model().options.integrator.background, BackgroundKind::environment);
    EXPECT_EQ(model().options.integrator.max_depth, 3u);
    undo();
    EXPECT_EQ(model().options.integrator.max_depth, 0u);
    EXPECT_FLOAT_EQ(model().view.camera.aperture_diameter_m, 0.03f);
    undo();
    EXPECT_EQ(model().view, view);
    EXPECT_FLOAT_EQ(model().display.tone.exposure_ev, 3);
    undo();
    EXPECT_FLOAT_EQ(model().display.tone.exposure_ev, 0);
    EXPECT_EQ(rendered().pixels(), plain.pixels());
    // Focus by a click, and a view by its key.
    drag(MouseButton::left, {100, 100}, {100, 100}, ctrl_shift);
    EXPECT_NE(model().view, view);
    press(Key::digit_7);
    undo();
    undo();
    EXPECT_EQ(model().view, view);
}

TEST_F(UndoTest, APoseStaysWhenTheEnvironmentGoesBack) {
    start(options_for("tests/viewer/sliding_square.gltf", 1));
    const auto seek = [&](double time_s) {
        PanelEdits edits;
        edits.seek_s = time_s;
        viewer_->apply(edits);
        return rendered();
    };
    const ImageRgba32f late = seek(0.5), early = seek(0);
    EXPECT_NE(late.pixels(), early.pixels());
    PanelEdits edits;
    edits.environment_file = "assets/sky.hdr";
    viewer_->apply(edits);
    finish();
    seek(0.5);
    undo();
    EXPECT_EQ(rendered().pixels(), late.pixels());
}

// A triangle of three materials, of which variants choose one, in two scenes.
std::filesystem::path write_scenes(const std::filesystem::path& folder) {
    std::ofstream(folder / "scenes.gltf") << R"({
        "asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_variants"],
        "extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "blue"}]}},
        "scene": 0, "scenes": [{"name": "one", "nodes": [0]}, {"name": "two", "nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [0.5, 0, 0]}],
        "materials": [{}, {"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}},
                      {"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 1, 1]}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0,
            "extensions": {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [0]},
                                                                   {"material": 2, "variants": [1]}]}}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri":
            "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
    return folder / "scenes.gltf";
}

TEST_F(UndoTest, VariantsAndScenes) {
    const test::TemporaryFolder folder;
    start(options_for(write_scenes(folder.path()).string()));
    ASSERT_TRUE(model().has_scene()) << viewer_->load_error();
    const ImageRgba32f own = rendered();
    PanelEdits edits;
    edits.variant = std::optional<uint32_t>(1);
    viewer_->apply(edits);
    const ImageRgba32f blue = rendered();
    EXPECT_NE(blue.pixels(), own.pixels());
    drag(MouseButton::left, {100, 60}, {140, 60});
    const OrbitView turned = model().view;
    const ImageRgba32f turned_blue = rendered();
    edits = {};
    edits.scene = 1;
    viewer_->apply(edits);
    const ImageRgba32f second = rendered();
    EXPECT_EQ(model().job.world->scene->active_scene, 1u);
    EXPECT_NE(model().view, turned);
    undo();
    EXPECT_EQ(rendered().pixels(), turned_blue.pixels());
    EXPECT_EQ(model().job.world->scene->active_scene, 0u);
    EXPECT_EQ(model().job.world->scene->active_variant, std::optional<uint32_t>(1));
    EXPECT_EQ(model().view, turned);
    redo();
    EXPECT_EQ(rendered().pixels(), second.pixels());
    undo();
    finish();
    undo();
    // Back over an edit and the variant, before anything of it is made.
    PanelEdits material;
    material.scene_edited = true;
    material.before_edit = editable_of(model());
    const_cast<ViewerModel&>(model()).materials[0].base_color_factor = Vec4(0, 1, 0, 1);
    viewer_->apply(material);
    finish();
    undo();
    viewer_->update();
    undo();
    EXPECT_EQ(rendered().pixels(), own.pixels());
    EXPECT_EQ(model().options.variant, "");
    redo();
    EXPECT_EQ(rendered().pixels(), blue.pixels());
    EXPECT_EQ(model().options.variant, "blue");
    // Another file has a history of its own.
    viewer_->open("assets/cornell_box.glb");
    finish();
    undo();
    EXPECT_EQ(model().notice, "there is nothing to undo");
}

}  // namespace
}  // namespace candela
