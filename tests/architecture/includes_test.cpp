// SPDX-License-Identifier: MIT
// Reads every #include of the project: rooms look downwards only, and each library has one owner.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

namespace candela {
namespace {

const std::map<std::string, int> rank = {
    {"math", 0}, {"sampling", 1}, {"image", 1},   {"bsdf", 2},   {"scene", 2}, {"film", 2},       {"denoise", 3},
    {"io", 3},   {"accel", 3},    {"texture", 3}, {"lights", 4}, {"world", 5}, {"integrator", 6}, {"session", 7}};

// Which room may include a foreign header, by a part of its name.
const std::vector<std::pair<std::string, std::string>> owners = {
    {"embree", "accel"}, {"tiny_gltf", "io"}, {"meshopt", "io"}, {"png.h", "image"},      {"jpeglib", "image"},
    {"webp/", "image"},  {"zstd", "image"},   {"Imf", "image"},  {"libdeflate", "image"}, {"GLFW", "-"},
    {"osmesa", "-"},     {"GL/", "-"},        {"imgui", "-"}};

struct Line {
    std::string file, room, included;
    bool quoted = false;
};

std::vector<std::filesystem::path> sources_below(const std::string& folder) {
    std::vector<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") out.push_back(entry.path());
    }
    return out;
}

std::vector<Line> includes_of_renderer() {
    const std::regex pattern(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
    std::vector<Line> out;
    for (const auto& path : sources_below("renderer")) {
        std::ifstream file(path);
        for (std::string line; std::getline(file, line);) {
            std::smatch match;
            if (!std::regex_search(line, match, pattern)) continue;
            out.push_back({path.string(), path.parent_path().filename().string(), match[2], match[1] == "\""});
        }
    }
    return out;
}

TEST(Architecture, RoomsLookDownwardsOnly) {
    const std::vector<Line> lines = includes_of_renderer();
    ASSERT_GT(lines.size(), 200u);
    for (const Line& line : lines) {
        ASSERT_TRUE(rank.count(line.room)) << line.file << " lies in no known room";
        if (!line.quoted) continue;
        ASSERT_EQ(line.included.rfind("renderer/", 0), 0u)
            << line.file << " includes " << line.included << " without naming its room";
        const std::string other = line.included.substr(9, line.included.find('/', 9) - 9);
        ASSERT_TRUE(rank.count(other)) << line.file << " includes " << line.included;
        EXPECT_TRUE(other == line.room || rank.at(other) < rank.at(line.room))
            << line.file << " includes upwards: " << line.included;
    }
}

TEST(Architecture, EachLibraryHasOneOwner) {
    for (const Line& line : includes_of_renderer()) {
        if (line.quoted) continue;
        for (const auto& [part, owner] : owners) {
            if (line.included.find(part) == std::string::npos) continue;
            EXPECT_EQ(line.room, owner) << line.file << " includes " << line.included;
        }
    }
}

TEST(Architecture, EveryFileStatesItsLicenceAndKeepsItsSize) {
    for (const char* folder : {"renderer", "app", "tests"}) {
        for (const auto& path : sources_below(folder)) {
            std::ifstream file(path);
            std::string line;
            std::getline(file, line);
            EXPECT_EQ(line, "// SPDX-License-Identifier: MIT") << path;
            int count = 1;
            while (std::getline(file, line))
                ++count;
            EXPECT_LE(count, 600) << path << " is more than one idea";
        }
    }
}

}  // namespace
}  // namespace candela
