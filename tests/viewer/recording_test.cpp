// SPDX-License-Identifier: MIT
// What is done to a viewer, written down and played again: the same picture to the bit.
#include "app/viewer/recording.h"

#include <fstream>
#include <sstream>

#include "app/command_line.h"
#include "app/viewer/replay.h"
#include "app/viewer/session_recorder.h"
#include "app/viewer/steady_figures.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/sliding_square.h"
#include "tests/viewer/viewer_fixture.h"

namespace candela {
namespace {

// Wide enough for speed and time in the status line.
constexpr Vec2u extent(480, 160);

// As the window's loop does it, off-screen: one round after the other, at times of the test's own.
class RecordedSession {
  public:
    RecordedSession(const std::string& path, const std::vector<std::string>& arguments, Vec2u window = extent)
        : context_(window) {
        viewer_ = std::make_unique<Viewer>(parse_view_options(arguments), context_,
                                           replayed_viewer([this] { return now_s_; }));
        recorder_ = std::make_unique<SessionRecorder>(path, arguments, window);
        round({});
        settle();
    }
    void round(const std::vector<InputEvent>& events) {
        now_s_ += 0.0173;
        recorder_->begin_frame(*viewer_, now_s_, events);
        for (const InputEvent& event : events)
            viewer_->handle(event);
        const bool draws = viewer_->update();
        if (draws) {
            viewer_->draw();
            viewer_->presented();
        }
        recorder_->end_frame(*viewer_, draws);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    void press(Key key, Modifiers modifiers = {}) {
        round({KeyPressed{key, true, modifiers}});
        round({KeyPressed{key, false, modifiers}});
    }
    void drag(MouseButton button, Vec2 from, Vec2 to) {
        round({MouseMoved{from}});
        round({MousePressed{button, true, {}}});
        for (int i = 1; i <= 4; ++i)
            round({MouseMoved{from + (to - from) * (static_cast<float>(i) / 4)}});
        round({MousePressed{button, false, {}}});
    }
    void settle() {
        const auto begin = std::chrono::steady_clock::now();
        do {
            round({});
            ASSERT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60)) << "does not settle";
        } while (!viewer_->finished());
        for (int i = 0; i < 4; ++i)
            round({});
    }
    ImageRgba8 finish() {
        settle();
        recorder_->finish();
        for (int i = 0; i < 3; ++i) {
            viewer_->update();
            viewer_->draw();
        }
        return read_back(context_);
    }
    Viewer& viewer() { return *viewer_; }

