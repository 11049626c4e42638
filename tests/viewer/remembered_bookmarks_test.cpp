// SPDX-License-Identifier: MIT
// Bookmarks that outlive the window.
#include "app/viewer/remembered_bookmarks.h"

#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "app/exit_status.h"
#include "app/viewer/configuration_file.h"
#include "app/viewer/desktop.h"
#include "app/viewer/view_text.h"
#include "tests/support/temporary_folder.h"
#include "tests/viewer/viewer_fixture.h"

namespace candela {
namespace {

class RememberedBookmarksTest : public test::ViewerTest {
  protected:
    std::filesystem::path file() const { return folder_.path() / "candela" / "bookmarks.json"; }
    RememberedBookmarks read() { return read_bookmarks(file(), warning_); }
    void put(const std::string& text) {
        std::filesystem::create_directories(file().parent_path());
        std::ofstream(file(), std::ios::binary) << text;
    }
    size_t files_beside() const {
        return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(file().parent_path()), {}));
    }
    // A window on that scene.
    void open(const std::string& scene, const std::filesystem::path& bookmarks_file) {
        desktop_.reset();
        viewer_.reset();
        context_.reset();
        start(test::options_for(scene, 1));
        desktop_ = std::make_unique<Desktop>(Desktop::Options{{},
                                                              {},
                                                              false,
                                                              [](const std::string&) {},
                                                              [&](const std::string& line) { said_ += line; },
                                                              bookmarks_file},
                                             *viewer_, test::extent);
        desktop_->serve(*viewer_, test::extent);
    }
    void store(Key digit) {
        press(digit, {.ctrl = true});
        desktop_->serve(*viewer_, test::extent);
    }

    test::TemporaryFolder folder_;
    std::string warning_, said_;
    std::unique_ptr<Desktop> desktop_;
};

Bookmark some_view() {
    Bookmark out;
    out.view.camera.world_from_camera = look_at(Vec3(1, 2, 3), Vec3(0, 0.5f, 0), Vec3(0, 1, 0));
    out.view.pivot = Vec3(0, 0.5f, 0);
    out.view.camera.aperture_diameter_m = 0.02f;
    out.view.camera.focus_distance_m = 2;
    out.tone = {-1.5f, ToneCurve::agx};
    return out;
}

TEST_F(RememberedBookmarksTest, ComeBackAsTheyWereWritten) {
    Bookmarks now;
    now[0] = now[7] = some_view();
    now[7]->view.camera.aperture_diameter_m = 0.5f;
    RememberedBookmarks all;
    add_changes(all, "/scenes/zwei Räume.glb", {}, now);
    write_bookmarks(file(), all);
    const RememberedBookmarks read_again = read();
    EXPECT_EQ(warning_, "");
    ASSERT_EQ(read_again.size(), 1u);
    EXPECT_EQ(read_again[0].scene, "/scenes/zwei Räume.glb");
    const Bookmarks there = bookmarks_of(read_again, "/scenes/zwei Räume.glb", {});
    for (size_t digit = 0; digit < there.size(); ++digit) {
        ASSERT_EQ(there[digit].has_value(), now[digit].has_value()) << digit;
        if (!now[digit]) continue;
        EXPECT_EQ(read_again[0].views.at(digit), text_of(*now[digit]));
    }
    EXPECT_EQ(there[7]->view.camera.aperture_diameter_m, 0.5f);
    EXPECT_EQ(there[0]->tone, now[0]->tone);
    EXPECT_FALSE(bookmarks_of(read_again, "/scenes/other.glb", {})[0]);
    EXPECT_EQ(files_beside(), 1u) << "nothing but the file is left in its folder";
}

TEST_F(RememberedBookmarksTest, ABrokenFileIsOneWarning) {
    const std::string view = text_of(some_view());
    const auto document = [](const std::string& scene) { return "{\"scenes\": [" + scene + "]}"; };
    for (const std::string& text :
         {std::string(), std::string("{"), std::string("[]"), std::string("\xff\xfe"), std::string("{\"scenes\": 3}"),
          document("7"), document(R"({"scene": "/a.glb"})"), document(R"({"scene": 3, "views": {}})"),
          document(R"({"scene": "/a.glb", "views": []})"),
          document(R"({"scene": "/a.glb", "views": {"10": ")" + view + "\"}}"),
          document(R"({"scene": "/a.glb", "views": {"x": ")" + view + "\"}}"),
          document(R"({"scene": "/a.glb", "views": {"1": 5}})"),
          document(R"({"scene": "/a.glb", "views": {"1": "--eye 1,2,3"}})"),
          document(R"({"scene": "/a.glb", "views": {"1": "--eye 1,2,3 --target 1,2,nan"}})"),
          std::string(2 << 20, ' ') + document("")}) {
        put(text);
        EXPECT_TRUE(read().empty()) << text.substr(0, 80);
        EXPECT_NE(warning_.find("bookmarks.json: "), std::string::npos) << text.substr(0, 80);
        EXPECT_NE(warning_.find("bookmarks.json.broken"), std::string::npos);
        EXPECT_EQ(warning_.find('\n'), std::string::npos) << warning_;
    }
    put(document(R"({"scene": "/a.glb", "views": {"1": ")" + view + R"("}, "of a newer version": 1})"));
    EXPECT_EQ(read().size(), 1u);
    EXPECT_EQ(warning_, "");
    std::filesystem::remove(file());
    EXPECT_TRUE(read().empty());
    EXPECT_EQ(warning_, "") << "no file is no mistake";
}

