// SPDX-License-Identifier: MIT
// Where a texture's pixels come from: KHR_texture_basisu and its fallbacks, pictures in data: URIs, samplers.
#include "tests/io/document.h"
#include "tests/support/ktx2_writer.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

using namespace test;

std::string base64(const Bytes& bytes) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        const size_t here = std::min<size_t>(3, bytes.size() - i);
        for (size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < here ? static_cast<uint32_t>(bytes[i + k]) : 0);
        for (size_t k = 0; k < 4; ++k)
            out += k <= here ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

// 4 × 4 texels of one colour.
Bytes ktx2(int transfer = 2) {
    Ktx2Parts parts;
    parts.transfer = transfer;
    parts.levels = {solid_uastc_block(10, 200, 30, 128)};
    return write_ktx2(parts);
}
const Rgba8 ktx2_color(10, 200, 30, 128);

// 2 × 2 texels (10, 200, 30), WebP lossless; 1 × 1 red, PNG.
const char* const webp = "UklGRh4AAABXRUJQVlA4TBEAAAAvAUAAAAdQ5CrUo/+BiOh/AAA=";
const char* const red_png =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8DwHwAFBQIAX8jx0gAAAABJRU5ErkJggg==";

class Images : public GltfTest {
  protected:
    void SetUp() override {
        GltfTest::SetUp();
        options_.decode_images = true;
    }
    // A material whose base colour is texture 0.
    static Document textured(const Json& texture, const std::vector<Json>& images) {
        Document document = Document::triangle();
        const int uv = document.add_accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2", f32);
        Json& primitive = document.json["meshes"][0]["primitives"][0];
        primitive["attributes"]["TEXCOORD_0"] = uv;
        primitive["material"] = 0;
        document.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
        document.json["textures"] = {texture};
        document.json["images"] = images;
        return document;
    }
    static Json basisu(int source, int fallback = -1) {
        Json texture = {{"extensions", {{"KHR_texture_basisu", {{"source", source}}}}}};
        if (fallback >= 0) texture["source"] = fallback;
        return texture;
    }
    // The colour of the image that texture 0 shows.
    static Rgba8 shown(const Scene& scene) { return (*scene.images.at(scene.textures.at(0).image.value).pixels)(0, 0); }
    static Json data_uri(const std::string& type, const std::string& body) {
        return {{"uri", "data:" + type + ";base64," + body}};
    }
};

TEST_F(Images, BasisuIsRenderedAlsoWhenRequired) {
    Document document = textured(basisu(0), {data_uri("image/ktx2", base64(ktx2()))});
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        document.json[list] = {"KHR_texture_basisu"};
    const Scene scene = load(document);
    EXPECT_EQ(shown(scene), ktx2_color);
    ASSERT_EQ(scene.extensions.size(), 1u);
    EXPECT_EQ(scene.extensions[0].treatment, ExtensionUse::Treatment::rendered);
    EXPECT_TRUE(diagnostics_.warnings().empty()) << all_warnings();
}

