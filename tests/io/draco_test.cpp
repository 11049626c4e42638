// SPDX-License-Identifier: MIT
// KHR_draco_mesh_compression on documents made here, and on the shared models that exist in two forms.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include "tests/io/document.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

using namespace test;

constexpr const char* name = "KHR_draco_mesh_compression";

// Two triangles over the corners of a square, with whatever attributes a test adds in the order of their ids.
class Square {
  public:
    static constexpr int corner_of[2][3] = {{0, 1, 2}, {2, 1, 3}};

    Square() { builder_.Start(2); }
    template <typename T>
    Square& add(draco::GeometryAttribute::Type kind, draco::DataType type, int components, const std::vector<T>& values,
                bool normalized = false) {
        const int id = builder_.AddAttribute(kind, static_cast<int8_t>(components), type, normalized);
        for (uint32_t f = 0; f < 2; ++f) {
            const auto corner = [&](int c) { return &values[static_cast<size_t>(corner_of[f][c] * components)]; };
            builder_.SetAttributeValuesForFace(id, draco::FaceIndex(f), corner(0), corner(1), corner(2));
        }
        return *this;
    }
    Square& add_positions() {
        return add<float>(draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3,
                          {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5f});
    }
    std::vector<char> encode(draco::MeshEncoderMethod method = draco::MESH_SEQUENTIAL_ENCODING) {
        const std::unique_ptr<draco::Mesh> mesh = builder_.Finalize();
        draco::Encoder encoder;
        encoder.SetEncodingMethod(method);
        draco::EncoderBuffer buffer;
        EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
        return *buffer.buffer();
    }

  private:
    draco::TriangleSoupMeshBuilder builder_;
};

class Draco : public GltfTest {
  protected:
    // A mesh of four vertices whose accessors have no data of their own.
    static Document document_of(const std::vector<char>& encoded) {
        Document document;
        document.json["extensionsUsed"] = {name};
        document.json["extensionsRequired"] = {name};
        const int view = document.add_view(encoded.data(), encoded.size());
        const int positions = add_empty(document, f32, "VEC3", 4);
        const int indices = add_empty(document, u16, "SCALAR", 6);
        Json& primitive = document.add_primitive({{"POSITION", positions}}, indices);
        primitive["extensions"][name] = {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
        return document;
    }
    static int add_empty(Document& document, int component, const char* type, int count, bool normalized = false) {
        Json accessor = {{"componentType", component}, {"count", count}, {"type", type}};
        if (normalized) accessor["normalized"] = true;
        document.json["accessors"].push_back(accessor);
        return static_cast<int>(document.json["accessors"].size()) - 1;
    }
    static Json& primitive_of(Document& document) { return document.json["meshes"][0]["primitives"][0]; }
    static void add_attribute(Document& document, const char* attribute, int id, int accessor) {
        primitive_of(document)["attributes"][attribute] = accessor;
        primitive_of(document)["extensions"][name]["attributes"][attribute] = id;
    }
    const std::string place_ = std::string("/meshes/0/primitives/0/extensions/") + name;
};

TEST_F(Draco, PositionsAndTrianglesOfBothEncodings) {
    for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const Primitive p = first(load(document_of(Square().add_positions().encode(method))));
        ASSERT_EQ(p.positions.size(), 4u);
        ASSERT_EQ(p.triangles.size(), 2u);
        float area = 0;
        for (const Vec3u& t : p.triangles) {
            const Vec3 twice = glm::cross(p.positions[t.y] - p.positions[t.x], p.positions[t.z] - p.positions[t.x]);
            EXPECT_GT(twice.z, 0.0f) << "the winding stays";
            area += 0.5f * twice.z;
        }
        EXPECT_NEAR(area, 1.0f, 1e-3f);
    }
}

