// SPDX-License-Identifier: MIT
// Every way in which a file may store numbers, read back through the mesh attributes that hold them.
#include "tests/io/document.h"

namespace candela {
namespace {

using namespace test;

class Accessors : public GltfTest {
  protected:
    // TEXCOORD_0 of a triangle, from values of any component type.
    template <typename T>
    std::vector<Vec2> uv_of(const std::vector<T>& values, int component_type, bool normalized) {
        Document document = Document::triangle();
        const int uv = document.add_accessor(values, "VEC2", component_type, {{"normalized", normalized}});
        document.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = uv;
        return first(load(document)).uv[0];
    }
};

TEST_F(Accessors, AllComponentTypesAsTheyAre) {
    const std::vector<Vec2> expected = {{0, 1}, {100, 3}, {4, 127}};
    EXPECT_EQ(uv_of<int8_t>({0, 1, 100, 3, 4, 127}, i8, false), expected);
    EXPECT_EQ(uv_of<uint8_t>({0, 1, 100, 3, 4, 127}, u8, false), expected);
    EXPECT_EQ(uv_of<int16_t>({0, 1, 100, 3, 4, 127}, i16, false), expected);
    EXPECT_EQ(uv_of<uint16_t>({0, 1, 100, 3, 4, 127}, u16, false), expected);
    EXPECT_EQ(uv_of<uint32_t>({0, 1, 100, 3, 4, 127}, u32, false), expected);
    EXPECT_EQ(uv_of<float>({0, 1, 100, 3, 4, 127}, f32, false), expected);
    EXPECT_EQ(uv_of<int16_t>({-1, 1, -32768, 3, 4, 5}, i16, false)[1].x, -32768.0f);
}

TEST_F(Accessors, NormalizedIntegersSpanTheUnitInterval) {
    // glTF 2.0, section 3.6.2.2: both -128 and -127 mean -1.
    EXPECT_EQ(uv_of<int8_t>({-128, -127, 0, 127, 64, -64}, i8, true),
              (std::vector<Vec2>{{-1, -1}, {0, 1}, {64.0f / 127.0f, -64.0f / 127.0f}}));
    EXPECT_EQ(uv_of<uint8_t>({0, 255, 51, 102, 1, 254}, u8, true),
              (std::vector<Vec2>{{0, 1}, {0.2f, 0.4f}, {1.0f / 255.0f, 254.0f / 255.0f}}));
    EXPECT_EQ(uv_of<int16_t>({-32768, -32767, 0, 32767, 1, -1}, i16, true),
              (std::vector<Vec2>{{-1, -1}, {0, 1}, {1.0f / 32767.0f, -1.0f / 32767.0f}}));
    EXPECT_EQ(uv_of<uint16_t>({0, 65535, 13107, 1, 2, 3}, u16, true)[0], Vec2(0, 1));
    EXPECT_FLOAT_EQ(uv_of<uint16_t>({0, 65535, 13107, 1, 2, 3}, u16, true)[1].x, 0.2f);
}

TEST_F(Accessors, IndicesOfEveryWidth) {
    const auto triangle_of = [&](auto values, int component_type) {
        Document document = Document::triangle();
        const int indices = document.add_accessor(values, "SCALAR", component_type);
        document.json["meshes"][0]["primitives"][0]["indices"] = indices;
        return first(load(document)).triangles.at(0);
    };
    EXPECT_EQ(triangle_of(std::vector<uint8_t>{2, 0, 1}, u8), Vec3u(2, 0, 1));
    EXPECT_EQ(triangle_of(std::vector<uint16_t>{2, 0, 1}, u16), Vec3u(2, 0, 1));
    EXPECT_EQ(triangle_of(std::vector<uint32_t>{2, 0, 1}, u32), Vec3u(2, 0, 1));
}

TEST_F(Accessors, InterleavedAttributesFollowTheStride) {
    Document document;
    // Position and uv side by side, 20 bytes a vertex.
    const std::vector<float> data = {0, 0, 0, 0.1f, 0.2f, 1, 0, 0, 0.3f, 0.4f, 0, 1, 0, 0.5f, 0.6f};
    const int view = document.add_view(data.data(), data.size() * sizeof(float), 20);
    document.json["accessors"] = {
        {{"bufferView", view}, {"componentType", f32}, {"count", 3}, {"type", "VEC3"}},
        {{"bufferView", view}, {"byteOffset", 12}, {"componentType", f32}, {"count", 3}, {"type", "VEC2"}}};
    document.add_primitive({{"POSITION", 0}, {"TEXCOORD_0", 1}});
    const Primitive p = first(load(document));
    EXPECT_EQ(p.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(p.uv[0], (std::vector<Vec2>{{0.1f, 0.2f}, {0.3f, 0.4f}, {0.5f, 0.6f}}));
}

TEST_F(Accessors, SparseValuesReplaceTheBase) {
    Document document = Document::triangle();
    const std::vector<uint8_t> where = {1, 2};
    const std::vector<float> values = {5, 6, 7, 8, 9, 10};
    const Json sparse = {{"count", 2},
                         {"indices", {{"bufferView", document.add_view(where.data(), 2)}, {"componentType", u8}}},
                         {"values", {{"bufferView", document.add_view(values.data(), 24)}}}};
    document.json["accessors"][0]["sparse"] = sparse;
    EXPECT_EQ(first(load(document)).positions, (std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {8, 9, 10}}));

    // Without a view the base is zeros.
    document.json["accessors"][0].erase("bufferView");
    EXPECT_EQ(first(load(document)).positions, (std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {8, 9, 10}}));
    document.json["accessors"][0].erase("sparse");
    EXPECT_EQ(first(load(document)).positions, std::vector<Vec3>(3, Vec3(0)));
}

TEST_F(Accessors, SparseIndicesOutOfRangeAreRefused) {
    Document document = Document::triangle();
    const std::vector<uint16_t> where = {1, 3};
    const std::vector<float> values = {5, 6, 7, 8, 9, 10};
    document.json["accessors"][0]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", document.add_view(where.data(), 4)}, {"componentType", u16}}},
        {"values", {{"bufferView", document.add_view(values.data(), 24)}}}};
    EXPECT_EQ(failure(document), "/accessors/0/sparse/indices: index 3 is not below the count of 3");
}

