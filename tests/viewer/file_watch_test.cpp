// SPDX-License-Identifier: MIT
// Changes are told once, when the files have come to rest.
#include "app/viewer/file_watch.h"

#include <filesystem>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace candela {
namespace {

class Watching : public testing::Test {
  protected:
    std::string path(const char* name) const { return (folder_.path() / name).string(); }
    void write(const char* name, const std::string& text) { std::ofstream(path(name), std::ios::binary) << text; }
    // So many looks, a little more than one interval apart; how often a change was told.
    int look(int times) {
        int told = 0;
        for (int i = 0; i < times; ++i) {
            now_s_ += FileWatch::look_seconds + 0.01;
            told += watch_.changed(now_s_) ? 1 : 0;
        }
        return told;
    }

    test::TemporaryFolder folder_;
    FileWatch watch_;
    double now_s_ = 100;
};

TEST_F(Watching, AChangeIsToldOnceAndOnlyAtRest) {
    write("scene.gltf", "one");
    watch_.watch({path("scene.gltf")});
    EXPECT_EQ(look(5), 0);
    write("scene.gltf", "another");
    EXPECT_EQ(look(1), 0) << "it may still be written";
    write("scene.gltf", "another, longer");
    EXPECT_EQ(look(2), 0) << "it was still written";
    EXPECT_EQ(look(5), 1);
    EXPECT_EQ(look(5), 0);
}

TEST_F(Watching, AFileThatGoesAndComesAndOneThatIsPutInItsPlaceAreChanges) {
    write("a.bin", "one");
    watch_.watch({path("a.bin"), path("missing.png")});
    EXPECT_EQ(look(5), 0);
    write("missing.png", "now it is there");
    EXPECT_EQ(look(5), 1);
    std::filesystem::remove(path("a.bin"));
    EXPECT_EQ(look(5), 1);
    write("other", "one");
    std::filesystem::rename(path("other"), path("a.bin"));
    EXPECT_EQ(look(5), 1);
}

TEST_F(Watching, NoChangeIsLostWhileTheListIsRenewed) {
    write("scene.gltf", "one");
    watch_.watch({path("scene.gltf")});
    write("scene.gltf", "changed while it was read");
    watch_.watch({path("scene.gltf"), path("new.bin")});
    EXPECT_EQ(look(5), 1);
    watch_.watch({path("new.bin")});
    write("scene.gltf", "no longer watched");
    EXPECT_EQ(look(5), 0);
}

TEST_F(Watching, ItLooksNoMoreOftenThanItSays) {
    write("scene.gltf", "one");
    watch_.watch({path("scene.gltf")});
    EXPECT_FALSE(watch_.changed(now_s_));
    write("scene.gltf", "another");
    EXPECT_FALSE(watch_.changed(now_s_ + 0.5 * FileWatch::look_seconds));
    EXPECT_EQ(look(1), 0) << "the change was seen too early to be at rest now";
}

}  // namespace
}  // namespace candela
