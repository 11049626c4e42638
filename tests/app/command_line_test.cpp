// SPDX-License-Identifier: MIT
// The contract of the command line, tried on the program itself.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "renderer/image/codec.h"
#include "tests/app/program.h"

namespace candela {
namespace {

using namespace test;

const std::string tiny = " --resolution 24x16 --spp 4 --quiet ";

TEST_F(CommandLine, RendersEveryFormatAndRecordsTheRun) {
    for (const char* name : {"a.png", "a.exr", "a.hdr"}) {
        const Outcome outcome = run("render -o " + file(name) + tiny);
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        EXPECT_TRUE(std::filesystem::exists(folder_ / name));
    }
    const Outcome stats = run("render -o " + file("b.exr") + tiny +
                              "--stats - --aov albedo,normal,depth,position,uv,material,instance,samples,variance,"
                              "error,rays,bounces");
    EXPECT_EQ(stats.status, 0) << stats.text;
    for (const char* key : {"candela",        "scene",
                            "resolution",     "spp",
                            "seed",           "threads",
                            "triangles",      "instances",
                            "lights",         "seconds",
                            "load",           "build",
                            "render",         "write",
                            "first_frame",    "samples",
                            "rays",           "camera",
                            "bounce",         "shadow",
                            "relative_error", "relative_error_95",
                            "non_finite",     "biased",
                            "peak_rss_bytes", "image_sha256",
                            "warnings",       "command"}) {
        EXPECT_NE(stats.text.find("\"" + std::string(key) + "\":"), std::string::npos) << key;
    }
    EXPECT_NE(stats.text.find("\"non_finite\": 0"), std::string::npos);
    std::ifstream layers(folder_ / "b.exr", std::ios::binary);
    const std::string header(std::istreambuf_iterator<char>(layers), {});
    for (const char* name : {"albedo.R", "variance.V", "error.V", "rays.V", "bounces.V"})
        EXPECT_NE(header.find(name), std::string::npos) << name;
}

TEST_F(CommandLine, ChoicesAreNamed) {
    const Outcome outcome = run("render -o " + file("a.png") + tiny + "--estimator foo");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.text.find("foo is not one of bsdf|light|mis"), std::string::npos) << outcome.text;
    EXPECT_NE(run("render --help").text.find("--estimator bsdf|light|mis"), std::string::npos);
}

TEST_F(CommandLine, OnlyTheWindowKnowsOfSettings) {
    const std::filesystem::path settings = folder_ / "candela" / "settings.json";
    std::filesystem::create_directories(settings.parent_path());
    std::ofstream(settings) << R"({"theme": "light", "exposure_ev": 3, "panels": true, "what": )";
    const std::string configured = file("");
    const Outcome with = run("screenshot -o " + file("a.png") + tiny, "", configured);
    EXPECT_EQ(with.status, 0);
    EXPECT_EQ(with.text, "");
    EXPECT_EQ(run("info assets/cornell_box.glb", "", configured).text.find("settings"), std::string::npos);
    run("screenshot -o " + file("b.png") + tiny);
    run("screenshot -o " + file("c.png") + tiny + "--theme light --exposure 3");
    const auto bytes = [&](const char* name) {
        std::ifstream picture(folder_ / name, std::ios::binary);
        const std::string all((std::istreambuf_iterator<char>(picture)), std::istreambuf_iterator<char>());
        return decode_ldr(std::as_bytes(std::span(all)));
    };
    EXPECT_EQ(bytes("a.png").pixels(), bytes("b.png").pixels());
    EXPECT_NE(bytes("a.png").pixels(), bytes("c.png").pixels());
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(settings.parent_path()), {}), 1);
}

TEST_F(CommandLine, ATurntableGoesAroundTheTarget) {
    const Outcome outcome = run("render assets/veach_plates.glb -o " + file("t.exr") + tiny +
                                "--turntable 4 --eye 0,2,9 --target 0,2,0 --filter box");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    for (const char* name : {"t_0000.exr", "t_0001.exr", "t_0002.exr", "t_0003.exr"})
        ASSERT_TRUE(std::filesystem::exists(folder_ / name)) << name;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "t_0004.exr"));
    // The same views by hand.
    run("render assets/veach_plates.glb -o " + file("0.exr") + tiny + "--eye 0,2,9 --target 0,2,0 --filter box");
    run("render assets/veach_plates.glb -o " + file("1.exr") + tiny + "--eye 9,2,0 --target 0,2,0 --filter box");
    EXPECT_EQ(read_linear(folder_ / "t_0000.exr").pixels(), read_linear(folder_ / "0.exr").pixels());
    const Outcome same = run("compare --max-rmse 0.02 " + file("t_0001.exr") + " " + file("1.exr"));
    EXPECT_EQ(same.status, 0) << same.text;
    const Outcome other = run("compare --max-rmse 0.02 " + file("t_0003.exr") + " " + file("1.exr"));
    EXPECT_EQ(other.status, 1) << other.text;
}

