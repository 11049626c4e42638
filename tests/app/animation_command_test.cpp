// SPDX-License-Identifier: MIT
// --animation, --at, --frames and --fps, tried on the program itself.
#include <csignal>
#include <fstream>
#include <thread>

#include <nlohmann/json.hpp>

#include "renderer/image/codec.h"
#include "tests/app/program.h"

namespace candela {
namespace {

using test::Outcome;
using test::run;

// A white quad before a camera that slides out of the picture within a second, by the animation "slide"; "still" keeps
// it where it is.
class AnimationCommand : public test::CommandLine {
  protected:
    void SetUp() override {
        const std::vector<float> numbers = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0,  // positions
                                            0,  1,                                                       // times
                                            0,  0,  0, 9, 0,  0,                                         // slide
                                            0,  0,  0, 0, 0,  0};                                        // still
        std::ofstream(folder_ / "data.bin", std::ios::binary)
            .write(reinterpret_cast<const char*>(numbers.data()),
                   static_cast<std::streamsize>(numbers.size() * sizeof(float)));
        nlohmann::json json = {
            {"asset", {{"version", "2.0"}}},
            {"buffers", {{{"uri", "data.bin"}, {"byteLength", numbers.size() * sizeof(float)}}}},
            {"bufferViews", {{{"buffer", 0}, {"byteLength", numbers.size() * sizeof(float)}}}},
            {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
            {"cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}}},
            {"nodes", {{{"mesh", 0}, {"name", "quad"}}, {{"camera", 0}, {"translation", {0, 0, 4}}}}},
            {"scenes", {{{"nodes", {0, 1}}}}},
            {"scene", 0}};
        size_t offset = 0;
        for (const auto& [type, count, components] :
             {std::tuple{"VEC3", 6, 3}, {"SCALAR", 2, 1}, {"VEC3", 2, 3}, {"VEC3", 2, 3}}) {
            json["accessors"].push_back(
                {{"bufferView", 0}, {"byteOffset", offset}, {"componentType", 5126}, {"count", count}, {"type", type}});
            offset += static_cast<size_t>(count * components) * sizeof(float);
        }
        for (const auto& [name, output] : {std::pair{"slide", 2}, {"still", 3}}) {
            json["animations"].push_back(
                {{"name", name},
                 {"samplers", {{{"input", 1}, {"output", output}}}},
                 {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
        }
        std::ofstream(folder_ / "scene.gltf") << json.dump();
    }

    std::string command(const std::string& name, const std::string& more) const {
        return "render " + file("scene.gltf") + " -o " + file(name) +
               " --sky 1,1,1 --background transparent --resolution 16x16 --spp 4 --quiet " + more;
    }
    // Whether the quad is in the picture.
    bool shows_quad(const std::string& name) const {
        const ImageRgba32f image = read_linear(folder_ / name);
        return image(8, 8).a > 0.5f;
    }
};

TEST_F(AnimationCommand, PosesByNameIndexAndTime) {
    const auto shows = [&](const std::string& more) {
        const Outcome outcome = run(command("a.exr", more));
        EXPECT_EQ(outcome.status, 0) << more << outcome.text;
        return shows_quad("a.exr");
    };
    EXPECT_TRUE(shows(""));
    EXPECT_TRUE(shows("--animation slide"));
    EXPECT_FALSE(shows("--animation slide --at 1"));
    EXPECT_FALSE(shows("--animation 0 --at 0.5"));
    EXPECT_TRUE(shows("--animation still --at 1"));
    EXPECT_FALSE(shows("--at 0.9")) << "the first animation unless one is named";
}

TEST_F(AnimationCommand, WrongUsageIsNamed) {
    const Outcome unknown = run(command("a.exr", "--animation jump"));
    EXPECT_EQ(unknown.status, 2);
    EXPECT_NE(unknown.text.find("0 \"slide\", 1 \"still\""), std::string::npos) << unknown.text;
    EXPECT_EQ(run(command("a.exr", "--animation 2")).status, 2);
    EXPECT_EQ(run(command("a.exr", "--frames 3")).status, 2);
    EXPECT_EQ(run(command("a.exr", "--frames 3:2")).status, 2);
    EXPECT_EQ(run(command("a.exr", "--frames -1:2")).status, 2);
    EXPECT_EQ(run(command("a.exr", "--frames 0:2 --at 1")).status, 2);
    EXPECT_EQ(run(command("a.exr", "--at -1")).status, 2);
    EXPECT_EQ(run(command("a.exr", "--fps 12")).status, 2) << "of which pictures?";
    const Outcome scene = run(command("a.exr", "--scene two"));
    EXPECT_EQ(scene.status, 2);
    EXPECT_NE(scene.text.find("--scene two: is no value that it takes"), std::string::npos) << scene.text;
    EXPECT_EQ(run("render -o " + file("a.exr") + " --at 1 --quiet").status, 2) << "the Cornell box has no animation";
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.exr"));
}

TEST_F(AnimationCommand, FramesAreNumberedPicturesOfTheirTimes) {
    const Outcome outcome = run(command("a.exr", "--frames 1:4 --fps 8 --stats " + file("stats.json")));
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    for (const char* name : {"a.exr", "a_0000.exr", "a_0005.exr"})
        EXPECT_FALSE(std::filesystem::exists(folder_ / name)) << name;
    // At 1/8 s the quad has moved by 9/8, at 4/8 s by 9/2.
    EXPECT_TRUE(std::filesystem::exists(folder_ / "a_0002.exr") && std::filesystem::exists(folder_ / "a_0003.exr"));
    EXPECT_FALSE(shows_quad("a_0004.exr"));
    // Each is the picture that --at makes.
    ASSERT_EQ(run(command("one.exr", "--at 0.125")).status, 0);
    EXPECT_EQ(read_linear(folder_ / "one.exr").pixels(), read_linear(folder_ / "a_0001.exr").pixels());
    ASSERT_EQ(run(command("two.exr", "--at 0.25")).status, 0);
    EXPECT_EQ(read_linear(folder_ / "two.exr").pixels(), read_linear(folder_ / "a_0002.exr").pixels());
    EXPECT_NE(read_linear(folder_ / "two.exr").pixels(), read_linear(folder_ / "one.exr").pixels());
    const nlohmann::json stats = nlohmann::json::parse(std::ifstream(folder_ / "stats.json"));
    EXPECT_EQ(stats["pictures"], 4);
    EXPECT_EQ(stats["samples"], 4 * 16 * 16 * 4);
}

TEST_F(AnimationCommand, InterruptedFramesKeepWhatIsDone) {
    const auto interrupted = [&](const std::string& name, const std::string& options) {
        return run(command(name + ".exr", options + " 2>&1 & pid=$!; for i in $(seq 200); do [ -e " +
                                              file(name + "_0002.exr") +
                                              " ] && break; sleep 0.05; done; kill -INT $pid; wait $pid"));
    };
    const Outcome turn = interrupted("t", "--turntable 10000");
    EXPECT_EQ(turn.status, 130) << turn.text;
    EXPECT_NE(turn.text.find(" of 10000 pictures\n"), std::string::npos) << "no --frames goes on: " << turn.text;
    const Outcome outcome = interrupted("a", "--frames 0:9999");
    EXPECT_EQ(outcome.status, 130) << outcome.text;
    EXPECT_NE(outcome.text.find(" of 10000 pictures; --frames "), std::string::npos) << outcome.text;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "a_0001.exr"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a_9999.exr"));
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
        if (entry.path().extension() != ".exr") continue;
        EXPECT_EQ(read_linear(entry.path()).width(), 16) << entry.path();
    }
}

TEST_F(AnimationCommand, InfoTellsWhatMoves) {
    const Outcome text = run("info " + file("scene.gltf"));
    EXPECT_NE(text.text.find("0: animation \"slide\", 1 s, 1 channels, drives 1 nodes (translation)"),
              std::string::npos)
        << text.text;
    EXPECT_EQ(text.text.find("warning"), std::string::npos) << text.text;
    const nlohmann::json facts = nlohmann::json::parse(run("info --json " + file("scene.gltf")).text);
    EXPECT_EQ(facts["animations"][1]["name"], "still");
    EXPECT_EQ(facts["animations"][1]["channels"][0]["drives"], "/nodes/0/translation");
    EXPECT_EQ(facts["animations"][1]["channels"][0]["name"], "quad");
    EXPECT_EQ(facts["skins"].size(), 0u);
}

}  // namespace
}  // namespace candela
