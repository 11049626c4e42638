// SPDX-License-Identifier: MIT
// The open dialog, with programs of the test's own in the place of zenity and kdialog.
#include "app/viewer/file_dialog.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/support/temporary_folder.h"

namespace candela {
namespace {

class Dialogs : public testing::Test {
  protected:
    void SetUp() override {
        const char* path = std::getenv("PATH");
        path_before_ = path != nullptr ? path : "";
    }
    void TearDown() override { setenv("PATH", path_before_.c_str(), 1); }

    void make_program(const std::string& name, const std::string& script) {
        const std::filesystem::path program = folder_.path() / name;
        std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
        std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    }
    std::vector<std::string> command(const char* desktop = nullptr) {
        return dialog_command(DialogPurpose::scene, "/scenes", folder_.path().c_str(), desktop);
    }
    // What the dialog answers.
    std::optional<std::string> answer() {
        setenv("PATH", folder_.path().c_str(), 1);
        FileDialog dialog;
        EXPECT_TRUE(dialog.open(DialogPurpose::scene, "/sce nes"));
        std::optional<std::string> out;
        for (int i = 0; i < 5000 && dialog.is_open() && !out; ++i) {
            out = dialog.take();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        EXPECT_FALSE(dialog.is_open());
        return out;
    }

    test::TemporaryFolder folder_{"candela dialogs"};
    std::string path_before_;
};

TEST_F(Dialogs, TheDesktopsOwnComesFirst) {
    EXPECT_TRUE(command().empty());
    setenv("PATH", folder_.path().c_str(), 1);
    EXPECT_FALSE(FileDialog().open(DialogPurpose::scene, "")) << "there is none";
    make_program("kdialog", "");
    EXPECT_EQ(command().front(), (folder_.path() / "kdialog").string());
    make_program("zenity", "");
    EXPECT_EQ(command("GNOME").front(), (folder_.path() / "zenity").string());
    EXPECT_EQ(command("KDE").front(), (folder_.path() / "kdialog").string());
    EXPECT_TRUE(dialog_command(DialogPurpose::scene, "", ".:relative:", nullptr).empty());
}

// A file whose extension is in capitals is chosen among all of them.
TEST_F(Dialogs, EachOffersItsKindsAndAllFiles) {
    make_program("kdialog", "");
    EXPECT_EQ(command().back(), "scenes and environments (*.gltf *.glb *.hdr *.exr)|all files (*)");
    make_program("zenity", "");
    const std::vector<std::string> words = command();
    EXPECT_EQ(words[words.size() - 2], "--file-filter=scenes and environments | *.gltf *.glb *.hdr *.exr");
    EXPECT_EQ(words.back(), "--file-filter=all files | *");
}

TEST_F(Dialogs, TheFileThatWasChosenComesBackWhateverItsName) {
    // No shell sees the words: what it would run stays a name.
    make_program(
        "zenity",
        R"(for word; do case $word in --filename=*) echo "${word#--filename=}a \$(b) 'c' ü.glb";; esac; done)");
    EXPECT_EQ(answer(), "/sce nes/a $(b) 'c' ü.glb");
}

TEST_F(Dialogs, WhoChoosesNothingOpensNothing) {
    make_program("zenity", "echo /some/file; exit 1");
    EXPECT_EQ(answer(), std::nullopt);
    make_program("zenity", "exit 0");
    EXPECT_EQ(answer(), std::nullopt);
}

TEST_F(Dialogs, AWindowThatClosesDoesNotWaitForTheDialog) {
    make_program("zenity", "exec /bin/sleep 60");
    setenv("PATH", folder_.path().c_str(), 1);
    const auto begin = std::chrono::steady_clock::now();
    {
        FileDialog dialog;
        ASSERT_TRUE(dialog.open(DialogPurpose::reference, ""));
        EXPECT_TRUE(dialog.open(DialogPurpose::scene, "")) << "the one that is open is enough";
        EXPECT_EQ(dialog.purpose(), DialogPurpose::reference);
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

}  // namespace
}  // namespace candela
