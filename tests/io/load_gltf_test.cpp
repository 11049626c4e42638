// SPDX-License-Identifier: MIT
// Documents made in the test, one feature or one fault each.
#include <fstream>

#include "renderer/io/load_gltf.h"
#include "tests/support/temporary_folder.h"

namespace candela {
namespace {

class LoadGltf : public ::testing::Test {
  protected:
    Scene load(const std::string& json, LoadOptions options = {}) {
        const auto path = folder_ / "scene.gltf";
        std::ofstream(path) << json;
        return load_gltf(path, diagnostics_, options);
    }
    // The pointer and reason of the error that loading ends with.
    std::string failure(const std::string& json) {
        try {
            load(json);
        } catch (const LoadError& error) {
            return error.where() + ": " + error.reason();
        }
        return "loaded";
    }

    const test::TemporaryFolder own_folder_{"candela_load"};
    const std::filesystem::path folder_ = own_folder_.path();
    Diagnostics diagnostics_;
};

// A triangle (0,0,0) (1,0,0) (0,1,0): 36 bytes of positions, then 3 bytes of indices 0 1 2 and one of padding.
const std::string buffer =
    R"("buffers":[{"byteLength":40,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAECAA=="}],)"
    R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":3}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
    R"({"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}],)";

std::string document(const std::string& nodes, const std::string& more = "") {
    return R"({"asset":{"version":"2.0"},)" + buffer +
           R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"scene":0,"scenes":[{"nodes":[0]}],)" +
           more + R"("nodes":)" + nodes + "}";
}

TEST_F(LoadGltf, TriangleWithByteIndicesAndFlatNormals) {
    const Scene scene = load(document(R"([{"mesh":0}])"));
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Primitive& p = scene.meshes[0]->primitives.at(0);
    EXPECT_EQ(p.triangles.at(0), Vec3u(0, 1, 2));
    EXPECT_EQ(p.positions.at(1), Vec3(1, 0, 0));
    EXPECT_TRUE(p.flat_normals);
}

TEST_F(LoadGltf, TransformsMultiplyDownTheTree) {
    const Scene scene = load(document(R"([{"translation":[1,2,3],"children":[1]},{"scale":[2,2,-2],"mesh":0}])"));
    ASSERT_EQ(scene.instances.size(), 1u);
    const Vec4 p = scene.instances[0].world_from_object * Vec4(1, 1, 1, 1);
    EXPECT_EQ(Vec3(p), Vec3(3, 4, 1));
}

TEST_F(LoadGltf, CyclesAndSharedChildrenAreRefused) {
    EXPECT_NE(failure(document(R"([{"mesh":0},{"children":[2]},{"children":[1]}])")).find("ancestor"),
              std::string::npos);
    EXPECT_NE(failure(document(R"([{"children":[2]},{"children":[2]},{"mesh":0}])")).find("two parents"),
              std::string::npos);
}

TEST_F(LoadGltf, RequiredExtensionIsRefusedByName) {
    const std::string said =
        failure(document(R"([{"mesh":0}])", R"("extensionsUsed":["EXT_x"],"extensionsRequired":["EXT_x"],)"));
    EXPECT_NE(said.find("/extensionsRequired/0"), std::string::npos) << said;
    EXPECT_NE(said.find("EXT_x"), std::string::npos) << said;
}

TEST_F(LoadGltf, FilesOutsideTheFolderAreRefused) {
    std::ofstream(folder_.parent_path() / "candela_secret.bin") << std::string(40, 'x');
    for (const std::string& uri : std::vector<std::string>{"../candela_secret.bin", "%2e%2e%2fcandela_secret.bin",
                                                           "/etc/passwd", "http://host/a.bin"}) {
        std::string json = document(R"([{"mesh":0}])");
        const size_t begin = json.find("data:");
        json.replace(begin, json.find('"', begin) - begin, uri);
        const std::string said = failure(json);
        EXPECT_EQ(said.find("/buffers/0"), 0u) << uri << " " << said;
    }
    std::filesystem::remove(folder_.parent_path() / "candela_secret.bin");
}

TEST_F(LoadGltf, FaultsAreNamedByPointer) {
    std::string json = document(R"([{"mesh":0}])");
    const auto with = [&](const std::string& what, const std::string& by) {
        std::string out = json;
        out.replace(out.find(what), what.size(), by);
        return failure(out);
    };
    EXPECT_EQ(with(R"("mesh":0)", R"("mesh":7)").find("/nodes/0/mesh"), 0u);
    EXPECT_EQ(with(R"("byteLength":36)", R"("byteLength":3600)").find("/bufferViews/0"), 0u);
    EXPECT_EQ(with(R"("count":3,"type":"VEC3")", R"("count":4000000000,"type":"VEC3")").find("/accessors/0"), 0u);
    EXPECT_EQ(with(R"("version":"2.0")", R"("version":"3.0")").find("/asset"), 0u);
    EXPECT_NE(with(R"("scene":0)", R"("extras":)" + std::string(5000, '[') + std::string(5000, ']') + R"(,"scene":0)"),
              "loaded");
}

TEST_F(LoadGltf, CancelEndsTheLoad) {
    const std::atomic<bool> cancel{true};
    LoadOptions options;
    options.cancel = &cancel;
    EXPECT_THROW(load(document(R"([{"mesh":0}])"), options), LoadError);
}

}  // namespace
}  // namespace candela