TEST_F(Images, BasisuComesBeforeItsFallbackFromFilesAndViews) {
    const Bytes bytes = ktx2();
    Document document = textured(basisu(1, 0), {data_uri("image/png", red_png), {{"uri", "a.ktx2"}}});
    write("a.ktx2", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    EXPECT_EQ(shown(load(document)), ktx2_color);
    const int view = document.add_view(bytes.data(), bytes.size());
    document.json["images"][1] = {{"bufferView", view}, {"mimeType", "image/ktx2"}};
    EXPECT_EQ(shown(load(document)), ktx2_color);
    EXPECT_TRUE(diagnostics_.warnings().empty()) << all_warnings();
}

TEST_F(Images, DamagedImagesOfExtensionsGiveWayToTheFallback) {
    Bytes damaged = ktx2();
    damaged.resize(damaged.size() - 1);
    const Json broken = data_uri("image/ktx2", base64(damaged));
    Document document = textured(basisu(0, 1), {broken, data_uri("image/png", red_png)});
    EXPECT_EQ(shown(load(document)), Rgba8(255, 0, 0, 255));
    EXPECT_TRUE(warned("/images/0", "mip level 0 lies outside of the file; the texture's other image"))
        << all_warnings();
    EXPECT_EQ(diagnostics_.warnings().size(), 1u) << all_warnings();

    // Nothing to give way to: none, the same, or one that is damaged as well.
    EXPECT_EQ(shown(load(textured(basisu(0), {broken}))), Rgba8(255));
    EXPECT_TRUE(warned("/images/0", "; white is used")) << all_warnings();
    EXPECT_EQ(shown(load(textured(basisu(0, 0), {broken}))), Rgba8(255));
    EXPECT_TRUE(warned("/images/0", "; white is used")) << all_warnings();
    EXPECT_EQ(shown(load(textured(basisu(0, 1), {broken, {{"uri", "missing.png"}}}))), Rgba8(255));
    EXPECT_TRUE(warned("/images/1/uri", "; white is used")) << all_warnings();

    // A missing WebP likewise.
    const Json texture = {{"source", 1}, {"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
    EXPECT_EQ(shown(load(textured(texture, {{{"uri", "missing.webp"}}, data_uri("image/png", red_png)}))),
              Rgba8(255, 0, 0, 255));
}

// A lost normal texture is left out, but not one that has a fallback.
TEST_F(Images, NormalTexturesFallBackToo) {
    Document document = textured(basisu(0, 1), {{{"uri", "missing.ktx2"}}, data_uri("image/png", red_png)});
    document.json["materials"][0] = {{"normalTexture", {{"index", 0}}}};
    EXPECT_TRUE(load(document).materials.at(0).normal.valid());
    document.json["textures"][0].erase("source");
    EXPECT_FALSE(load(document).materials.at(0).normal.valid());
}

TEST_F(Images, ColourSpacesThatDisagreeWithTheUseAreSaid) {
    EXPECT_EQ(shown(load(textured(basisu(0), {data_uri("image/ktx2", base64(ktx2(1)))}))), ktx2_color);
    EXPECT_TRUE(warned("/images/0", "linear but is used as sRGB")) << all_warnings();
    Document document = textured(basisu(0), {data_uri("image/ktx2", base64(ktx2(2)))});
    document.json["materials"][0] = {{"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}}}};
    EXPECT_EQ(shown(load(document)), ktx2_color);
    EXPECT_TRUE(warned("/images/0", "sRGB but is used as data")) << all_warnings();
    document.json["materials"][0]["emissiveTexture"] = {{"index", 0}};
    for (const int transfer : {1, 2}) {
        document.json["images"] = {data_uri("image/ktx2", base64(ktx2(transfer))), Json::object()};
        load(document);
        EXPECT_TRUE(diagnostics_.warnings().empty()) << "used as both\n" << all_warnings();
    }
}

TEST_F(Images, WebpInDataUris) {
    const Json texture = {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
    EXPECT_EQ(shown(load(textured(texture, {data_uri("image/webp", webp)}))), Rgba8(10, 200, 30, 255));
    EXPECT_TRUE(diagnostics_.warnings().empty()) << all_warnings();
}

TEST_F(Images, SourcesOfTheExtensionAreChecked) {
    EXPECT_NE(failure(textured(basisu(3), {data_uri("image/png", red_png)})).find("KHR_texture_basisu/source"),
              std::string::npos);
    EXPECT_NE(failure(textured({{"extensions", {{"KHR_texture_basisu", 4}}}}, {data_uri("image/png", red_png)}))
                  .find("/textures/0/extensions/KHR_texture_basisu"),
              std::string::npos);
}

// All wrap modes on both axes, both magnification and all six minification filters; whatever is not glTF's is said and
// replaced.
TEST_F(Images, SamplerModes) {
    const std::pair<int, WrapMode> wraps[] = {
        {10497, WrapMode::repeat}, {33071, WrapMode::clamp_to_edge}, {33648, WrapMode::mirrored_repeat}};
    Document document = textured({{"source", 0}, {"sampler", 0}}, {data_uri("image/png", red_png)});
    for (const auto& [s_number, s] : wraps) {
        for (const auto& [t_number, t] : wraps) {
            document.json["samplers"] = {{{"wrapS", s_number}, {"wrapT", t_number}}};
            const Texture texture = load(document).textures.at(0);
            EXPECT_EQ(texture.wrap_u, s) << s_number;
            EXPECT_EQ(texture.wrap_v, t) << t_number;
        }
    }
    document.json["samplers"] = {Json::object()};
    EXPECT_EQ(load(document).textures.at(0).wrap_u, WrapMode::repeat);
    EXPECT_EQ(load(document).textures.at(0).mag_filter, TextureFilter::linear);
    document.json["samplers"] = {{{"magFilter", 9728}}};
    EXPECT_EQ(load(document).textures.at(0).mag_filter, TextureFilter::nearest);
    const std::tuple<int, TextureFilter, MipFilter> minifications[] = {
        {9728, TextureFilter::nearest, MipFilter::none},    {9729, TextureFilter::linear, MipFilter::none},
        {9984, TextureFilter::nearest, MipFilter::nearest}, {9985, TextureFilter::linear, MipFilter::nearest},
        {9986, TextureFilter::nearest, MipFilter::linear},  {9987, TextureFilter::linear, MipFilter::linear}};
    for (const auto& [number, filter, mip_filter] : minifications) {
        document.json["samplers"] = {{{"magFilter", 9729}, {"minFilter", number}}};
        const Texture texture = load(document).textures.at(0);
        EXPECT_EQ(texture.mag_filter, TextureFilter::linear);
        EXPECT_EQ(texture.min_filter, filter) << number;
        EXPECT_EQ(texture.mip_filter, mip_filter) << number;
        EXPECT_TRUE(diagnostics_.warnings().empty()) << all_warnings();
    }
    for (const char* member : {"wrapS", "wrapT", "magFilter", "minFilter"}) {
        document.json["samplers"] = {{{member, 1234}}};
        load(document);
        EXPECT_TRUE(warned(std::string("/samplers/0/") + member, "of glTF")) << all_warnings();
    }
}

TEST_F(Images, TheSharedLampHasItsTextures) {
    const auto path = shared_data() / "models/AnisotropyBarnLamp/glTF-KTX2-Basisu/AnisotropyBarnLamp.gltf";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "skipped: no shared data";
    const Scene scene = load_file(path);
    for (const SceneImage& image : scene.images)
        EXPECT_EQ(image.pixels->width(), 2048) << image.name;
    EXPECT_TRUE(diagnostics_.warnings().empty()) << all_warnings();
}

}  // namespace
}  // namespace candela