  private:
    double now_s_ = 0;
    OsmesaContext context_;
    std::unique_ptr<Viewer> viewer_;
    std::unique_ptr<SessionRecorder> recorder_;
};

ImageRgba8 replayed(const std::string& path, unsigned threads) {
    const Recording recording = read_recording(path);
    RenderOptions options = parse_view_options(recording.arguments);
    options.threads = threads;
    Replay replay(recording, options);
    replay.play();
    return replay.picture(true);
}

std::string first_line_of(const std::string& text) {
    std::istringstream stream(text);
    try {
        parse_recording(stream, "a.rec");
    } catch (const CommandError& error) {
        EXPECT_EQ(error.status(), ExitStatus::unreadable_scene);
        return error.what();
    }
    return "";
}

TEST(Recordings, AViewThatWasOrbitedThroughPanelsComesBackToTheBit) {
    const test::TemporaryFolder folder("candela recording");
    const std::string path = (folder.path() / "a.rec").string();
    RecordedSession session(path, {"assets/cornell_box.glb", "--spp", "6", "-t", "2"});
    session.drag(MouseButton::left, {60, 60}, {90, 70});
    session.round({Scrolled{{0, 1}}});
    session.press(Key::e);
    session.press(Key::tab);
    // The first slider of the panels, then the key that hides the background.
    session.drag(MouseButton::left, {100, 56}, {115, 56});
    session.press(Key::z);
    session.press(Key::v);
    session.round({FilesDropped{{"assets/glass_slab.glb"}, {}}});
    session.settle();
    session.drag(MouseButton::middle, {60, 60}, {64, 80});
    const ImageRgba8 seen = session.finish();
    const ImageRgba8 one = replayed(path, 1), three = replayed(path, 3);
    EXPECT_EQ(one.pixels(), three.pixels());
    EXPECT_EQ(seen.pixels(), one.pixels());
    EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

// Flying depends on the clock, a pasted view and a changed file on what is outside of the window; panels are used by
// keyboard.
TEST(Recordings, FlyingPastingReloadingAndThePanelsByKeyboardComeBackToTheBit) {
    const test::TemporaryFolder folder("candela recording");
    const std::string path = (folder.path() / "a.rec").string();
    RecordedSession session(path, {"assets/cornell_box.glb", "--spp", "2", "-t", "2", "--theme", "light"});
    const OrbitView first = session.viewer().model().view;
    session.round({TextPasted{"--eye 278,273,-600 --target 250,273,-599 --exposure 0.5 \"--tonemap"}});
    EXPECT_TRUE(session.viewer().model().notice_is_error);
    session.press(Key::escape);
    session.round({TextPasted{"--eye 278,273,-600\n--target 250,273,0 --exposure 0.5"}});
    session.press(Key::f);
    session.round({KeyPressed{Key::w, true, {}}});
    for (int i = 0; i < 9; ++i)
        session.round({});
    session.round({KeyPressed{Key::d, true, {.shift = true}}, KeyPressed{Key::w, false, {.shift = true}}});
    for (int i = 0; i < 4; ++i)
        session.round({});
    session.round({KeyPressed{Key::d, false, {}}});
    session.press(Key::f);
    session.round({SceneFileChanged{}});
    session.settle();
    session.press(Key::down);
    for (int i = 0; i < 12 && session.viewer().model().view.camera.yfov_radians == first.camera.yfov_radians; ++i) {
        for (const Key key : {Key::down, Key::space, Key::right, Key::right, Key::escape})
            session.press(key);
    }
    EXPECT_NE(session.viewer().model().view.camera.yfov_radians, first.camera.yfov_radians);
    const ImageRgba8 seen = session.finish();
    EXPECT_EQ(seen.pixels(), replayed(path, 1).pixels());
}

TEST(Recordings, ANoticeGoesAwayAsItDid) {
    const test::TemporaryFolder folder("candela recording");
    const std::string path = (folder.path() / "a.rec").string();
    RecordedSession session(path, {"assets/cornell_box.glb", "--spp", "16", "-t", "2"}, {320, 120});
    session.press(Key::z, {.ctrl = true});
    const std::string notice = session.viewer().model().notice;
    EXPECT_EQ(notice, "there is nothing to undo");
    // More pictures than panels need to settle come before it goes.
    session.round({Scrolled{{0, 1}}});
    for (int i = 0; i < 1000 && !session.viewer().model().notice.empty(); ++i)
        session.round({});
    EXPECT_EQ(session.viewer().model().notice, "");
    const ImageRgba8 seen = session.finish();
    EXPECT_EQ(seen.pixels(), replayed(path, 1).pixels());
}

TEST(SteadyFigures, NothingThatWasMeasuredIsLeft) {
    SessionStatus status;
    status.spp = 4;
    status.rays.camera = 12;
    status.render_seconds = status.rays_per_second = status.last_cancel_seconds = status.last_first_frame_seconds =
        status.last_reproject_seconds = 17;
    make_steady(status);
    EXPECT_DOUBLE_EQ(status.render_seconds, 0.4);
    EXPECT_DOUBLE_EQ(status.rays_per_second, 30);
    EXPECT_EQ(status.last_cancel_seconds, 0);
    EXPECT_EQ(status.last_first_frame_seconds, 0);
    EXPECT_EQ(status.last_reproject_seconds, 0);
}

// The panel of statistics is all in sight.
TEST(Recordings, StatisticsOfAnOrbitComeBackToTheBit) {
    const test::TemporaryFolder folder("candela recording");
    const std::string path = (folder.path() / "a.rec").string();
    RecordedSession session(path, {"assets/cornell_box.glb", "--spp", "2", "-t", "2"}, {400, 400});
    session.press(Key::z);
    session.drag(MouseButton::left, {60, 60}, {64, 62});
    const ImageRgba8 seen = session.finish();
    EXPECT_EQ(seen.pixels(), replayed(path, 3).pixels());
}

// The threads beside the render's own are waited for too: of the preview, the search for the path, the other settings.
TEST(Recordings, WhatIsMadeBesideThePictureComesBackToTheBit) {
    const test::TemporaryFolder folder("candela recording");
    for (const bool compares : {false, true}) {
        const std::string path = (folder.path() / "a.rec").string();
        RecordedSession session(path, {"assets/cornell_box.glb", "--spp", "2", "-t", "2"},
                                compares ? Vec2u(240, 400) : Vec2u(320, 240));
        session.press(Key::z);
        if (compares) {
            session.press(Key::b);
        } else {
            session.press(Key::d);
            session.drag(MouseButton::left, {150, 190}, {156, 190});
            session.round({MouseMoved{{150, 190}}});
            session.round({MousePressed{MouseButton::left, true, {}}});
            session.round({MousePressed{MouseButton::left, false, {}}});
        }
        const ImageRgba8 seen = session.finish();
        EXPECT_EQ(session.viewer().model().denoised_spp.has_value(), !compares);
        EXPECT_EQ(session.viewer().model().inspection.has_value(), !compares);
        EXPECT_EQ(session.viewer().model().comparison.shown, compares);
        EXPECT_EQ(seen.pixels(), replayed(path, 1).pixels());
    }
}

TEST(Recordings, APlayedAnimationStopsAtTheSamePose) {
    const test::TemporaryFolder folder("candela recording");
    const std::string path = (folder.path() / "a.rec").string();
    const std::string scene = (folder.path() / "a.gltf").string();
    test::write_sliding_square(scene);
    RecordedSession session(path, {scene, "--spp", "2"});
    session.press(Key::space);
    for (int i = 0; i < 40; ++i)
        session.round({});
    session.press(Key::space);
    const double time_s = session.viewer().model().playback.time_s;
    EXPECT_GT(time_s, 0);
    const ImageRgba8 seen = session.finish();
    EXPECT_EQ(seen.pixels(), replayed(path, 2).pixels());
}

class RecordedViewer : public test::ViewerTest {};

TEST_F(RecordedViewer, ALoadIsTakenInOnlyWhereTheRecordingHasIt) {
    waits_ = false;
    start(test::options_for("assets/cornell_box.glb", 1));
    viewer_->allow_loads(0);
    for (int i = 0; i < 400; ++i) {
        viewer_->update();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(viewer_->loads_taken(), 0u);
    EXPECT_TRUE(viewer_->loads());
    viewer_->allow_loads(1);
    finish();
    EXPECT_EQ(viewer_->loads_taken(), 1u);
    EXPECT_EQ(viewer_->shown_samples(), 1u);
}

// What was done while a scene loaded was done to the one before it, also where the load ends sooner now.
TEST(Recordings, ALoadWaitsForWhatWasDoneBeforeItEnded) {
    const char* const head = "candela recording 1\narguments assets/cornell_box.glb --spp 300\nwindow 32 24\n";
    const char* const turned =
        "frame 1 at 1 samples 0 loads 1\nframe 2 at 2 samples 0 loads 1\n  drop assets/alpha_cards.glb\n"
        "frame 3 at 3 samples 300 loads 1\n  key 7\nframe 4 at 4 samples 0 loads 2\n";
    const char* const plain =
        "frame 1 at 1 samples 0 loads 1\nframe 2 at 2 samples 0 loads 2\n  drop assets/alpha_cards.glb\n";
    std::vector<OrbitView> views;
    for (const char* const rounds : {turned, plain}) {
        std::istringstream stream(std::string(head) + rounds);
        const Recording recording = parse_recording(stream, "a.rec");
        Replay replay(recording, parse_view_options(recording.arguments));
        replay.play();
        views.push_back(replay.viewer().model().view);
    }
    EXPECT_EQ(views[0], views[1]) << "the new scene was turned";
}

// A click before the first sample, on a pixel of a picture that had not come yet.
TEST(Recordings, AClickBeforeTheFirstSampleIsAnswered) {
    std::istringstream stream(
        "candela recording 1\narguments assets/cornell_box.glb --spp 2\nwindow 32 24\n"
        "frame 1 at 1 samples 0 loads 1\n"
        "frame 2 at 2 samples 0 loads 1\n  move 16 12\n  press left\n  release left\n");
    const Recording recording = parse_recording(stream, "a.rec");
    Replay replay(recording, parse_view_options(recording.arguments));
    replay.play();
    ASSERT_TRUE(replay.viewer().model().inspection.has_value());
    EXPECT_EQ(replay.viewer().model().inspection->pixel, Vec2u(16, 12));
    EXPECT_TRUE(replay.viewer().model().inspection->ledger.has_value());
}

TEST(Recordings, WhatIsWrittenIsRead) {
    RecordedFrame frame;
    frame.number = 7;
    frame.time_s = 1.000001;
    frame.samples = 12;
    frame.loads = 3;
    frame.drawn = true;
    frame.events = {MouseMoved{{1.1f, -2}},
                    MousePressed{MouseButton::middle, false, {true, false, true}},
                    Scrolled{{0, -0.1f}},
                    KeyPressed{Key::f5, true, {}},
                    KeyPressed{static_cast<Key>(301), true, {false, true, false}},
                    KeyPressed{Key::left_bracket, false, {}},
                    TextTyped{0x1f600},
                    TextPasted{"--eye 1,2,3\n\"#\\"},
                    FilesDropped{{"a b/\"c\".glb", "#d"}, {true, false, false}},
                    WindowResized{{640.5f, 360}, {1281, 720}, 2},
                    WindowExposed{},
                    SceneFileChanged{},
                    CloseRequested{}};
    const std::string text = header_text({"a scene.glb", "--spp", "", "4"}, {640, 360}) + frame_text(frame);
    std::istringstream stream(text);
    const Recording recording = parse_recording(stream, "a.rec");
    EXPECT_EQ(recording.arguments, (std::vector<std::string>{"a scene.glb", "--spp", "", "4"}));
    EXPECT_EQ(recording.window, Vec2u(640, 360));
    ASSERT_EQ(recording.frames.size(), 1u);
    EXPECT_EQ(recording.frames[0].events.size(), frame.events.size());
    EXPECT_EQ(header_text(recording.arguments, recording.window) + frame_text(recording.frames[0]), text);
}

TEST(Recordings, BrokenOnesAreRefusedWithTheirLine) {
    const std::string head = "candela recording 1\narguments a.glb\nwindow 64 48\n";
    const std::string frame = "frame 1 at 0 samples 0 loads 0 drawn\n";
    const std::pair<std::string, const char*> cases[] = {
        {"", "a.rec:1: a recording begins with"},
        {"candela recording 2\n", "a.rec:1: a recording begins with"},
        {std::string("\0\xff\n\"", 4), "a.rec:1: "},
        {"candela recording 1\n", "a.rec:1: the file ends without"},
        {"candela recording 1\narguments \"a\n", "a.rec:2: a quotation mark"},
        {"candela recording 1\nwindow 64 48\nframe 1 at 0 samples 0 loads 0\n", "a.rec:3: a line of arguments"},
        {head + "window 64 48\n", "a.rec:4: there is a window already"},
        {head + "move 1 2\n", "a.rec:4: 'move' comes before"},
        {head + frame + "frame 1 at 0 samples 0 loads 0\n", "a.rec:5: '1' is no frame number"},
        {head + "frame 1 at nan samples 0 loads 0\n", "a.rec:4: 'nan' is no time"},
        {head + frame + "frame 2 at -1 samples 0 loads 0\n", "a.rec:5: '-1' is no time"},
        {head + "frame 1 at 0 samples -1 loads 0\n", "a.rec:4: '-1' is no number of samples"},
        {head + "frame 1 at 0 samples 0 loads 0 hidden\n", "a.rec:4: 'hidden' stands where 'drawn'"},
        {head + frame + "move 1\n", "a.rec:5: position is missing"},
        {head + frame + "move 1e300 2\n", "a.rec:5: '1e300' is no position"},
        {head + frame + "move inf 2\n", "a.rec:5: 'inf' is no position"},
        {head + frame + "move 1 2 3\n", "a.rec:5: '3' is too much"},
        {head + frame + "press fourth\n", "a.rec:5: 'fourth' is none of left"},
        {head + frame + "key #512\n", "a.rec:5: '#512' is no key"},
        {head + frame + "key \"\"\n", "a.rec:5: '' is no key"},
        {head + frame + "key a meta\n", "a.rec:5: 'meta' is none of shift"},
        {head + frame + "text 1114112\n", "a.rec:5: '1114112' is no code point"},
        {head + frame + "resize 64 48 99999 48 1\n", "a.rec:5: '99999' is no number of pixels"},
        {head + frame + "resize 0 48 64 48 1\n", "a.rec:5: a window has no such size"},
        {head + frame + "resize 64 48 64 48 1000\n", "a.rec:5: '1000' is no scale"},
        {head + frame + "drop\n", "a.rec:5: no file is named"},
        {head + frame + "jump\n", "a.rec:5: 'jump' is no event"},
        {head + "\"\"\n", "a.rec:4: '' comes before"}};
    for (const auto& [text, reason] : cases) {
        const std::string line = first_line_of(text);
        EXPECT_EQ(line.find(reason), 0u) << "of:\n" << text << "\nsaid: " << line;
    }
    EXPECT_EQ(first_line_of(head + "\n# a remark\n" + frame + "  move 1 2\r\n"), "");
}

TEST(Recordings, WaitingForWhatNeverComesEnds) {
    std::istringstream stream(
        "candela recording 1\narguments assets/cornell_box.glb --spp 1\nwindow 32 24\n"
        "frame 1 at 0 samples 4000000000 loads 1\nframe 2 at 9 samples 4000000000 loads 5\n");
    const Recording recording = parse_recording(stream, "a.rec");
    Replay replay(recording, parse_view_options(recording.arguments));
    try {
        replay.play();
        ADD_FAILURE() << "it ended well";
    } catch (const CommandError& error) {
        EXPECT_STREQ(error.what(), "a.rec:5: 5 loads have ended here, but only 1 were begun");
    }
}

}  // namespace
}  // namespace candela
