// SPDX-License-Identifier: MIT
// Every shared model as a small picture, every broken file as a reason or a picture, and files that must look alike.
#include <chrono>
#include <fstream>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "app/exit_status.h"
#include "app/render_job.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

constexpr Vec2u extent(64, 64);

struct Picture {
    ImageRgba32f image;
    uint64_t non_finite = 0;
    std::vector<std::string> warnings;
};

Picture render(const std::filesystem::path& file, const std::string& variant = "", uint32_t spp = 4,
               std::optional<uint32_t> scene = std::nullopt, std::optional<double> at_seconds = std::nullopt) {
    RenderOptions options;
    options.scene = file.string();
    options.resolution = extent;
    options.spp = spp;
    options.variant = variant;
    options.scene_index = scene;
    options.at_seconds = at_seconds;
    options.sky = Vec3(1);
    const RenderJob job = prepare_render(
        options, [](const char*, double) {}, nullptr);
    SessionOptions session_options;
    session_options.threads = 2;
    session_options.publish_frames = false;
    RenderSession session(session_options);
    session.submit(job.request);
    while (!session.wait_until_done(0.1)) {
    }
    const Frame* frame = session.latest();
    EXPECT_NE(frame, nullptr) << file;
    if (frame == nullptr) return {};
    return {frame->image, frame->statistics.non_finite, job.warnings};
}

// Largest difference of any channel of any pixel.
float difference(const ImageRgba32f& a, const ImageRgba32f& b) {
    float out = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        for (int c = 0; c < 3; ++c)
            out = std::max(out, std::abs(a.pixels()[i][c] - b.pixels()[i][c]));
    }
    return out;
}

float mean_difference(const ImageRgba32f& a, const ImageRgba32f& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        for (int c = 0; c < 3; ++c)
            sum += static_cast<double>(std::abs(a.pixels()[i][c] - b.pixels()[i][c]));
    }
    return static_cast<float>(sum / (3.0 * static_cast<double>(a.size())));
}

nlohmann::json manifest_files() {
    std::ifstream file(test::shared_data() / "manifest.json");
    return file ? nlohmann::json::parse(file)["files"] : nlohmann::json();
}

TEST(RenderedModels, EveryModelIsAPictureWithoutANonFiniteSample) {
    const nlohmann::json files = manifest_files();
    if (files.is_null()) GTEST_SKIP() << "skipped: no shared data";
    const std::string invented = "models/AssetGenerator/Compatibility/Compatibility_05.gltf";
    int count = 0;
    for (const nlohmann::json& file : files) {
        if (file["kind"] != "model") continue;
        const std::string path = file["path"];
        SCOPED_TRACE(path);
        try {
            const Picture picture = render(test::shared_data() / path);
            EXPECT_EQ(picture.non_finite, 0u);
            float brightest = 0;
            for (const Vec4& pixel : picture.image.pixels())
                brightest = std::max({brightest, pixel.x, pixel.y, pixel.z});
            EXPECT_GT(brightest, 0.0f) << "black";
            ++count;
            EXPECT_NE(path, invented) << "needs an extension that nobody has";
        } catch (const CommandError& error) {
            EXPECT_EQ(path, invented) << error.what();
            EXPECT_NE(std::string(error.what()).find("FAKE_materials_quantumRendering"), std::string::npos);
        }
    }
    EXPECT_GT(count, 90);
}

TEST(RenderedModels, EveryBrokenFileIsAReasonOrAPictureWithinTwoSeconds) {
    const std::filesystem::path folder = test::shared_data() / "invalid";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "skipped: no shared data";
    int refused = 0, shown = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const auto extension = entry.path().extension();
        if (extension != ".gltf" && extension != ".glb") continue;
        SCOPED_TRACE(entry.path());
        const auto start = std::chrono::steady_clock::now();
        try {
            EXPECT_EQ(render(entry.path(), "", 1).non_finite, 0u);
            ++shown;
        } catch (const CommandError& error) {
            ++refused;
            EXPECT_EQ(error.status(), ExitStatus::unreadable_scene);
            const std::string line = error.what();
            // The file, where in it, and why.
            EXPECT_EQ(line.rfind(entry.path().string() + ": ", 0), 0u) << line;
            EXPECT_GT(line.size(), entry.path().string().size() + 10) << line;
            EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        }
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
    }
    EXPECT_GT(refused, 40);
    EXPECT_GT(shown, 20);
}