TEST_F(CommandLine, ThePictureDoesNotDependOnThreads) {
    run("render -o " + file("a.exr") + tiny + "-t 1");
    run("render -o " + file("b.exr") + tiny + "-t 3");
    EXPECT_EQ(read_linear(folder_ / "a.exr").pixels(), read_linear(folder_ / "b.exr").pixels());
    const Outcome compared = run("compare --max-rmse 0 " + file("a.exr") + " " + file("b.exr"));
    EXPECT_EQ(compared.status, 0) << compared.text;
}

TEST_F(CommandLine, AReplayedPictureIsTheSameFileForAnyThreads) {
    const std::string recording = " --replay tests/screenshots/recordings/cornell_box_orbited.rec --quiet ";
    const auto contents = [&](const std::string& name, const std::string& more) {
        const Outcome outcome = run("screenshot" + recording + more + " -o " + file(name));
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        std::ifstream picture(folder_ / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(picture), {});
    };
    const std::string first = contents("a.png", "-t 1");
    EXPECT_TRUE(first == contents("b.png", "-t 3"));
    EXPECT_TRUE(first != contents("c.png", "--seed 1")) << "what stands on the command line does not count";
}

TEST_F(CommandLine, ARecordingThatIsNoneSaysWhereAndWhy) {
    std::ofstream(folder_ / "a.rec") << "candela recording 1\narguments assets/cornell_box.glb --sp 4\nwindow 8 8\n";
    std::ofstream(folder_ / "b.rec") << "candela recording 1\narguments missing.glb\nwindow 8 8\n";
    const std::tuple<std::string, int, std::string> cases[] = {
        {"README.md", 3, "README.md:1: a recording begins with"},
        {"missing.rec", 3, "missing.rec: there is no such recording"},
        {file("a.rec"), 3, "a.rec:2: "},
        {file("b.rec"), 3, "missing.glb: "},
        {file("b.rec") + " assets/cornell_box.glb", 2, "leave assets/cornell_box.glb out"}};
    for (const auto& [recording, status, reason] : cases) {
        const Outcome outcome = run("screenshot --quiet -o " + file("a.png") + " --replay " + recording);
        EXPECT_EQ(outcome.status, status) << recording;
        EXPECT_NE(outcome.text.find(reason), std::string::npos) << outcome.text;
        EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
    }
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.png"));
}

