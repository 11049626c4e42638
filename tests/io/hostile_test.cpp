// SPDX-License-Identifier: MIT
// Files made to hurt: every value of a document replaced by something nasty, every byte region of a container damaged.
// Whatever loads must keep what the renderer relies on; what does not must end in LoadError.
#include <random>

#include "renderer/scene/animation.h"
#include "renderer/scene/pose.h"
#include "tests/io/document.h"
#include "tests/support/soundness.h"

namespace candela {
namespace {

using namespace test;

// One document that uses most of what the loader reads.
Document everything() {
    Document document = Document::triangle();
    Json& json = document.json;
    const int normals = document.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", f32);
    const int uv = document.add_accessor<uint8_t>({0, 0, 255, 0, 0, 255}, "VEC2", u8, {{"normalized", true}});
    const int color = document.add_accessor<uint16_t>({0, 0, 0, 1, 1, 1, 2, 2, 2}, "VEC3", u16);
    const std::vector<uint16_t> where = {1};
    const std::vector<float> values = {2, 0, 0};
    json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", document.add_view(where.data(), 2)}, {"componentType", u16}}},
        {"values", {{"bufferView", document.add_view(values.data(), 12)}}}};
    Json& primitive = json["meshes"][0]["primitives"][0];
    primitive["attributes"].update({{"NORMAL", normals}, {"TEXCOORD_0", uv}, {"COLOR_0", color}});
    primitive["material"] = 0;
    primitive["mode"] = 5;
    primitive["targets"] = {{{"POSITION", 0}}, {{"NORMAL", normals}}};
    const int joints = document.add_accessor<uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4", u8);
    const int weights = document.add_accessor<float>({1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0.25f, 0.75f, 0, 0}, "VEC4", f32);
    primitive["attributes"].update({{"JOINTS_0", joints}, {"WEIGHTS_0", weights}});
    json["meshes"][0]["weights"] = {0.5, 0};
    json["images"] = {{{"uri", "data:image/png;base64,AAAA"}, {"name", "n"}}, {{"bufferView", 0}}};
    json["samplers"] = {{{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}}};
    json["textures"] = {{{"source", 0}, {"sampler", 0}},
                        {{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}}};
    const Json transform = {
        {"KHR_texture_transform", {{"offset", {1, 2}}, {"rotation", 1}, {"scale", {1, 2}}, {"texCoord", 0}}}};
    json["materials"] = {
        {{"name", "m"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {1, 1, 1, 1}},
           {"metallicFactor", 1},
           {"roughnessFactor", 1},
           {"baseColorTexture", {{"index", 0}, {"texCoord", 0}, {"extensions", transform}}},
           {"metallicRoughnessTexture", {{"index", 1}}}}},
         {"normalTexture", {{"index", 1}, {"scale", 1}}},
         {"occlusionTexture", {{"index", 1}, {"strength", 1}}},
         {"emissiveTexture", {{"index", 1}}},
         {"emissiveFactor", {1, 1, 1}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.5},
         {"doubleSided", true},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 2}}},
           {"KHR_materials_ior", {{"ior", 2}}},
           {"KHR_materials_specular",
            {{"specularFactor", 1}, {"specularColorFactor", {1, 1, 1}}, {"specularTexture", {{"index", 0}}}}},
           {"KHR_materials_clearcoat",
            {{"clearcoatFactor", 1},
             {"clearcoatRoughnessFactor", 0.1},
             {"clearcoatNormalTexture", {{"index", 0}, {"scale", 1}}}}},
           {"KHR_materials_sheen", {{"sheenColorFactor", {1, 1, 1}}, {"sheenRoughnessFactor", 1}}},
           {"KHR_materials_iridescence",
            {{"iridescenceFactor", 1}, {"iridescenceIor", 1.3}, {"iridescenceThicknessMaximum", 300}}},
           {"KHR_materials_anisotropy", {{"anisotropyStrength", 1}, {"anisotropyTexture", {{"index", 0}}}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 1}, {"transmissionTexture", {{"index", 0}}}}},
           {"KHR_materials_diffuse_transmission", {{"diffuseTransmissionColorFactor", {1, 1, 1}}}},
           {"KHR_materials_volume",
            {{"thicknessFactor", 1}, {"attenuationDistance", 1}, {"attenuationColor", {1, 1, 1}}}},
           {"KHR_materials_dispersion", {{"dispersion", 1}}}}}}};
    json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"aspectRatio", 1}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}}};
    json["extensions"] = {{"KHR_lights_punctual",
                           {{"lights",
                             {{{"type", "spot"},
                               {"color", {1, 1, 1}},
                               {"intensity", 1},
                               {"range", 1},
                               {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}}}}}}};
    json["nodes"] = {{{"mesh", 0}, {"children", {1, 2}}, {"translation", {1, 2, 3}}, {"rotation", {0, 0, 0, 1}}},
                     {{"camera", 0},
                      {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                      {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
                     {{"camera", 1}, {"scale", {1, 2, 3}}, {"skin", 0}, {"mesh", 0}}};
    std::vector<float> bind(32, 0.0f);
    for (size_t i = 0; i < 32; i += i % 16 == 15 ? 1 : 5)
        bind[i] = 1.0f;
    json["skins"] = {{{"joints", {0, 1}}, {"inverseBindMatrices", document.add_accessor<float>(bind, "MAT4", f32)}}};
    json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_texture_transform"};
    json["extensionsRequired"] = {"KHR_lights_punctual"};
    const int times = document.add_accessor<float>({0, 1}, "SCALAR", f32);
    const int rotations =
        document.add_accessor<int16_t>({0, 0, 0, 32767, 0, 32767, 0, 0}, "VEC4", i16, {{"normalized", true}});
    const int splines =
        document.add_accessor<float>({0, 0, 0, 1, 1, 1, 2, 2, 2, 0, 0, 0, 3, 3, 3, 0, 0, 0}, "VEC3", f32);
    const int morphs = document.add_accessor<float>({0, 1, 1, 0}, "SCALAR", f32);
    const auto channel = [](int sampler, int node, const char* path) {
        return Json{{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
    };
    json["animations"] = {
        {{"name", "a"},
         {"samplers",
          {{{"input", times}, {"output", rotations}},
           {{"input", times}, {"output", splines}, {"interpolation", "CUBICSPLINE"}},
           {{"input", times}, {"output", morphs}, {"interpolation", "STEP"}}}},
         {"channels",
          {channel(0, 0, "rotation"),
           channel(1, 1, "translation"),
           channel(2, 2, "weights"),
           {{"sampler", 2},
            {"target",
             {{"path", "pointer"},
              {"extensions", {{"KHR_animation_pointer", {{"pointer", "/materials/0/alphaCutoff"}}}}}}}}}}}};
    json["asset"]["generator"] = "test";
    return document;
}

void expect_sound(const Scene& scene, const std::string& what) {
    ASSERT_EQ(unsoundness_of(scene), "") << what;
}

class Hostile : public GltfTest {
  protected:
    // Returns whether it loaded.
    bool try_load(const std::string& name, const std::string& text, const std::string& what) {
        try {
            const auto rest = std::make_shared<const Scene>(load_file(write(name, text)));
            expect_sound(*rest, what);
            for (uint32_t a = 0; a < rest->animations.size(); ++a)
                expect_sound(*posed_scene(rest, a, 0.4f), what);
            return true;
        } catch (const LoadError& error) {
            EXPECT_FALSE(error.reason().empty()) << what;
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << what;
            return false;
        }
    }
    void SetUp() override {
        GltfTest::SetUp();
        options_.decode_images = true;
        options_.max_memory_bytes = uint64_t{64} << 20;
    }
};

// All places of a document, inner ones too.
void list_pointers(const Json& value, const Json::json_pointer& at, std::vector<Json::json_pointer>& out) {
    out.push_back(at);
    if (value.is_object()) {
        for (auto member = value.begin(); member != value.end(); ++member)
            list_pointers(member.value(), at / member.key(), out);
    } else if (value.is_array()) {
        for (size_t i = 0; i < value.size(); ++i)
            list_pointers(value[i], at / i, out);
    }
}

TEST_F(Hostile, EveryValueReplaced) {
    Document document = everything();
    document.finish("data.bin");
    write("data.bin", {document.bytes.begin(), document.bytes.end()});
    ASSERT_TRUE(try_load("scene.gltf", document.json.dump(), "untouched")) << failure(document);

    std::vector<Json::json_pointer> places;
    list_pointers(document.json, Json::json_pointer(), places);
    ASSERT_GT(places.size(), 250u);
    const std::vector<Json> nasty = {nullptr,
                                     -1,
                                     0,
                                     1,
                                     3,
                                     0.5,
                                     1e308,
                                     -1e30,
                                     4294967295,
                                     9223372036854775807,
                                     "",
                                     "x",
                                     true,
                                     Json::array(),
                                     Json::object(),
                                     Json::array({0}),
                                     Json::array({Json::object()})};
    int loaded = 0, tried = 0;
    for (const Json::json_pointer& place : places) {
        options_.decode_images = place.to_string().rfind("/images", 0) == 0;
        for (const Json& value : nasty) {
            Json broken = document.json;
            broken[place] = value;
            loaded += try_load("scene.gltf", broken.dump(), place.to_string() + " = " + value.dump());
            ++tried;
            if (HasFatalFailure()) return;
        }
        if (place.empty()) continue;
        Json missing = document.json;
        Json& parent = missing[place.parent_pointer()];
        if (parent.is_object()) {
            parent.erase(place.back());
        } else {
            parent.erase(static_cast<size_t>(std::stoul(place.back())));
        }
        loaded += try_load("scene.gltf", missing.dump(), place.to_string() + " erased");
        ++tried;
    }
    // Both happen: nothing is refused wholesale, and nothing passes unseen.
    EXPECT_GT(loaded, tried / 10);
    EXPECT_LT(loaded, tried * 3 / 4);
}

TEST_F(Hostile, DamagedContainers) {
    Document document = everything();
    document.finish("");
    const std::string glb = glb_bytes(document.json.dump(), {document.bytes.begin(), document.bytes.end()});
    ASSERT_TRUE(try_load("scene.glb", glb, "untouched"));
    std::mt19937 random(7);
    const auto below = [&](size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(random); };
    int loaded = 0;
    constexpr int rounds = 3000;
    for (int round = 0; round < rounds; ++round) {
        options_.decode_images = round % 10 == 0;
        std::string damaged = glb;
        const size_t changes = 1 + below(4);
        for (size_t i = 0; i < changes; ++i) {
            // Every third change strikes the headers.
            const size_t at = below(3) == 0 ? below(24) : below(damaged.size());
            damaged[at] = static_cast<char>(below(256));
        }
        if (below(4) == 0) damaged.resize(below(damaged.size()));
        loaded += try_load("scene.glb", damaged, "round " + std::to_string(round));
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(loaded, rounds / 50);
}

// Bytes of the vertex data at random: NaN, infinities, denormals and indices out of range.
TEST_F(Hostile, DamagedVertexData) {
    Document document = everything();
    document.finish("data.bin");
    std::mt19937 random(11);
    int loaded = 0;
    options_.decode_images = false;
    for (int round = 0; round < 1000; ++round) {
        std::string bytes(document.bytes.begin(), document.bytes.end());
        const size_t first = std::uniform_int_distribution<size_t>(0, bytes.size() - 8)(random);
        for (size_t i = first; i < std::min(bytes.size(), first + 40); ++i) {
            bytes[i] = static_cast<char>(random() % 4 == 0 ? 0xff : random() % 256);
        }
        write("data.bin", bytes);
        loaded += try_load("scene.gltf", document.json.dump(), "round " + std::to_string(round));
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(loaded, 300);
}

}  // namespace
}  // namespace candela
