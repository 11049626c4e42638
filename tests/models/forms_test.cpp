// SPDX-License-Identifier: MIT
// Models written again in other forms are the same scenes to the bit: geometry, poses, pictures and all.
#include <fstream>

#include <gtest/gtest.h>

#include "renderer/io/load_gltf.h"
#include "renderer/scene/animation.h"
#include "renderer/scene/deform.h"
#include "tests/models/repack.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_folder.h"

namespace candela {
namespace {

using test::RawGltf;
using test::Repacker;

Scene load(const std::filesystem::path& file) {
    Diagnostics diagnostics;
    return load_gltf(file, diagnostics, {});
}

void expect_same_primitive(const Primitive& a, const Primitive& b) {
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.tangents, b.tangents);
    EXPECT_EQ(a.uv[0], b.uv[0]);
    EXPECT_EQ(a.uv[1], b.uv[1]);
    EXPECT_EQ(a.colors, b.colors);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.material, b.material);
    ASSERT_EQ(a.deformation == nullptr, b.deformation == nullptr);
    if (!a.deformation) return;
    EXPECT_EQ(a.deformation->joints, b.deformation->joints);
    EXPECT_EQ(a.deformation->weights, b.deformation->weights);
    ASSERT_EQ(a.deformation->targets.size(), b.deformation->targets.size());
    for (size_t t = 0; t < a.deformation->targets.size(); ++t) {
        EXPECT_EQ(a.deformation->targets[t].positions, b.deformation->targets[t].positions);
        EXPECT_EQ(a.deformation->targets[t].normals, b.deformation->targets[t].normals);
        EXPECT_EQ(a.deformation->targets[t].tangents, b.deformation->targets[t].tangents);
    }
}

void expect_same_scene(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (size_t m = 0; m < a.meshes.size(); ++m) {
        ASSERT_EQ(a.meshes[m]->primitives.size(), b.meshes[m]->primitives.size());
        for (size_t p = 0; p < a.meshes[m]->primitives.size(); ++p)
            expect_same_primitive(a.meshes[m]->primitives[p], b.meshes[m]->primitives[p]);
    }
    ASSERT_EQ(a.instances.size(), b.instances.size());
    for (size_t i = 0; i < a.instances.size(); ++i) {
        EXPECT_EQ(a.instances[i].mesh, b.instances[i].mesh);
        EXPECT_EQ(a.instances[i].world_from_object, b.instances[i].world_from_object);
    }
    ASSERT_EQ(a.skins.size(), b.skins.size());
    for (size_t s = 0; s < a.skins.size(); ++s)
        EXPECT_EQ(a.skins[s]->joint_from_mesh, b.skins[s]->joint_from_mesh);
    ASSERT_EQ(a.animations.size(), b.animations.size());
    for (size_t i = 0; i < a.animations.size(); ++i) {
        ASSERT_EQ(a.animations[i]->channels.size(), b.animations[i]->channels.size());
        for (size_t c = 0; c < a.animations[i]->channels.size(); ++c) {
            const AnimationSampler& x = a.animations[i]->channels[c].sampler;
            const AnimationSampler& y = b.animations[i]->channels[c].sampler;
            EXPECT_EQ(*x.times_s, *y.times_s);
            EXPECT_EQ(x.values, y.values);
        }
    }
    ASSERT_EQ(a.materials.size(), b.materials.size());
    ASSERT_EQ(a.images.size(), b.images.size());
    for (size_t i = 0; i < a.images.size(); ++i) {
        ASSERT_EQ(a.images[i].pixels == nullptr, b.images[i].pixels == nullptr);
        if (!a.images[i].pixels) continue;
        EXPECT_EQ(a.images[i].pixels->width(), b.images[i].pixels->width());
        EXPECT_EQ(a.images[i].pixels->pixels(), b.images[i].pixels->pixels());
    }
}

TEST(Forms, GlbEmbeddedMeshoptAndWebpAreTheSameScene) {
    std::ifstream stream(test::shared_data() / "manifest.json");
    if (!stream) GTEST_SKIP() << "skipped: no shared data";
    const RawGltf::Json manifest = RawGltf::Json::parse(stream);
    int models = 0, compressed = 0, with_webp = 0;
    for (const RawGltf::Json& entry : manifest["files"]) {
        const std::string path = entry["path"];
        if (entry["kind"] != "model" || entry["totalBytes"] > 600'000) continue;
        bool is_plain = true;
        for (const std::string extension : entry["extensionsUsed"]) {
            is_plain = is_plain && extension.rfind("FAKE_", 0) != 0 &&
                       extension.find("_compression") == std::string::npos &&
                       extension.find("_texture_webp") == std::string::npos;
        }
        if (!is_plain) continue;
        const Repacker repacker(test::shared_data() / path);
        const Scene plain = load(test::shared_data() / path);
        const test::TemporaryFolder folder;
        const auto expect_same = [&](const std::filesystem::path& form) {
            SCOPED_TRACE(path + " as " + form.filename().string());
            expect_same_scene(plain, load(form));
        };
        expect_same(repacker.as_glb(folder.path()));
        expect_same(repacker.as_embedded(folder.path()));
        const std::filesystem::path meshopt = repacker.as_meshopt(folder.path());
        expect_same(meshopt);
        compressed += RawGltf::contents(meshopt).find("ATTRIBUTES") != std::string::npos;
        ++models;
        if (repacker.png_count() == 0) continue;
        expect_same(repacker.as_webp(folder.path()));
        ++with_webp;
    }
    EXPECT_GE(models, 50);
    EXPECT_GE(compressed, 50);
    EXPECT_GE(with_webp, 20);
}

// Its WebP textures are other pictures than the PNGs for those who cannot read them: nearly black instead of brown.
TEST(Forms, TexturesOfAnExtensionComeBeforeTheirFallback) {
    const std::filesystem::path file = test::shared_data() / "models/WebpCurvedSurface/webp.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "skipped: no shared data";
    const auto mean_base_color = [](const Scene& scene) {
        const TextureRef& ref = scene.materials.at(0).base_color;
        const ImageRgba8& image = *scene.images[scene.textures[ref.texture.value].image.value].pixels;
        glm::dvec3 sum(0);
        for (const Rgba8& p : image.pixels())
            sum += glm::dvec3(p.r, p.g, p.b);
        return sum / static_cast<double>(image.size());
    };
    EXPECT_LT(glm::distance(mean_base_color(load(file)), glm::dvec3(26.8, 25.2, 24.1)), 0.2);

    const test::TemporaryFolder folder;
    std::filesystem::copy(file.parent_path(), folder.path());
    RawGltf::Json document = RawGltf(file).json;
    document.erase("extensionsRequired");
    for (RawGltf::Json& texture : document["textures"])
        texture.erase("extensions");
    const std::filesystem::path plain = folder.path() / "plain.gltf";
    std::ofstream(plain) << document.dump();
    EXPECT_LT(glm::distance(mean_base_color(load(plain)), glm::dvec3(129.1, 96.9, 68.3)), 0.2);
}

}  // namespace
}  // namespace candela