TEST_F(RememberedBookmarksTest, TheLastScenesAreKeptAndOnlyChangesAreTaken) {
    RememberedBookmarks all;
    Bookmarks none, one, other;
    one[1] = other[2] = some_view();
    for (size_t i = 0; i < most_bookmarked_scenes + 5; ++i)
        add_changes(all, "/" + std::to_string(i), none, one);
    EXPECT_EQ(all.size(), most_bookmarked_scenes);
    EXPECT_EQ(all.front().scene, "/" + std::to_string(most_bookmarked_scenes + 4));
    // Another window stored a view that this one does not know.
    add_changes(all, "/100", none, other);
    EXPECT_EQ(all.front().scene, "/100");
    EXPECT_EQ(all.front().views.size(), 2u);
    // Nor is what it stored in the meantime taken back.
    Bookmarks mine = one, theirs = one;
    theirs[1]->tone.exposure_ev = 3;
    mine[4] = some_view();
    add_changes(all, "/100", one, theirs);
    add_changes(all, "/100", one, mine);
    EXPECT_EQ(all.front().views.at(1), text_of(*theirs[1]));
    EXPECT_EQ(all.front().views.count(4), 1u);
    EXPECT_EQ(all.size(), most_bookmarked_scenes);
}

TEST_F(RememberedBookmarksTest, TheNextWindowHasThem) {
    open("assets/cornell_box.glb", file());
    EXPECT_FALSE(std::filesystem::exists(file())) << "nothing was stored";
    press(Key::digit_9);
    press(Key::e);
    const OrbitView view = model().view;
    store(Key::digit_4);
    EXPECT_EQ(files_beside(), 1u);

    // Another scene has none of it, and the file's other scenes go on.
    open("assets/veach_plates.glb", file());
    EXPECT_FALSE(model().bookmarks[4]);
    store(Key::digit_1);
    EXPECT_EQ(read().size(), 2u);

    open("assets/../assets/cornell_box.glb", file());
    EXPECT_TRUE(model().bookmarks[4]);
    press(Key::digit_4, {.shift = true});
    EXPECT_EQ(model().view.camera.projection, Projection::orthographic);
    EXPECT_LT(glm::distance(model().view.camera.position(), view.camera.position()), 1e-4f);
    EXPECT_FLOAT_EQ(model().display.tone.exposure_ev, 0.25f);
    // Two scenes in one window, one after the other.
    viewer_->open("assets/veach_plates.glb");
    finish();
    desktop_->serve(*viewer_, test::extent);
    EXPECT_FALSE(model().bookmarks[4]);
    EXPECT_TRUE(model().bookmarks[1]);
    EXPECT_EQ(read().size(), 2u) << "to open a scene changes nothing";
    EXPECT_EQ(said_, "");
}

TEST_F(RememberedBookmarksTest, AFullDiskLeavesWhatWasThere) {
    RememberedBookmarks all;
    Bookmarks now;
    now[3] = some_view();
    add_changes(all, "/scenes/one.glb", {}, now);
    write_bookmarks(file(), all);
    add_changes(all, "/scenes/two.glb", {}, now);
    // No file may grow beyond 100 bytes.
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{100, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    EXPECT_THROW(write_bookmarks(file(), all), CommandError);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(read().size(), 1u);
    EXPECT_EQ(files_beside(), 1u);
}

TEST_F(RememberedBookmarksTest, WhereTheyCannotBeKeptTheWindowGoesOn) {
    // Broken: said once, kept aside when another is written.
    put("{");
    open("assets/cornell_box.glb", file());
    EXPECT_NE(said_.find("it is no JSON"), std::string::npos) << said_;
    store(Key::digit_4);
    EXPECT_TRUE(std::filesystem::exists(file().string() + ".broken"));
    EXPECT_EQ(read().size(), 1u);
    // A folder that cannot be made: one line, and the bookmark holds as long as the window.
    said_.clear();
    std::ofstream(folder_.path() / "blocked") << "a file where the folder should be";
    open("assets/cornell_box.glb", folder_.path() / "blocked" / "bookmarks.json");
    store(Key::digit_1);
    EXPECT_NE(said_.find("the bookmarks cannot be written"), std::string::npos) << said_;
    said_.clear();
    store(Key::digit_2);
    EXPECT_EQ(said_, "");
    EXPECT_TRUE(model().bookmarks[1] && model().bookmarks[2]);
    // No file: nothing is read or written, as in recordings.
    open("assets/cornell_box.glb", {});
    EXPECT_FALSE(model().bookmarks[4]);
    store(Key::digit_3);
    EXPECT_EQ(read()[0].views.count(3), 0u);
}

}  // namespace
}  // namespace candela
