// SPDX-License-Identifier: MIT
// Images decode while the rest of the file is read: what is there when, and that nothing depends on who is faster.
#include <chrono>
#include <set>
#include <thread>

#include <tbb/global_control.h>

#include "renderer/io/asset_images.h"
#include "renderer/io/files.h"
#include "renderer/io/json_document.h"
#include "tests/io/document.h"

namespace candela {
namespace {

using namespace test;

// The smallest limit with which the file opens as it should, where nothing happens beside anything else.
template <typename Opens>
uint64_t least_memory(uint64_t low, uint64_t high, const Opens& opens) {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_FALSE(opens(low));
    EXPECT_TRUE(opens(high));
    while (high - low > 1) {
        const uint64_t middle = (low + high) / 2;
        (opens(middle) ? high : low) = middle;
    }
    return high;
}

class Overlap : public GltfTest {
  protected:
    void SetUp() override {
        GltfTest::SetUp();
        options_.decode_images = true;
        for (int i = 0; i < image_count; ++i)
            write_png(folder_ / name(i), ImageRgba8(160, 120, Rgba8(static_cast<uint8_t>(20 * i + 10))), false);
    }
    static constexpr int image_count = 4;
    static std::string name(int i) { return std::string(1, static_cast<char>('a' + i)) + ".png"; }
    // A triangle for each image.
    Document document() const {
        Document document = Document::triangle();
        const int uv = document.add_accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2", f32);
        Json& primitives = document.json["meshes"][0]["primitives"];
        primitives[0]["attributes"]["TEXCOORD_0"] = uv;
        for (int i = 0; i < image_count; ++i) {
            document.json["images"].push_back({{"uri", name(i)}});
            document.json["textures"].push_back({{"source", i}});
            document.json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
            if (i > 0) primitives.push_back(primitives[0]);
            primitives[i]["material"] = i;
        }
        return document;
    }
    // The error, or which images there are, and the warnings.
    std::string outcome(const std::filesystem::path& file) {
        std::string out;
        try {
            const Scene scene = load_file(file);
            for (const SceneImage& image : scene.images)
                out += image.pixels->width() == 160 ? 'x' : '.';
        } catch (const LoadError& error) {
            return error.what();
        }
        for (const Diagnostic& warning : diagnostics_.warnings())
            out += "\n" + warning.where + ": " + warning.message;
        return out;
    }
};

TEST_F(Overlap, ThePreviewHasAllButThePixels) {
    int calls = 0;
    options_.geometry_ready = [&](const Scene& scene) {
        ++calls;
        EXPECT_EQ(scene.meshes.size(), 1u);
        EXPECT_EQ(scene.instances.size(), 1u);
        EXPECT_EQ(scene.materials.size(), size_t{image_count});
        for (const SceneImage& image : scene.images)
            EXPECT_EQ(image.pixels, nullptr);
    };
    const Scene scene = load(document());
    EXPECT_EQ(calls, 1);
    for (size_t i = 0; i < scene.images.size(); ++i) {
        EXPECT_EQ((*scene.images[i].pixels)(0, 0).r, 20 * i + 10);
        EXPECT_EQ(scene.images[i].alpha, ImageAlpha::opaque);
        ASSERT_NE(scene.images[i].smaller, nullptr);
        EXPECT_EQ(scene.images[i].smaller->size(), 7u);
    }

    // A scene without pictures is there at once.
    load(Document::triangle());
    EXPECT_EQ(calls, 1);
}

TEST_F(Overlap, HeadsTellWhatIsOpaque) {
    Document masked = document();
    for (Json& material : masked.json["materials"])
        material["alphaMode"] = "MASK";
    write_png(folder_ / name(1), ImageRgba8(160, 120, Rgba8(255)), true);
    options_.geometry_ready = [](const Scene& scene) {
        EXPECT_EQ(scene.images[0].alpha, ImageAlpha::opaque);
        EXPECT_EQ(scene.images[1].alpha, ImageAlpha::unknown);
    };
    const Scene scene = load(masked);
    EXPECT_EQ(scene.images[1].alpha, ImageAlpha::opaque) << "all its texels are";
}

TEST_F(Overlap, WhatTheCallerThrowsEndsTheLoad) {
    struct Stop {};
    options_.geometry_ready = [](const Scene&) { throw Stop(); };
    EXPECT_THROW(load(document()), Stop);
}

TEST_F(Overlap, BrokenImagesAreWarningsInTheOrderOfTheFile) {
    write(name(1), "no picture");
    std::filesystem::remove(folder_ / name(2));
    options_.geometry_ready = [&](const Scene&) { EXPECT_TRUE(diagnostics_.warnings().empty()); };
    const Scene scene = load(document());
    ASSERT_EQ(diagnostics_.warnings().size(), 2u);
    EXPECT_EQ(diagnostics_.warnings()[0].where, "/images/1");
    EXPECT_EQ(diagnostics_.warnings()[1].where, "/images/2/uri");
    EXPECT_EQ(scene.images[3].pixels->width(), 160);
}

// With ever more memory ever more of the file opens, in the same order, whoever is faster: first the meshes, then the
// images as the file has them.
TEST_F(Overlap, WhereMemoryRunsShortDependsOnTheFileAlone) {
    Document source = document();
    source.finish("data.bin");
    write("data.bin", {source.bytes.begin(), source.bytes.end()});
    const std::filesystem::path file = write("scene.gltf", source.json.dump());
    std::set<std::string> seen;
    size_t last = 0;
    for (uint64_t limit = 50000; limit < 500000; limit += 7000) {
        options_.max_memory_bytes = limit;
        const std::string first = outcome(file);
        for (int again = 0; again < 3; ++again)
            ASSERT_EQ(outcome(file), first) << limit;
        const std::string shown = first.substr(0, 4);
        if (shown.find_first_not_of("x.") != std::string::npos) {
            EXPECT_TRUE(seen.empty()) << first;
            continue;
        }
        const auto count = static_cast<size_t>(std::count(shown.begin(), shown.end(), 'x'));
        EXPECT_EQ(shown, std::string(count, 'x') + std::string(4 - count, '.'));
        EXPECT_GE(count, last);
        last = count;
        seen.insert(shown);
    }
    EXPECT_EQ(seen.size(), 5u) << "none to all of the images";
}

TEST_F(Overlap, NothingIsDecodedOnceItIsCancelled) {
    const RawBytes bytes = read_file(folder_ / name(0));
    const std::vector<std::span<const std::byte>> sources(3, bytes);
    std::atomic<bool> cancel{false};
    ImageDecodeOptions options;
    options.cancel = &cancel;
    for (const DecodedImage& image : decode_images(sources, options))
        EXPECT_EQ(image.pixels.width(), 160) << image.error;
    cancel = true;
    for (const DecodedImage& image : decode_images(sources, options))
        EXPECT_EQ(image.error, "cancelled");
}

// A mesh takes more while it is read than after: images that found no room meanwhile have it in the end.
TEST_F(Overlap, WhatFitsAfterTheMeshesIsThere) {
    Document source = document();
    std::vector<uint16_t> corners(300'000);
    for (size_t i = 0; i < corners.size(); ++i)
        corners[i] = static_cast<uint16_t>(i % 3);
    source.json["meshes"][0]["primitives"][0]["indices"] = source.add_accessor(corners, "SCALAR", u16);
    for (int i = 0; i < image_count; ++i)
        write_png(folder_ / name(i), ImageRgba8(160, 1200, Rgba8(90)), false);
    source.finish("data.bin");
    write("data.bin", {source.bytes.begin(), source.bytes.end()});
    const std::filesystem::path file = write("scene.gltf", source.json.dump());
    const auto all_there = [&](uint64_t limit) {
        options_.max_memory_bytes = limit;
        return outcome(file) == "xxxx";
    };
    const uint64_t enough = least_memory(100'000, 20'000'000, all_there);
    for (int again = 0; again < 10; ++again)
        ASSERT_TRUE(all_there(enough));
    ASSERT_FALSE(all_there(enough - 1));
}

// Whoever decodes has long been refused when the room is there.
TEST_F(Overlap, WhatWasRefusedOnceIsAskedForAgain) {
    const Json document = {{"images", {{{"uri", name(0)}}, {{"uri", name(1)}}}}};
    LoadContext context((folder_ / "scene.gltf").string(), diagnostics_, options_);
    const Layout layout = read_layout(context, document);
    const AssetFiles files(folder_ / "scene.gltf");
    BufferStore buffers(context, layout, files, std::nullopt);
    AssetImages images(context, layout, files, buffers);
    Scene scene;
    images.list(scene);
    for (uint32_t i = 0; i < 2; ++i) {
        scene.textures.emplace_back().image = {i};
        scene.materials.emplace_back().base_color.texture = {i};
    }
    const uint64_t one_image = 160 * 120 * 4;
    const uint64_t held_bytes = context.bytes_left() - one_image - one_image / 2;
    context.charge(held_bytes, "");
    images.begin(scene);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    context.release(held_bytes);
    images.finish(scene);
    EXPECT_EQ(diagnostics_.warnings().size(), 0u) << all_warnings();
    for (const SceneImage& image : scene.images)
        EXPECT_EQ(image.pixels->width(), 160);
}

// Primitives are read several at a time.
class ManyPrimitives : public GltfTest {
  protected:
    static constexpr int count = 40;
    // Each with positions of its own, so that values of one can be broken.
    static Document document(const std::set<int>& with_strange_normals, const std::set<int>& with_wrong_indices,
                             int first_large = 0, size_t corners_each = 60'000, bool last_is_largest = false) {
        Document document;
        // The first so many are the same triangle again and again, and take longer than the others.
        std::vector<uint16_t> corners(corners_each);
        for (size_t i = 0; i < corners.size(); ++i)
            corners[i] = static_cast<uint16_t>(i % 3);
        const int again = document.add_accessor(corners, "SCALAR", u16);
        std::vector<uint16_t> twice = corners;
        twice.insert(twice.end(), corners.begin(), corners.end());
        const int often = document.add_accessor(twice, "SCALAR", u16);
        for (int i = 0; i < count; ++i) {
            const auto x = static_cast<float>(i);
            const int positions = document.add_accessor<float>({x, 0, 0, x + 1, 0, 0, x, 1, 0}, "VEC3", f32);
            const float z = with_strange_normals.contains(i) ? 0.0f : 1.0f;
            const int normals = document.add_accessor<float>({0, 0, z, 0, 0, 1, 0, 0, 1}, "VEC3", f32);
            const auto last = static_cast<uint16_t>(with_wrong_indices.contains(i) ? 3 : 2);
            const int indices = document.add_accessor<uint16_t>({0, 1, last}, "SCALAR", u16);
            const bool largest = last_is_largest && i == count - 1;
            document.add_primitive({{"POSITION", positions}, {"NORMAL", normals}}, largest           ? often
                                                                                   : i < first_large ? again
                                                                                                     : indices);
        }
        Json& meshes = document.json["meshes"];
        for (int i = 1; i < count; ++i)
            meshes[0]["primitives"].push_back(meshes[static_cast<size_t>(i)]["primitives"][0]);
        meshes.erase(meshes.begin() + 1, meshes.end());
        return document;
    }
};

TEST_F(ManyPrimitives, ComeInTheOrderOfTheFile) {
    const Scene scene = load(document({3, 30, 31}, {}));
    ASSERT_EQ(scene.mesh({0}).primitives.size(), size_t{count});
    for (size_t i = 0; i < count; ++i) {
        const std::vector<Vec3>& positions = scene.mesh({0}).primitives[i].positions;
        EXPECT_EQ(positions[0].x, static_cast<float>(i));
        EXPECT_GE(positions.capacity(), positions.size() + position_padding) << "they would be copied";
    }
    ASSERT_EQ(diagnostics_.warnings().size(), 3u);
    EXPECT_EQ(diagnostics_.warnings()[0].where, "/meshes/0/primitives/3/attributes/NORMAL");
    EXPECT_EQ(diagnostics_.warnings()[2].where, "/meshes/0/primitives/31/attributes/NORMAL");
}

TEST_F(ManyPrimitives, FailAtTheFirstThatIsBroken) {
    const Document broken = document({2, 35}, {9, 10, 22, 39}, 9);
    for (int again = 0; again < 20; ++again) {
        try {
            load(broken);
            FAIL() << "indices out of range";
        } catch (const LoadError& error) {
            ASSERT_EQ(error.where(), "/meshes/0/primitives/9/indices");
        }
        ASSERT_EQ(diagnostics_.warnings().size(), 1u);
    }
}

// One after the other need less at a time, and what several could not get must not be missing then. Nor must be there
// what is there by chance: where the last is read before those that go first, it finds more room than after them.
TEST_F(ManyPrimitives, WhereMemoryRunsShortDependsOnTheFileAlone) {
    for (Document source : {document({}, {}, count, 24'000), document({}, {}, count / 4, 60'000, true)}) {
        source.finish("data.bin");
        write("data.bin", {source.bytes.begin(), source.bytes.end()});
        const std::filesystem::path file = write("scene.gltf", source.json.dump());
        const auto opens = [&](uint64_t limit) {
            options_.max_memory_bytes = limit;
            try {
                load_file(file);
                return std::string();
            } catch (const LoadError& error) {
                return std::string(error.what());
            }
        };
        const uint64_t enough = least_memory(1000, 40'000'000, [&](uint64_t limit) { return opens(limit).empty(); });
        for (const uint64_t limit : {enough - 50, enough - 1, enough, enough + 1, enough + 50}) {
            const std::string first = opens(limit);
            EXPECT_EQ(first.empty(), limit >= enough);
            for (int again = 0; again < 4; ++again)
                ASSERT_EQ(opens(limit), first) << limit;
        }
    }
}

}  // namespace
}  // namespace candela
