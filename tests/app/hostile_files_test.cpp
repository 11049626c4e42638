// SPDX-License-Identifier: MIT
// What a person meets who opens the wrong file or fills the disk: one line, the right exit status, soon, and no half
// file.
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "tests/app/program.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

using namespace test;

// Of all programs that this one has run.
double cpu_seconds_of_programs() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

class HostileFiles : public CommandLine {
  protected:
    void SetUp() override {
        std::ofstream(folder_ / "empty");
        std::ofstream(folder_ / "hole") << "glTF";
        std::filesystem::resize_file(folder_ / "hole", uint64_t{1} << 40);
        mkfifo((folder_ / "pipe").c_str(), 0600);
        std::filesystem::create_symlink("loop", folder_ / "loop");
        std::filesystem::create_directory(folder_ / "folder");
        std::ofstream(folder_ / "locked") << "{}";
        std::filesystem::permissions(folder_ / "locked", std::filesystem::perms::none);
    }
    std::set<std::string> files() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder_))
            names.insert(entry.path().filename());
        return names;
    }
};

const char* const no_files[] = {"missing", "empty", "hole", "pipe", "loop", "folder", "locked"};
const std::string tiny = " --resolution 16x12 --spp 1 ";

TEST_F(HostileFiles, ScenesThatCannotBeReadAreThree) {
    const std::set<std::string> before = files();
    for (const char* name : no_files) {
        for (const std::string& command : {"info " + file(name), "render " + file(name) + tiny + "-o " + file("a.png"),
                                           "screenshot " + file(name) + tiny + "-o " + file("a.png")}) {
            const Outcome outcome = run(command, "timeout 20 ");
            EXPECT_EQ(outcome.status, 3) << command << "\n" << outcome.text;
            EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
            EXPECT_NE(outcome.text.find((folder_ / name).string()), std::string::npos) << outcome.text;
        }
    }
    EXPECT_EQ(files(), before);
}

TEST_F(HostileFiles, EnvironmentsThatCannotBeReadAreThree) {
    for (const char* name : no_files) {
        const Outcome outcome =
            run("render --hdri " + file(name) + tiny + "--quiet -o " + file("a.png"), "timeout 20 ");
        EXPECT_EQ(outcome.status, 3) << name << "\n" << outcome.text;
        EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
        EXPECT_EQ(run("compare " + file(name) + " " + file(name), "timeout 20 ").status, 3) << name;
    }
}

// A limit on the size of files stands for the full disk: writing fails in the midst of the file.
TEST_F(HostileFiles, AFullDiskIsFour) {
    const std::string full = "trap '' XFSZ; ulimit -f 1; ";
    const std::set<std::string> before = files();
    for (const char* name : {"a.png", "a.exr", "a.hdr"}) {
        const Outcome outcome = run("render --resolution 160x120 --spp 1 --quiet -o " + file(name), full);
        EXPECT_EQ(outcome.status, 4) << outcome.text;
        EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
        EXPECT_NE(outcome.text.find((folder_ / name).string()), std::string::npos) << outcome.text;
    }
    EXPECT_EQ(run("screenshot --resolution 160x120 --spp 1 --quiet -o " + file("a.png"), full).status, 4);
    EXPECT_EQ(files(), before);

    // The picture fits, its record does not.
    EXPECT_EQ(
        run("render --resolution 8x4 --spp 1 --quiet -o " + file("a.hdr") + " --stats " + file("a.json"), full).status,
        4);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "a.hdr"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.json"));
}

TEST_F(HostileFiles, AFullStandardOutputIsFour) {
    for (const std::string& command :
         {std::string("info assets/cornell_box.glb"), std::string("info --json assets/cornell_box.glb"),
          std::string("--help"), "render" + tiny + "--quiet --stats - -o " + file("a.png")}) {
        EXPECT_EQ(run(command + " >/dev/full").status, 4) << command;
    }
}

TEST_F(HostileFiles, EachLimitIsAnOption) {
    for (const char* option :
         {"--limit-memory 0.00001", "--limit-json 0.0001", "--limit-nesting 2", "--limit-count 1"}) {
        const std::string name = std::string(option).substr(0, std::string(option).find(' '));
        for (const std::string& command :
             {"info assets/cornell_box.glb " + std::string(option),
              "render assets/cornell_box.glb --quiet -o " + file("a.png") + tiny + option}) {
            const Outcome outcome = run(command);
            EXPECT_EQ(outcome.status, 3) << command << "\n" << outcome.text;
            EXPECT_NE(outcome.text.find("; " + name + " raises it\n"), std::string::npos) << outcome.text;
        }
    }
    const Outcome side = run("render --hdri assets/sky.hdr --limit-image 2 --quiet -o " + file("a.png") + tiny);
    EXPECT_EQ(side.status, 3);
    EXPECT_NE(side.text.find("--limit-image raises it"), std::string::npos) << side.text;
    EXPECT_EQ(run("info assets/cornell_box.glb --limit-memory 1 --limit-json 1 --limit-nesting 1000 --limit-count 100 "
                  "--limit-instances 100 --limit-image 100")
                  .status,
              0);
    EXPECT_EQ(run("info assets/cornell_box.glb --limit-nesting 100000").status, 2);
    EXPECT_EQ(run("info assets/cornell_box.glb --limit-memory 0").status, 2);
}

// A chain of nodes is walked however long it is.
TEST_F(HostileFiles, NodesInALongChain) {
    constexpr int nodes = 100'000;
    std::string json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)";
    for (int i = 0; i + 1 < nodes; ++i)
        json += R"({"children":[)" + std::to_string(i + 1) + "]},";
    std::ofstream(folder_ / "chain.gltf") << json << "{}]}";
    for (const std::string& command :
         {"info " + file("chain.gltf") + " >" + file("out"), "info --json " + file("chain.gltf") + " >" + file("out"),
          "render " + file("chain.gltf") + tiny + "--quiet -o " + file("a.png")}) {
        const Outcome outcome = run(command);
        EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.text.substr(0, 1000);
    }
}

TEST_F(HostileFiles, SharedInvalidOnesAreThreeOrAPictureWithAWarning) {
    const std::filesystem::path folder = shared_data() / "invalid";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "skipped: no shared data";
    int refused = 0, shown = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::filesystem::path& scene = entry.path();
        if (scene.extension() != ".gltf" && scene.extension() != ".glb") continue;
        const double before = cpu_seconds_of_programs();
        const Outcome outcome = run("render '" + scene.string() + "' --sky 1,1,1 -o " + file("a.png") + tiny);
        EXPECT_LT(cpu_seconds_of_programs() - before, 2.0) << scene;
        if (outcome.status == 3) {
            ++refused;
            EXPECT_EQ(outcome.text.find("candela: " + scene.string() + ": "), 0u) << outcome.text;
            EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
        } else {
            ++shown;
            EXPECT_EQ(outcome.status, 0) << scene << "\n" << outcome.text;
            EXPECT_NE(outcome.text.find("warning: "), std::string::npos) << scene << "\n" << outcome.text;
            EXPECT_TRUE(std::filesystem::remove(folder_ / "a.png")) << scene;
        }
    }
    EXPECT_GT(refused, 40);
    EXPECT_GT(shown, 40);
}

}  // namespace
}  // namespace candela