TEST_F(Draco, AttributesReadAsTheirAccessorsSay) {
    const auto generic = draco::GeometryAttribute::GENERIC;
    Square square;
    square.add_positions()
        .add<uint8_t>(draco::GeometryAttribute::COLOR, draco::DT_UINT8, 4,
                      {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 51, 51, 51, 0}, true)
        .add<uint16_t>(draco::GeometryAttribute::TEX_COORD, draco::DT_UINT16, 2,
                       {0, 0, 65535, 0, 0, 65535, 65535, 65535}, true)
        .add<uint16_t>(generic, draco::DT_UINT16, 2, {0, 0, 65535, 0, 0, 65535, 65535, 65535}, true)
        .add<float>(generic, draco::DT_FLOAT32, 4, {1, 0, 0, 1, 0, 1, 0, -1, 0, 0, 1, 1, 1, 0, 0, 1});
    Document document = document_of(square.encode());
    add_attribute(document, "COLOR_0", 1, add_empty(document, u8, "VEC4", 4, true));
    add_attribute(document, "TEXCOORD_0", 2, add_empty(document, u16, "VEC2", 4, true));
    // Integers where the accessor promises floats, and floats where it promises integers.
    add_attribute(document, "TEXCOORD_1", 3, add_empty(document, f32, "VEC2", 4));
    add_attribute(document, "TANGENT", 4, add_empty(document, i16, "VEC4", 4, true));
    document.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    document.json["images"] = {{{"uri", "n.png"}}};
    document.json["textures"] = {{{"source", 0}}};
    primitive_of(document)["material"] = 0;
    const std::vector<float> up = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    primitive_of(document)["attributes"]["NORMAL"] = document.add_accessor(up, "VEC3", f32);
    const Primitive p = first(load(document));
    ASSERT_EQ(p.colors.size(), 4u) << all_warnings();
    ASSERT_EQ(p.uv[0].size(), 4u);
    ASSERT_EQ(p.uv[1].size(), 4u);
    ASSERT_EQ(p.tangents.size(), 4u);
    for (size_t i = 0; i < 4; ++i) {
        // Which of the corners it is: the order is the encoder's.
        const int corner = static_cast<int>(std::lround(p.positions[i].x + 2 * p.positions[i].y));
        const Vec4 colors[] = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {0.2f, 0.2f, 0.2f, 0}};
        const Vec4 tangents[] = {{1, 0, 0, 1}, {0, 1, 0, -1}, {0, 0, 1, 1}, {1, 0, 0, 1}};
        const Vec2 uvs[] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
        EXPECT_NEAR(glm::distance(p.colors[i], colors[corner]), 0.0f, 1e-6f);
        EXPECT_NEAR(glm::distance(p.tangents[i], tangents[corner]), 0.0f, 1e-4f);
        EXPECT_NEAR(glm::distance(p.uv[0][i], uvs[corner]), 0.0f, 1e-3f);
        EXPECT_NEAR(glm::distance(p.uv[1][i], uvs[corner]), 0.0f, 1e-3f);
    }
}

TEST_F(Draco, OneViewMayServeSeveralPrimitives) {
    Square square;
    square.add_positions().add<float>(draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3,
                                      {5, 0, 0, 6, 0, 0, 5, 1, 0, 6, 1, 0});
    Document document = document_of(square.encode());
    document.json["meshes"][0]["primitives"].push_back(primitive_of(document));
    Json& second = document.json["meshes"][0]["primitives"][1];
    second["attributes"]["POSITION"] = add_empty(document, f32, "VEC3", 4);
    second["extensions"][name]["attributes"]["POSITION"] = 1;
    const Scene scene = load(document);
    ASSERT_EQ(scene.meshes.at(0)->primitives.size(), 2u);
    EXPECT_EQ(unique_triangle_count(scene), 4u);
    for (const Vec3& p : scene.meshes[0]->primitives[0].positions)
        EXPECT_LT(p.x, 1.1f);
    for (const Vec3& p : scene.meshes[0]->primitives[1].positions)
        EXPECT_GT(p.x, 4.9f);
}

TEST_F(Draco, CountsAndIdsAreChecked) {
    const std::vector<char> encoded = Square().add_positions().encode();
    const auto with = [&](const std::function<void(Document&)>& change) {
        Document document = document_of(encoded);
        change(document);
        return failure(document);
    };
    EXPECT_EQ(with([](Document&) {}), "loaded");
    EXPECT_EQ(with([](Document& d) { primitive_of(d)["extensions"][name]["attributes"]["POSITION"] = 7; }),
              place_ + ": the compressed data has no attribute of id 7");
    EXPECT_EQ(with([](Document& d) { d.json["accessors"][0]["count"] = 5; }),
              place_ + ": the compressed data holds 4 vertices, but /accessors/0/count is 5");
    EXPECT_EQ(with([](Document& d) { d.json["accessors"][1]["count"] = 9; }),
              place_ + ": the compressed data holds 6 corners, but /accessors/1/count is 9");
    EXPECT_EQ(with([](Document& d) { d.json["accessors"][0]["type"] = "VEC4"; }),
              place_ + ": the compressed data has another number of components");
    EXPECT_EQ(with([](Document& d) { primitive_of(d).erase("indices"); }),
              place_ + ": compresses indices, but the primitive has none");
    EXPECT_EQ(with([](Document& d) { primitive_of(d)["mode"] = 0; }),
              place_ + ": compresses only triangles, but the primitive's mode is 0");
    EXPECT_EQ(with([](Document& d) { primitive_of(d)["extensions"][name].erase("attributes"); }),
              place_ + "/attributes: is required but missing");
    // Some integers do not fit into a narrow type.
    EXPECT_EQ(with([](Document& d) { d.json["accessors"][0]["componentType"] = i8; }), "loaded");
    options_.max_memory_bytes = 2000;
    EXPECT_NE(with([](Document&) {}).find("memory limit"), std::string::npos);
}

