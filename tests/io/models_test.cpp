// SPDX-License-Identifier: MIT
// The shared models against what their manifest says of them.
#include "renderer/scene/scene.h"
#include "tests/io/document.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

using test::Json;

Json read_manifest() {
    std::ifstream file(test::shared_data() / "manifest.json");
    return file ? Json::parse(file) : Json();
}

bool has(const Json& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

// Points and lines are no triangles to the manifest.
uint64_t surface_triangle_count(const Scene& scene) {
    uint64_t count = 0;
    for (size_t m = 0; m < scene.meshes.size() - scene.posed_mesh_count; ++m) {
        for (const Primitive& primitive : scene.meshes[m]->primitives) {
            if (primitive.shape == PrimitiveShape::surface) count += primitive.triangles.size();
        }
    }
    return count;
}

TEST(Models, TriangleCountsAreTheManifests) {
    const Json manifest = read_manifest();
    if (manifest.is_null()) GTEST_SKIP() << "skipped: no shared data";
    int loaded = 0, refused = 0;
    for (const Json& file : manifest["files"]) {
        if (file["kind"] != "model") continue;
        const std::string path = file["path"];
        Diagnostics diagnostics;
        LoadOptions options;
        options.decode_images = false;
        try {
            const Scene scene = load_gltf(test::shared_data() / path, diagnostics, options);
            EXPECT_EQ(surface_triangle_count(scene), file["triangles"].get<uint64_t>()) << path;
            ++loaded;
        } catch (const LoadError& error) {
            // Only for an extension that the file insists on.
            EXPECT_EQ(error.where().rfind("/extensionsRequired/", 0), 0u) << error.what();
            EXPECT_FALSE(file["extensionsRequired"].empty()) << error.what();
            ++refused;
        }
    }
    EXPECT_GT(loaded, 80);
    EXPECT_LT(refused, 10);
}

// Files that the validator calls broken in a way that leaves nothing to guess.
TEST(Models, FatalFaultsAreRefused) {
    const Json manifest = read_manifest();
    if (manifest.is_null()) GTEST_SKIP() << "skipped: no shared data";
    const std::vector<std::string> fatal = {"UNRESOLVED_REFERENCE",
                                            "BUFFER_VIEW_TOO_LONG",
                                            "ACCESSOR_TOO_LONG",
                                            "ACCESSOR_INDEX_OOB",
                                            "NODE_LOOP",
                                            "NODE_PARENT_OVERRIDE",
                                            "INVALID_JSON",
                                            "GLB_INVALID_VERSION",
                                            "TYPE_MISMATCH",
                                            "GLB_CHUNK_TOO_BIG",
                                            "BUFFER_MISSING_GLB_DATA"};
    int checked = 0;
    for (const Json& file : manifest["files"]) {
        if (file["kind"] != "invalid" || !file.contains("errorCodes")) continue;
        const std::string path = file["path"];
        // A file may refer to variants that it has not.
        if (path.find("variants") != std::string::npos) continue;
        for (const std::string& code : fatal) {
            if (!has(file["errorCodes"], code)) continue;
            Diagnostics diagnostics;
            EXPECT_THROW(load_gltf(test::shared_data() / path, diagnostics), LoadError) << path << " " << code;
            ++checked;
        }
    }
    EXPECT_GT(checked, 20);
}

TEST(Models, BoxWithSpacesInItsNames) {
    const auto file = test::shared_data() / "models/Box_With_Spaces/glTF/Box With Spaces.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "skipped: no shared data";
    Diagnostics diagnostics;
    const Scene scene = load_gltf(file, diagnostics);
    for (const Diagnostic& warning : diagnostics.warnings())
        ADD_FAILURE() << warning.where << ": " << warning.message;
    for (const SceneImage& image : scene.images)
        EXPECT_GT(image.pixels->size(), 1u) << image.name;
}

// Compressed and quantised, the box is still a unit cube with its normals pointing out.
TEST(Models, MeshoptAndQuantizedFormsShowTheSameBox) {
    const auto file = test::shared_data() / "models/BoxTexturedMeshopt/BoxTextured_meshopt.glb";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "skipped: no shared data";
    Diagnostics diagnostics;
    const Scene scene = load_gltf(file, diagnostics);
    const Bounds3 bounds = bounds_of(scene);
    EXPECT_NEAR(glm::distance(bounds.lower, Vec3(-0.5f)), 0.0f, 1e-3f);
    EXPECT_NEAR(glm::distance(bounds.upper, Vec3(0.5f)), 0.0f, 1e-3f);
    const Primitive& box = scene.meshes.at(0)->primitives.at(0);
    for (const Vec3u& t : box.triangles) {
        const auto& p = box.positions;
        const Vec3 geometric = glm::normalize(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]));
        for (int c = 0; c < 3; ++c)
            EXPECT_GT(glm::dot(geometric, box.normals[t[c]]), 0.99f);
    }
}

}  // namespace
}  // namespace candela