TEST_F(CommandLine, InfoSaysWhatTheFileHolds) {
    // A chain of 100 nodes, a metadata packet, and an extension of every kind.
    std::string nodes = "{\"name\": \"root\", \"children\": [1]}";
    for (int i = 1; i < 100; ++i)
        nodes += ", {\"children\": [" + std::to_string(i + 1) + "]}";
    nodes += ", {\"name\": \"leaf\"}";
    const auto write = [&](const std::string& required) {
        std::ofstream(folder_ / "a.gltf")
            << R"({"asset": {"version": "2.0", "generator": "a test", "extensions": {"KHR_xmp_json_ld": {"packet": 0}}},
            "extensionsUsed": ["KHR_xmp_json_ld", "KHR_materials_iridescence", "KHR_materials_variants", "EXT_new"],
            "extensionsRequired": [)" +
                   required + R"(],
            "extensions": {"KHR_xmp_json_ld": {"packets": [{"@context": {"dc": "x"},
                    "dc:title": {"@type": "rdf:Alt", "rdf:_1": {"@language": "en", "@value": "A title"}},
                    "dc:creator": {"@list": ["One", "Two"]}}]},
                "KHR_materials_variants": {"variants": [{"name": "red"}]}},
            "nodes": [)" +
                   nodes + R"(], "scenes": [{"name": "first", "nodes": [0]}, {"nodes": []}], "scene": 0})";
    };
    write("");
    const Outcome text = run("info " + file("a.gltf"));
    EXPECT_EQ(text.status, 0) << text.text;
    for (const char* line :
         {"KHR_xmp_json_ld: ignored (metadata", "KHR_materials_iridescence: approximated (",
          "EXT_new: ignored (unknown", "KHR_materials_variants: rendered", "/asset dc:title: A title",
          "/asset dc:creator: One, Two", "/asset generator: a test", "0: variant \"red\"", "0: scene \"first\", shown",
          "1: scene 1\n", "  root\n    node 1\n", "and 61 more; -v lists all", "memory       about"}) {
        EXPECT_NE(text.text.find(line), std::string::npos) << line << " in\n" << text.text;
    }
    EXPECT_EQ(text.text.find("node 40\n"), std::string::npos) << "the list is cut";
    EXPECT_NE(run("info -v " + file("a.gltf")).text.find("leaf"), std::string::npos);
    EXPECT_NE(run("info --variant red " + file("a.gltf")).text.find("\"red\", shown"), std::string::npos);
    EXPECT_NE(run("info --scene 1 " + file("a.gltf")).text.find("101 nodes are not in this scene"), std::string::npos);

    const Outcome json = run("info --json " + file("a.gltf"));
    for (const char* key : {"scene", "scenes", "active_scene", "variants", "active_variant", "counts", "triangles",
                            "placed_triangles", "strokes", "vertex_bytes", "estimated_bytes", "nodes", "meshes",
                            "cameras", "lights", "animations", "extensions", "metadata", "warnings"}) {
        EXPECT_NE(json.text.find("\n  \"" + std::string(key) + "\":"), std::string::npos) << key;
    }

    // What is refused is listed with the rest, but the file still cannot be read.
    write("\"EXT_new\"");
    const Outcome refused = run("info " + file("a.gltf"));
    EXPECT_EQ(refused.status, 3);
    EXPECT_NE(refused.text.find("EXT_new: refused (required, but not supported), required"), std::string::npos)
        << refused.text;
    EXPECT_NE(refused.text.find("the required extension EXT_new is not supported"), std::string::npos);
    EXPECT_EQ(run("render -o " + file("a.png") + tiny + file("a.gltf")).status, 3);
}

TEST_F(CommandLine, WrongUsageIsTwo) {
    for (const std::string& arguments : {std::string("frobnicate"),
                                         std::string("render"),
                                         "render -o " + file("a.bmp"),
                                         "render -o " + file("a.png") + " --spp x",
                                         "render -o " + file("a.png") + " --resolution 0x10",
                                         "render -o " + file("a.png") + " --eye 1,2",
                                         "render -o " + file("a.png") + " --camera nobody",
                                         "render -o " + file("a.png") + " --variant red",
                                         "render -o " + file("a.png") + " --scene 5",
                                         std::string("info assets/cornell_box.glb --scene 5"),
                                         std::string("info assets/cornell_box.glb --variant red"),
                                         "screenshot -o " + file("a.png") + " --scene 5",
                                         "screenshot -o " + file("a.png") + " --map colour",
                                         "screenshot -o " + file("a.png") + " --wipe 2",
                                         "screenshot -o " + file("a.png") + " --frame-time 1",
                                         "screenshot -o " + file("a.png") + " --limit-views -1",
                                         "screenshot -o " + file("a.png") + " --compare-with mist",
                                         "screenshot -o " + file("a.png") + " --inspect 5",
                                         "screenshot -o " + file("a.png") + " --metric flip",
                                         "screenshot -o " + file("a.png") + " --compare-with bsdf --map error",
                                         "screenshot -o " + file("a.png") + " --open doors",
                                         "screenshot -o " + file("a.png") + " --theme pink",
                                         "screenshot -o " + file("a.png") + " --ui-scale 9",
                                         "screenshot -o " + file("a.png") + " --watch",
                                         "render -o " + file("a.png") + " --turntable 0",
                                         "render -o " + file("a.png") + " --turntable 4 --frames 0:3",
                                         "screenshot -o " + file("a.png") + " --variant red",
                                         "render -o " + file("a.exr") + " --aov colour"}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2) << arguments << "\n" << outcome.text;
        EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
    }
    EXPECT_EQ(run("--help").status, 0);
    EXPECT_NE(run("--version").text.find("candela "), std::string::npos);
}

