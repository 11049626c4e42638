// SPDX-License-Identifier: MIT
// The program itself in a real window. A converged picture is the same to the bit whenever it is rendered again, so the
// pictures must return exactly.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "renderer/image/codec.h"
#include "tests/support/temporary_folder.h"
#include "tests/window/virtual_display.h"

namespace candela::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int width = 480, height = 240;
constexpr int status_line_pixels = 30;

bool has_program(const char* name) {
    return std::system((std::string("command -v ") + name + " >/dev/null").c_str()) == 0;
}

std::string asset(const char* name) {
    return (std::filesystem::current_path() / "assets" / name).string();
}

// Mean absolute difference of 8-bit values above the status line; of different sizes: infinite.
double difference(const ImageRgba8& a, const ImageRgba8& b) {
    if (a.width() != b.width() || a.height() != b.height()) return HUGE_VAL;
    double sum = 0;
    for (int y = 0; y < a.height() - status_line_pixels; ++y) {
        for (int x = 0; x < a.width(); ++x) {
            for (int c = 0; c < 3; ++c)
                sum += std::abs(a(x, y)[c] - b(x, y)[c]);
        }
    }
    return sum / (3.0 * (a.height() - status_line_pixels) * a.width());
}

double brightness(const ImageRgba8& a) {
    return difference(a, ImageRgba8(a.width(), a.height(), Rgba8(0)));
}

// The word "done" stands in the status line in the accent colour, in which nothing else there is written.
bool says_done(const ImageRgba8& a) {
    int count = 0;
    for (int y = std::max(a.height() - 27, 0); y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const Rgba8 p = a(x, y);
            if (p.r > 180 && p.g > 110 && p.b < 110 && p.r - p.b > 100) ++count;
        }
    }
    return count > 8;
}

// Whether the file's name at the left end of the status line is another.
bool names_another_file(const ImageRgba8& a, const ImageRgba8& b) {
    for (int y = a.height() - 27; y < a.height(); ++y) {
        for (int x = 0; x < 110; ++x) {
            if (a(x, y) != b(x, y)) return true;
        }
    }
    return false;
}

class WindowTest : public testing::Test {
  protected:
    void SetUp() override {
        for (const char* program : {"Xvfb", "xdotool"}) {
            if (!has_program(program)) GTEST_SKIP() << "skipped: " << program << " is not installed";
        }
        display_ = std::make_unique<VirtualDisplay>(800, 600);
        error_file_ =
            (std::filesystem::temp_directory_path() / ("candela window " + std::to_string(getpid()) + ".txt")).string();
    }
    void TearDown() override { std::filesystem::remove(error_file_); }

    void open(const std::string& scene, const std::string& spp = "16", const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments{
            CANDELA_PROGRAM, scene, "--resolution", std::to_string(width) + "x" + std::to_string(height), "--spp", spp};
        arguments.insert(arguments.end(), more.begin(), more.end());
        candela_ = std::make_unique<Process>(
            arguments,
            std::vector<std::string>{"DISPLAY=" + display_->name(), "LIBGL_ALWAYS_SOFTWARE=1",
                                     "WAYLAND_DISPLAY=", "XDG_CONFIG_HOME=" + configuration_.path().string()},
            error_file_);
        const std::string id = display_->xdotool("search --sync --onlyvisible --name '^candela - '");
        ASSERT_FALSE(id.empty()) << "no window";
        window_ = std::stoul(id);
        display_->xdotool("windowfocus --sync " + id);
    }
    void act(const std::string& commands) { display_->xdotool(commands); }
    std::string on_window(const std::string& command) const {
        return command + " --window " + std::to_string(window_) + " ";
    }
    ImageRgba8 picture() const { return display_->capture(window_); }