TEST_F(Accessors, QuantizedPositionsAndNormals) {
    Document document;
    document.json["extensionsUsed"] = document.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    // Three int16 padded to 8 bytes, three normalized int8 padded to 4.
    const std::vector<int16_t> positions = {0, 0, 0, 9, 1000, 0, 0, 9, 0, -1000, 0, 9};
    const std::vector<int8_t> normals = {0, 0, 127, 9, 0, 0, 127, 9, 0, 0, 127, 9};
    document.json["accessors"] = {{{"bufferView", document.add_view(positions.data(), 24, 8)},
                                   {"componentType", i16},
                                   {"count", 3},
                                   {"type", "VEC3"}},
                                  {{"bufferView", document.add_view(normals.data(), 12, 4)},
                                   {"componentType", i8},
                                   {"normalized", true},
                                   {"count", 3},
                                   {"type", "VEC3"}}};
    document.add_primitive({{"POSITION", 0}, {"NORMAL", 1}});
    document.json["nodes"][0]["scale"] = {0.001, 0.001, 0.001};
    const Scene scene = load(document);
    EXPECT_EQ(first(scene).positions[2], Vec3(0, -1000, 0));
    EXPECT_EQ(first(scene).normals[1], Vec3(0, 0, 1));
    EXPECT_NEAR((scene.instances.at(0).world_from_object * Vec4(first(scene).positions[1], 1)).x, 1.0f, 1e-6f);
    EXPECT_EQ(all_warnings(), "");
}

TEST_F(Accessors, VertexColoursInEveryForm) {
    const auto color_of = [&](auto values, const char* type, int component_type) {
        Document document = Document::triangle();
        const int color = document.add_accessor(values, type, component_type, {{"normalized", component_type != f32}});
        document.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = color;
        return first(load(document)).colors.at(1);
    };
    EXPECT_EQ(color_of(std::vector<float>{1, 1, 1, 0.5f, 0.25f, 2, 1, 1, 1}, "VEC3", f32), Vec4(0.5f, 0.25f, 2, 1));
    EXPECT_EQ(color_of(std::vector<uint8_t>{0, 0, 0, 0, 255, 51, 0, 102, 0, 0, 0, 0}, "VEC4", u8),
              Vec4(1, 0.2f, 0, 0.4f));
    EXPECT_EQ(color_of(std::vector<uint16_t>{0, 0, 0, 0, 65535, 0, 0, 65535, 0, 0, 0, 0}, "VEC4", u16),
              Vec4(1, 0, 0, 1));
}

}  // namespace
}  // namespace candela