TEST_F(Draco, DamagedDataIsRefusedOrReplacedByTheUncompressed) {
    const std::vector<char> good = Square().add_positions().encode();
    std::vector<char> damaged = good;
    damaged[0] = 'X';
    EXPECT_EQ(failure(document_of(damaged)), place_ + ": the compressed data is not Draco's");

    // With data of their own in the accessors, and the extension only used, that is what counts.
    Document document = document_of(damaged);
    const int positions = document.add_accessor<float>({0, 0, 0, 2, 0, 0, 0, 2, 0, 2, 2, 0}, "VEC3", f32);
    const int indices = document.add_accessor<uint16_t>({0, 1, 2, 2, 1, 3}, "SCALAR", u16);
    primitive_of(document)["attributes"]["POSITION"] = positions;
    primitive_of(document)["indices"] = indices;
    EXPECT_EQ(failure(document), place_ + ": the compressed data is not Draco's") << "the extension is required";
    document.json.erase("extensionsRequired");
    EXPECT_EQ(first(load(document)).positions.at(1), Vec3(2, 0, 0));
    EXPECT_TRUE(warned(place_, "the uncompressed data is used")) << all_warnings();

    // Whatever is cut off or flipped, there is an error or a mesh whose indices are in range.
    for (size_t length = 0; length < good.size(); ++length)
        EXPECT_NE(
            failure(document_of({good.begin(), good.begin() + static_cast<int64_t>(std::max<size_t>(length, 1))})),
            "loaded");
    for (size_t i = 0; i < good.size(); ++i) {
        for (const int bit : {0, 3, 7}) {
            std::vector<char> flipped = good;
            flipped[i] = static_cast<char>(flipped[i] ^ (1 << bit));
            failure_of([&] {
                const Scene scene = load(document_of(flipped));
                for (const Vec3u& t : first(scene).triangles)
                    ASSERT_LT(std::max({t.x, t.y, t.z}), first(scene).positions.size());
            });
        }
    }
}

// Every vertex of one form has one of the other form nearby, in all that it carries.
void expect_near_vertices(const Primitive& a, const Primitive& b, float position_step, float normal_step,
                          float uv_step) {
    for (size_t i = 0; i < a.positions.size(); ++i) {
        float best = infinity;
        for (size_t k = 0; k < b.positions.size(); ++k) {
            float worst = glm::distance(a.positions[i], b.positions[k]) / position_step;
            worst = std::max(worst, glm::distance(a.normals[i], b.normals[k]) / normal_step);
            if (!a.uv[0].empty()) worst = std::max(worst, glm::distance(a.uv[0][i], b.uv[0][k]) / uv_step);
            best = std::min(best, worst);
        }
        ASSERT_LE(best, 1.0f) << "vertex " << i;
    }
}

class DracoModels : public ::testing::Test {
  protected:
    static Primitive only_primitive(const std::string& path) {
        Diagnostics diagnostics;
        const Scene scene = load_gltf(test::shared_data() / "models" / path, diagnostics);
        EXPECT_EQ(scene.instances.size(), 1u);
        // In world space, for the quantised form has its scale in the node.
        Primitive p = scene.meshes.at(0)->primitives.at(0);
        const Mat4& world_from_object = scene.instances.at(0).world_from_object;
        const Mat3 normal_matrix = glm::transpose(glm::inverse(Mat3(world_from_object)));
        for (Vec3& position : p.positions)
            position = Vec3(world_from_object * Vec4(position, 1.0f));
        for (Vec3& normal : p.normals)
            normal = glm::normalize(normal_matrix * normal);
        if (p.material.valid()) {
            const TextureRef& base = scene.materials[p.material.value].base_color;
            for (Vec2& uv : p.uv[0])
                uv = base.uv_transform * Vec3(uv, 1.0f);
        }
        return p;
    }
};

TEST_F(DracoModels, BoxIsTheUncompressedBox) {
    if (!std::filesystem::exists(shared_data() / "models/Box")) GTEST_SKIP() << "skipped: no shared data";
    const Primitive plain = only_primitive("Box/glTF-Binary/Box.glb");
    const Primitive compressed = only_primitive("Box/glTF-Draco/Box.gltf");
    EXPECT_EQ(plain.triangles.size(), compressed.triangles.size());
    // 11 bits of position over an edge of 1, 8 bits of normal.
    expect_near_vertices(plain, compressed, 1.0f / 2047, 2.0f / 127, 1);
    expect_near_vertices(compressed, plain, 1.0f / 2047, 2.0f / 127, 1);
}

TEST_F(DracoModels, DuckIsTheQuantisedDuck) {
    if (!std::filesystem::exists(shared_data() / "models/Duck")) GTEST_SKIP() << "skipped: no shared data";
    const Primitive quantised = only_primitive("Duck/glTF-Quantized/Duck.gltf");
    const Primitive compressed = only_primitive("Duck/glTF-Draco/Duck.gltf");
    EXPECT_EQ(quantised.triangles.size(), compressed.triangles.size());
    Bounds3 bounds;
    for (const Vec3& p : compressed.positions)
        bounds.extend(p);
    const float edge = max_component(bounds.upper - bounds.lower);
    expect_near_vertices(quantised, compressed, 2 * edge / 2047, 4.0f / 127, 3.0f / 1023);
    expect_near_vertices(compressed, quantised, 2 * edge / 2047, 4.0f / 127, 3.0f / 1023);
}

}  // namespace
}  // namespace candela
