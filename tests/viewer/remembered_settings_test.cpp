// SPDX-License-Identifier: MIT
// What the window remembers, and that a damaged file only costs what was in it.
#include "app/viewer/remembered_settings.h"

#include <fstream>

#include "app/exit_status.h"
#include "app/viewer/configuration_file.h"
#include "tests/support/temporary_folder.h"

namespace candela {
namespace {

class Remembered : public testing::Test {
  protected:
    std::filesystem::path file() const { return folder_.path() / "candela" / "settings.json"; }
    RememberedSettings read() { return read_settings(file(), warning_); }
    void put(const std::string& text) {
        std::filesystem::create_directories(file().parent_path());
        std::ofstream(file(), std::ios::binary) << text;
    }

    test::TemporaryFolder folder_;
    std::string warning_;
};

RememberedSettings some_settings() {
    RememberedSettings out;
    out.tone = {-1.25f, ToneCurve::agx};
    out.style = {Theme::light, 1.5f};
    out.panels = out.statistics = true;
    out.window = Vec2u(1440, 900);
    out.recent = {"/scenes/zwei Räume.glb", "/scenes/one.gltf"};
    return out;
}

TEST_F(Remembered, ComesBackAsItWasWritten) {
    const RememberedSettings written = some_settings();
    write_settings(file(), written);
    const RememberedSettings read_again = read();
    EXPECT_EQ(warning_, "");
    EXPECT_EQ(words_of(read_again), words_of(written));
    EXPECT_EQ(words_of(read_again),
              (std::vector<std::string>{"--exposure", "-1.25", "--tonemap", "agx", "--theme", "light", "--ui-scale",
                                        "1.5", "--open", "panels,statistics"}));
    EXPECT_EQ(read_again.window, written.window);
    EXPECT_EQ(read_again.recent, written.recent);
    // Nothing but the file is left in its folder.
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file().parent_path()), {}), 1);
}

TEST_F(Remembered, WithoutAFileThereAreDefaultsAndNoWord) {
    EXPECT_TRUE(words_of(read()).empty());
    EXPECT_EQ(warning_, "");
}

TEST_F(Remembered, ABrokenFileIsOneWarningAndDefaults) {
    for (const char* text : {"", "{", "[]", "\xff\xfe", R"({"exposure_ev": "much"})", R"({"exposure_ev": 1e9})",
                             R"({"exposure_ev": null})", R"({"tone_curve": "kodak"})", R"({"tone_curve": 3})",
                             R"({"theme": "pink"})", R"({"ui_scale": 0})", R"({"ui_scale": -2})", R"({"panels": 1})",
                             R"({"window": [0, 0]})", R"({"window": [1280]})", R"({"window": [1280, 1e12]})",
                             R"({"window": "large"})", R"({"recent": {"a": 1}})", R"({"recent": ["/a.glb", 7]})"}) {
        put(text);
        const RememberedSettings found = read();
        EXPECT_TRUE(words_of(found).empty() && !found.window && found.recent.empty()) << text;
        EXPECT_NE(warning_.find("settings.json: "), std::string::npos) << text << ": " << warning_;
        EXPECT_EQ(warning_.find('\n'), std::string::npos) << warning_;
    }
    keep_broken(file());
    EXPECT_FALSE(std::filesystem::exists(file()));
    EXPECT_TRUE(std::filesystem::exists(file().string() + ".broken"));
    put(std::string(1 << 20, ' ') + "{}");
    EXPECT_TRUE(words_of(read()).empty());
    EXPECT_NE(warning_, "");
    std::filesystem::remove(file());
    std::filesystem::create_directories(file());
    EXPECT_TRUE(words_of(read()).empty());
    EXPECT_NE(warning_, "") << "a folder stands where the file should";
}

TEST_F(Remembered, WhatANewerVersionWroteIsNoHindrance) {
    put(R"({"theme": "light", "moon": {"phase": [1, 2]}})");
    EXPECT_EQ(read().style.theme, Theme::light);
    EXPECT_EQ(warning_, "");
}

TEST_F(Remembered, WhereItCannotBeWrittenNothingIsLeft) {
    std::ofstream(folder_.path() / "candela") << "a file where the folder should be";
    EXPECT_THROW(write_settings(file(), {}), CommandError);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

TEST_F(Remembered, TheFolderIsTheConfiguredOne) {
    const char* configured = std::getenv("XDG_CONFIG_HOME");
    const std::optional<std::string> before =
        configured != nullptr ? std::optional<std::string>(configured) : std::nullopt;
    setenv("XDG_CONFIG_HOME", folder_.path().c_str(), 1);
    EXPECT_EQ(settings_path(), file());
    setenv("XDG_CONFIG_HOME", "relative/is/ignored", 1);
    EXPECT_NE(settings_path().string().find("/.config/candela/settings.json"), std::string::npos);
    if (before) {
        setenv("XDG_CONFIG_HOME", before->c_str(), 1);
    } else {
        unsetenv("XDG_CONFIG_HOME");
    }
}

TEST(RememberedChanges, OnlyWhatChangedInTheWindowIsRemembered) {
    RememberedSettings stored = some_settings(), at_start = stored;
    // Asked for on the command line, this once.
    at_start.tone.exposure_ev = 3;
    at_start.style.theme = Theme::dark;
    at_start.window = Vec2u(320, 200);
    RememberedSettings now = at_start;
    now.tone.curve = ToneCurve::linear;
    now.panels = false;
    const RememberedSettings out = with_changes(stored, at_start, now);
    EXPECT_EQ(out.tone.exposure_ev, stored.tone.exposure_ev);
    EXPECT_EQ(out.style, stored.style);
    EXPECT_EQ(out.window, stored.window);
    EXPECT_EQ(out.tone.curve, ToneCurve::linear);
    EXPECT_FALSE(out.panels);
    EXPECT_TRUE(out.statistics);
    EXPECT_EQ(out.recent, stored.recent);
}

TEST(RecentFiles, TheLastOpenedComesFirstAndOnlyOnce) {
    std::vector<std::string> recent;
    for (int i = 0; i < 15; ++i)
        add_recent(recent, "/scenes/" + std::to_string(i) + ".glb");
    ASSERT_EQ(recent.size(), 10u);
    EXPECT_EQ(recent.front(), "/scenes/14.glb");
    add_recent(recent, "/scenes/rooms/../9.glb");
    EXPECT_EQ(recent.front(), "/scenes/9.glb");
    EXPECT_EQ(std::count(recent.begin(), recent.end(), "/scenes/9.glb"), 1);
    EXPECT_EQ(recent.size(), 10u);
    add_recent(recent, "here.glb");
    EXPECT_EQ(recent.front(), (std::filesystem::current_path() / "here.glb").string());
    add_recent(recent, "/scenes/no\xfftext.glb");
    EXPECT_EQ(recent.front(), (std::filesystem::current_path() / "here.glb").string())
        << "what the file cannot hold is left out";
}

}  // namespace
}  // namespace candela
