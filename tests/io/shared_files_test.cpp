// SPDX-License-Identifier: MIT
// Every file of the shared data: broken ones end in one clear line or load with a warning, none crashes or hangs.
#include <chrono>

#include "renderer/io/load_gltf.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

std::vector<std::filesystem::path> scenes_below(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const auto extension = entry.path().extension();
        if (extension == ".gltf" || extension == ".glb") out.push_back(entry.path());
    }
    std::sort(out.begin(), out.end());
    return out;
}

TEST(SharedFiles, InvalidOnesEndWithAReasonOrAWarning) {
    const std::filesystem::path folder = test::shared_data() / "invalid";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "skipped: no shared data";
    int refused = 0;
    const auto files = scenes_below(folder);
    ASSERT_GT(files.size(), 80u);
    for (const auto& file : files) {
        const auto start = std::chrono::steady_clock::now();
        Diagnostics diagnostics;
        try {
            const Scene scene = load_gltf(file, diagnostics);
            for (const std::shared_ptr<const Mesh>& mesh : scene.meshes) {
                for (const Primitive& p : mesh->primitives) {
                    for (const Vec3u& t : p.triangles)
                        ASSERT_LT(std::max({t.x, t.y, t.z}), p.positions.size()) << file;
                }
            }
        } catch (const LoadError& error) {
            ++refused;
            EXPECT_FALSE(error.reason().empty()) << file;
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << file;
            EXPECT_EQ(std::string(error.what()).find(file.string()), 0u) << file;
        }
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2)) << file;
    }
    EXPECT_GT(refused, 40);
}

TEST(SharedFiles, ModelsLoadOrNameTheExtensionTheyNeed) {
    const std::filesystem::path folder = test::shared_data() / "models";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "skipped: no shared data";
    for (const auto& file : scenes_below(folder)) {
        Diagnostics diagnostics;
        LoadOptions options;
        options.decode_images = false;
        try {
            load_gltf(file, diagnostics, options);
        } catch (const LoadError& error) {
            EXPECT_NE(error.reason().find("the required extension"), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace candela