    // The first picture that satisfies the condition; fails the test after a time.
    template <typename Condition>
    ImageRgba8 wait_for(const char* what, const Condition& condition, double timeout_s = 60) {
        const auto end = Clock::now() + std::chrono::duration<double>(timeout_s);
        ImageRgba8 now = picture();
        while (!condition(now)) {
            if (Clock::now() > end) {
                ADD_FAILURE() << "waited in vain for: " << what;
                return now;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(40));
            now = picture();
        }
        return now;
    }
    ImageRgba8 wait_for_change(const char* what, const ImageRgba8& from, double at_least = 2.0) {
        return wait_for(what,
                        [&](const ImageRgba8& now) { return says_done(now) && difference(from, now) > at_least; });
    }
    void wait_for_return(const char* what, const ImageRgba8& to) {
        wait_for(what, [&](const ImageRgba8& now) { return difference(to, now) == 0; });
    }
    // A picture that stays: panels take some frames to find their places.
    ImageRgba8 wait_for_rest() {
        ImageRgba8 last = picture();
        int same = 0;
        return wait_for("a picture that stays", [&](const ImageRgba8& now) {
            same = difference(last, now) == 0 ? same + 1 : 0;
            last = now;
            return same >= 8;
        });
    }
    std::string title() const { return display_->xdotool("getwindowname " + std::to_string(window_)); }
    bool wait_for_title(const std::string& wanted) const {
        for (int i = 0; i < 400 && title() != wanted; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return title() == wanted;
    }

    TemporaryFolder configuration_;  // nobody's settings are read or written
    std::unique_ptr<VirtualDisplay> display_;
    std::unique_ptr<Process> candela_;
    std::string error_file_;
    unsigned long window_ = 0;
};

TEST_F(WindowTest, OrbitDollyAndExposureChangeThePictureAndItReturns) {
    open(asset("cornell_box.glb"));
    const ImageRgba8 first = wait_for("the first converged picture", says_done);
    ASSERT_TRUE(says_done(first));
    ASSERT_EQ(first.width(), width);
    EXPECT_GT(brightness(first), 20);

    // Orbit by hand, back by the file's camera; its notice has to go first.
    act(on_window("mousemove") + "100 100 mousedown 1 mousemove_relative 30 0 mousemove_relative 30 10 mouseup 1");
    wait_for_change("an orbited view", first, 4.0);
    act("key c");
    wait_for_return("the file's camera", first);

    // Three steps nearer to the cursor and three back: the same view, its samples' noise apart.
    act(on_window("mousemove") + "200 120 click 4 click 4 click 4");
    const ImageRgba8 near_view = wait_for_change("a nearer view", first, 4.0);
    act(on_window("mousemove") + "200 120 click 5 click 5 click 5");
    wait_for("the way back", [&](const ImageRgba8& now) {
        return says_done(now) && difference(first, now) < 0.5 * difference(first, near_view);
    });
    act("key c");
    wait_for_return("the file's camera", first);

    // Exposure only changes how it is shown.
    act("key e");
    const ImageRgba8 brighter = wait_for_change("a brighter picture", first, 4.0);
    EXPECT_GT(brightness(brighter), brightness(first) + 4);
    act("key shift+e");
    wait_for_return("the old exposure", first);

    // A double-click re-centres.
    act(on_window("mousemove") + "150 60 click --repeat 2 --delay 60 1");
    wait_for_change("a re-centred view", first, 2.0);

    act("key ctrl+q");
    EXPECT_EQ(candela_->wait_for_exit(10), 0);
}

TEST_F(WindowTest, DroppedScenesOpenAndBrokenOnesLeaveTheOldOne) {
    open(asset("cornell_box.glb"));
    const ImageRgba8 first = wait_for("the first converged picture", says_done);
    ASSERT_TRUE(says_done(first));

    ASSERT_TRUE(display_->drop(window_, asset("glass_slab.glb")));
    EXPECT_TRUE(wait_for_title("candela - glass_slab.glb")) << title();
    // The old picture, done and with a notice over it, is not yet what we wait for.
    ImageRgba8 before;
    const ImageRgba8 dropped = wait_for("the dropped scene", [&](const ImageRgba8& now) {
        const bool rests = now.size() == before.size() && difference(before, now) == 0.0;
        before = now;
        return rests && says_done(now) && names_another_file(first, now) && difference(first, now) > 4.0;
    });

    const std::string broken = (std::filesystem::temp_directory_path() / "candela-window-broken.gltf").string();
    std::ofstream(broken) << R"({"asset": {"version": "2.0"}, "scenes": 3})";
    ASSERT_TRUE(display_->drop(window_, broken));
    const ImageRgba8 notice =
        wait_for("a notice over the old scene", [&](const ImageRgba8& now) { return difference(dropped, now) > 0.5; });
    EXPECT_LT(difference(dropped, notice), 80) << "the old scene has gone";
    EXPECT_EQ(title(), "candela - glass_slab.glb");
    act("key Escape");
    wait_for_return("the scene without the notice", dropped);
    std::filesystem::remove(broken);

    ASSERT_TRUE(display_->drop(window_, asset("cornell_box.glb")));
    wait_for_return("the first scene", first);
    act("key ctrl+q");
    EXPECT_EQ(candela_->wait_for_exit(10), 0);

    std::ifstream log(error_file_);
    const std::string text((std::istreambuf_iterator<char>(log)), std::istreambuf_iterator<char>());
    EXPECT_NE(text.find("/scenes"), std::string::npos) << text;
}

TEST_F(WindowTest, AResizedWindowRendersItsNewSizeAndReturns) {
    open(asset("cornell_box.glb"));
    const ImageRgba8 first = wait_for("the first converged picture", says_done);
    ASSERT_TRUE(says_done(first));
    const std::string id = std::to_string(window_);
    act("windowsize --sync " + id + " 560 200");
    const ImageRgba8 wide =
        wait_for("the new size", [](const ImageRgba8& now) { return now.width() == 560 && says_done(now); });
    // Nothing of the clear colour is left at the sides, where a picture of the old shape would not reach.
    EXPECT_NE(wide(2, 60), wide(2, 190));
    EXPECT_GT(brightness(wide), 20);
    act("windowsize --sync " + id + " 480 240");
    wait_for_return("the old size", first);
    act("windowsize --sync " + id + " 64 64");
    wait_for("a tiny window", [](const ImageRgba8& now) { return now.width() == 64; });
    act("windowsize --sync " + id + " 480 240");
    wait_for_return("the old size", first);
    act("key ctrl+q");
    EXPECT_EQ(candela_->wait_for_exit(10), 0);
}

TEST_F(WindowTest, ARecordedSessionComesBackWithoutAWindow) {
    const TemporaryFolder folder("candela window recording");
    const std::string recording = (folder.path() / "a session.rec").string();
    const std::string replayed = (folder.path() / "replayed.png").string();
    open(asset("cornell_box.glb"), "16", {"--record", recording});
    const ImageRgba8 first = wait_for("the first converged picture", says_done);
    act("key ctrl+4");
    act(on_window("mousemove") + "100 100 mousedown 1 mousemove_relative 30 0 mousemove_relative 30 10 mouseup 1");
    const ImageRgba8 orbited = wait_for_change("an orbited view", first, 4.0);
    // A slider of the panels: the field of view.
    act("key Tab");
    wait_for_change("the panels", orbited, 1.0);
    act(on_window("mousemove") + "250 121 sleep 0.2 mousedown 1 sleep 0.2 mousemove_relative 40 0 sleep 0.2 mouseup 1");
    act("key e");
    std::this_thread::sleep_for(std::chrono::seconds(1));
    const ImageRgba8 last = wait_for("the last picture", says_done);
    act("key ctrl+q");
    ASSERT_EQ(candela_->wait_for_exit(10), 0);

    EXPECT_FALSE(std::filesystem::exists(configuration_.path() / "candela" / "bookmarks.json"))
        << "bookmarks of a recording are its own";

    Process replay({CANDELA_PROGRAM, "screenshot", "--replay", recording, "-o", replayed, "--quiet"}, {}, error_file_);
    ASSERT_EQ(replay.wait_for_exit(60), 0);
    std::ifstream file(replayed, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    EXPECT_EQ(difference(last, decode_ldr(std::as_bytes(std::span(bytes)))), 0);
}

TEST_F(WindowTest, ItWatchesFilesFliesAndCopiesViews) {
    const TemporaryFolder folder("candela window watch");
    const std::filesystem::path scene = folder.path() / "box.glb";
    std::filesystem::copy(asset("cornell_box.glb"), scene);
    open(scene.string(), "16", {"--watch"});
    const ImageRgba8 first = wait_for("the first converged picture", says_done);
    const auto returns = [&](const ImageRgba8& now) { return says_done(now) && difference(first, now) < 3; };

    // The view goes out and comes back as text; between them keys fly.
    act("key ctrl+c");
    act("key f keydown w sleep 0.6 keyup w key f");
    wait_for_change("a view from farther in", first, 6.0);
    act("key ctrl+v");
    wait_for("the view that was copied", returns);

    std::filesystem::copy(asset("veach_plates.glb"), scene, std::filesystem::copy_options::overwrite_existing);
    wait_for_change("what is in the file now", first, 6.0);
    std::filesystem::copy(asset("cornell_box.glb"), scene, std::filesystem::copy_options::overwrite_existing);
    wait_for("what was in it before", returns);
    act("key ctrl+q");
    EXPECT_EQ(candela_->wait_for_exit(10), 0);
}

TEST_F(WindowTest, ItRemembersHowItLooked) {
    const std::filesystem::path settings = configuration_.path() / "candela" / "settings.json";
    const auto text = [](const std::filesystem::path& path) {
        std::ifstream file(path);
        return std::string((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    };
    // What is broken costs a line, and nothing else.
    std::filesystem::create_directories(settings.parent_path());
    std::ofstream(settings) << "{ \"theme\": ";
    open(asset("cornell_box.glb"), "2");
    const ImageRgba8 first = wait_for("the first converged picture", says_done);
    const std::string warning = text(error_file_);
    EXPECT_NE(warning.find("settings.json: it is no JSON"), std::string::npos) << warning;
    EXPECT_EQ(std::count(warning.begin(), warning.end(), '\n'), 1) << warning;
    // One after the other: what panels alone change is no sign that the picture is brighter.
    act("key Tab");
    wait_for_change("panels", first);
    const ImageRgba8 opened = wait_for_rest();
    act("key e");
    wait_for_change("a brighter picture", opened, 1.0);
    const ImageRgba8 changed = wait_for_rest();
    act("key ctrl+q");
    ASSERT_EQ(candela_->wait_for_exit(10), 0);
    EXPECT_NE(text(settings).find("\"exposure_ev\": 0.25"), std::string::npos) << text(settings);

    open(asset("cornell_box.glb"), "2");
    wait_for_return("what was there when the window closed", changed);
    EXPECT_EQ(text(error_file_), "");
    act("key ctrl+q");
    EXPECT_EQ(candela_->wait_for_exit(10), 0);
}

TEST_F(WindowTest, ConvergedItRests) {
    open(asset("cornell_box.glb"), "2");
    wait_for("the converged picture", says_done);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const double before = candela_->cpu_seconds();
    std::this_thread::sleep_for(std::chrono::seconds(2));
    EXPECT_LT(candela_->cpu_seconds() - before, 0.1);
}

TEST_F(WindowTest, AnInterruptEndsIt) {
    open(asset("cornell_box.glb"), "1000000");
    kill(candela_->pid(), SIGINT);
    EXPECT_EQ(candela_->wait_for_exit(10), 130);
}

TEST_F(WindowTest, WithoutADisplayItSaysSo) {
    Process process({CANDELA_PROGRAM, asset("cornell_box.glb")},
                    {"DISPLAY=", "WAYLAND_DISPLAY=", "XDG_CONFIG_HOME=" + configuration_.path().string()}, error_file_);
    EXPECT_EQ(process.wait_for_exit(10), 4);
    std::ifstream log(error_file_);
    std::string line;
    std::getline(log, line);
    EXPECT_NE(line.find("display"), std::string::npos) << line;
    EXPECT_FALSE(std::getline(log, line)) << line;
}

}  // namespace
}  // namespace candela::test