TEST_F(CommandLine, UnreadableScenesAreThree) {
    std::ofstream(folder_ / "broken.gltf") << "{\"asset\":";
    for (const std::string& scene : {file("missing.gltf"), file("broken.gltf"), file(".")}) {
        const Outcome outcome = run("render " + scene + " -o " + file("a.png"));
        EXPECT_EQ(outcome.status, 3) << outcome.text;
        EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
        EXPECT_EQ(run("info " + scene).status, 3);
    }
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.png"));
}

TEST_F(CommandLine, AScreenshotIsTheRenderedPictureAndItsPanelsLieOverIt) {
    const std::string options = " assets/cornell_box.glb --resolution 120x90 --spp 4 --quiet -o ";
    ASSERT_EQ(run("screenshot --no-ui" + options + file("plain.png")).status, 0);
    ASSERT_EQ(run("screenshot" + options + file("panels.png")).status, 0);
    ASSERT_EQ(run("render" + options + file("render.png")).status, 0);
    const ImageRgba32f plain = read_any_as_linear(folder_ / "plain.png"),
                       panels = read_any_as_linear(folder_ / "panels.png"),
                       render = read_any_as_linear(folder_ / "render.png");
    double plain_difference = 0, panel_difference = 0;
    for (size_t i = 0; i < render.size(); ++i) {
        plain_difference =
            std::max(plain_difference, static_cast<double>(std::abs(plain.pixels()[i].g - render.pixels()[i].g)));
        panel_difference =
            std::max(panel_difference, static_cast<double>(std::abs(panels.pixels()[i].g - render.pixels()[i].g)));
    }
    EXPECT_LT(plain_difference, 0.01);  // one level of 255
    EXPECT_GT(panel_difference, 0.1);
}

TEST_F(CommandLine, AScreenshotShowsTheMapThatIsAskedFor) {
    const std::string common = "screenshot --no-ui --spp 4 --resolution 48x32 --quiet -o ";
    ASSERT_EQ(run(common + file("plain.png")).status, 0);
    ASSERT_EQ(run(common + file("map.png") + " --map error --wipe 0.5").status, 0);
    const ImageRgba32f plain = read_any_as_linear(folder_ / "plain.png"), map = read_any_as_linear(folder_ / "map.png");
    double left = 0, right = 0;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 48; ++x)
            (x < 24 ? left : right) += static_cast<double>(std::abs(plain(x, y).g - map(x, y).g));
    }
    EXPECT_EQ(left, 0);
    EXPECT_GT(right, 10);
}

TEST_F(CommandLine, AScreenshotFailsAsTheContractSays) {
    EXPECT_EQ(run("screenshot -o " + file("a.exr") + tiny).status, 2);
    EXPECT_EQ(run("screenshot --aov albedo -o " + file("a.png") + tiny).status, 2);
    EXPECT_EQ(run("screenshot --stats " + file("no/such.json") + " -o " + file("a.png") + tiny).status, 4);
    const Outcome record = run("screenshot --stats - -o " + file("a.png") + tiny);
    EXPECT_EQ(record.status, 0);
    EXPECT_NE(record.text.find("\"image_sha256\""), std::string::npos) << record.text;
    EXPECT_EQ(run("screenshot missing.glb -o " + file("a.png") + tiny).status, 3);
    EXPECT_EQ(run("screenshot -o " + file("no/such/a.png") + tiny).status, 4);
    EXPECT_EQ(run("screenshot -o " + file("a.png") + " --resolution 30000x8 --spp 1").status, 4);
    EXPECT_EQ(run("view missing.glb").status, 3);
}

TEST_F(CommandLine, UnwritableOutputIsFour) {
    EXPECT_EQ(run("render -o " + file("no/such/a.png") + tiny).status, 4);
    EXPECT_EQ(run("render -o /proc/a.png" + tiny).status, 4);
}

TEST_F(CommandLine, InterruptSavesWhatThereIs) {
    const Outcome outcome =
        run("render -o " + file("a.png") +
            " --resolution 64x48 --spp 1000000000 --quiet & pid=$!; sleep 1; kill -INT $pid; wait $pid");
    EXPECT_EQ(outcome.status, 130) << outcome.text;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "a.png"));
}

TEST_F(CommandLine, CompareFailsAboveItsLimit) {
    run("render -o " + file("a.png") + tiny);
    run("render -o " + file("b.png") + tiny + "--exposure 1");
    EXPECT_EQ(run("compare --max-mae 0.0001 " + file("a.png") + " " + file("b.png")).status, 1);
    EXPECT_EQ(run("compare --json " + file("a.png") + " " + file("a.png")).status, 0);
}

}  // namespace
}  // namespace candela