struct Alike {
    const char *a, *b;
    float largest_mean;  // of the absolute difference: what the forms' quantisation or tessellation makes
    std::optional<double> at_seconds = std::nullopt;
};

// Models of which the data has several forms, each in a folder of its own below the model's.
std::set<std::string> models_of_several_forms(const nlohmann::json& files) {
    std::map<std::string, std::set<std::string>> forms;
    for (const nlohmann::json& file : files) {
        const std::filesystem::path path = file["path"].get<std::string>();
        const std::string model = std::next(path.begin())->string();
        if (file["kind"] == "model" && model != "AssetGenerator") forms[model].insert(path.parent_path().string());
    }
    std::set<std::string> out;
    for (const auto& [model, folders] : forms) {
        if (folders.size() > 1) out.insert(model);
    }
    return out;
}

TEST(RenderedModels, FormsOfOneModelLookAlike) {
    if (!std::filesystem::exists(test::shared_data() / "models")) GTEST_SKIP() << "skipped: no shared data";
    const Alike pairs[] = {
        // A fan and indexed triangles.
        {"AssetGenerator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_05.gltf",
         "AssetGenerator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_13.gltf", 1e-6f},
        // Vertex colours of two component types.
        {"AssetGenerator/Mesh_PrimitiveVertexColor/Mesh_PrimitiveVertexColor_01.gltf",
         "AssetGenerator/Mesh_PrimitiveVertexColor/Mesh_PrimitiveVertexColor_05.gltf", 2e-3f},
        // With indices and without.
        {"Triangle/glTF/Triangle.gltf", "TriangleWithoutIndices/glTF-Embedded/TriangleWithoutIndices.gltf", 1e-6f},
        // Rotations of an animation in floats and bytes, by right angles; weights of joints in floats and bytes.
        {"AssetGenerator/Animation_Node/Animation_Node_01.gltf",
         "AssetGenerator/Animation_SamplerType/Animation_SamplerType_01.gltf", 1e-6f, 0.7},
        {"AssetGenerator/Animation_Skin/Animation_Skin_01.gltf",
         "AssetGenerator/Animation_SkinType/Animation_SkinType_01.gltf", 1e-6f},
        // Compressed and quantised forms.
        {"Box/glTF-Binary/Box.glb", "Box/glTF-Draco/Box.gltf", 2e-3f},
        {"Duck/glTF-Quantized/Duck.gltf", "Duck/glTF-Draco/Duck.gltf", 5e-3f},
        {"AnimatedMorphCube/glTF/AnimatedMorphCube.gltf", "AnimatedMorphCube/glTF-Quantized/AnimatedMorphCube.gltf",
         5e-3f},
    };
    std::set<std::string> missing = models_of_several_forms(manifest_files());
    EXPECT_FALSE(missing.empty());
    for (const Alike& pair : pairs) {
        const auto folder = test::shared_data() / "models";
        const auto picture = [&](const char* file) {
            return render(folder / file, "", 16, std::nullopt, pair.at_seconds).image;
        };
        const float mean = mean_difference(picture(pair.a), picture(pair.b));
        EXPECT_LE(mean, pair.largest_mean) << pair.a << " and " << pair.b;
        missing.erase(std::filesystem::path(pair.a).begin()->string());
    }
    for (const std::string& model : missing)
        ADD_FAILURE() << "the forms of " << model << " are compared nowhere";
}

TEST(RenderedModels, VariantsAndScenesDiffer) {
    const auto folder = test::shared_data() / "models";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "skipped: no shared data";
    const auto cube = folder / "MaterialsVariantsCube/18_variants.gltf";
    const ImageRgba32f red = render(cube, "Variant_Red").image, blue = render(cube, "Variant_Blue").image;
    EXPECT_GT(mean_difference(red, blue), 0.01f);
    EXPECT_EQ(difference(red, render(cube, "Variant_Red").image), 0.0f);
    const auto scenes = folder / "MultipleScenes/glTF-Embedded/MultipleScenes.gltf";
    const ImageRgba32f first = render(scenes, "", 4, 0).image, second = render(scenes, "", 4, 1).image;
    EXPECT_GT(mean_difference(first, second), 0.01f);
}

}  // namespace
}  // namespace candela
