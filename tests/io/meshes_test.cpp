// SPDX-License-Identifier: MIT
#include "tests/io/document.h"

namespace candela {
namespace {

using namespace test;

class Meshes : public GltfTest {
  protected:
    // Corners on a regular polygon in the plane z = 0.
    static Document polygon(int corners, int mode) {
        Document document;
        std::vector<float> positions;
        for (int i = 0; i < corners; ++i) {
            const float angle = 2.0f * pi * static_cast<float>(i) / static_cast<float>(corners);
            positions.insert(positions.end(), {std::cos(angle), std::sin(angle), 0.0f});
        }
        const int accessor = document.add_accessor(positions, "VEC3", f32);
        document.add_primitive({{"POSITION", accessor}}, -1, {{"mode", mode}});
        return document;
    }
    // A triangle with further attributes.
    Document with_attribute(const char* name, const std::vector<float>& values, const char* type) {
        Document document = Document::triangle();
        const int accessor = document.add_accessor(values, type, f32);
        document.json["meshes"][0]["primitives"][0]["attributes"][name] = accessor;
        return document;
    }
};

TEST_F(Meshes, TrianglesWithoutIndices) {
    EXPECT_EQ(first(load(polygon(6, 4))).triangles, (std::vector<Vec3u>{{0, 1, 2}, {3, 4, 5}}));
    // The incomplete last triangle is left out, and said.
    EXPECT_EQ(first(load(polygon(5, 4))).triangles, (std::vector<Vec3u>{{0, 1, 2}}));
    EXPECT_TRUE(warned("/meshes/0/primitives/0", "multiple of 3")) << all_warnings();
}

TEST_F(Meshes, StripsAndFansKeepTheirWinding) {
    EXPECT_EQ(first(load(polygon(5, 5))).triangles, (std::vector<Vec3u>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
    const Primitive fan = first(load(polygon(5, 6)));
    EXPECT_EQ(fan.triangles, (std::vector<Vec3u>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
    for (const Vec3u& t : fan.triangles) {
        const auto& p = fan.positions;
        EXPECT_GT(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]).z, 0.0f);
    }
}

TEST_F(Meshes, NormalsAreFlatWhereTheFileHasNone) {
    const Primitive p = first(load(Document::triangle()));
    EXPECT_TRUE(p.flat_normals);
    EXPECT_TRUE(p.normals.empty());
}

TEST_F(Meshes, NormalsAreUnitAndNeverZero) {
    const Primitive p = first(load(with_attribute("NORMAL", {0, 0, 5, 0, 0, 0, NAN, 0, 1}, "VEC3")));
    EXPECT_FALSE(p.flat_normals);
    for (const Vec3& n : p.normals)
        EXPECT_EQ(n, Vec3(0, 0, 1));
    EXPECT_TRUE(warned("/meshes/0/primitives/0/attributes/NORMAL", "without a direction")) << all_warnings();
}

TEST_F(Meshes, TrianglesThatAreNotFiniteAreDropped) {
    for (const float bad : {NAN, INFINITY, -3e38f}) {
        Document document;
        document.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, bad, 0}, "VEC3", f32);
        document.add_accessor<uint8_t>({0, 1, 2, 1, 2, 3}, "SCALAR", u8);
        document.add_primitive({{"POSITION", 0}}, 1);
        const Primitive p = first(load(document));
        EXPECT_EQ(p.triangles, (std::vector<Vec3u>{{0, 1, 2}}));
        for (const Vec3& position : p.positions)
            EXPECT_TRUE(is_finite(position));
        EXPECT_TRUE(warned("/meshes/0/primitives/0/attributes/POSITION", "not finite")) << all_warnings();
    }
}

TEST_F(Meshes, SharedVerticesAreNotCopiedToEveryPrimitive) {
    Document document = Document::triangle();
    const int positions = document.add_accessor(std::vector<float>(3 * 1000, 1.0f), "VEC3", f32);
    const int indices = document.add_accessor<uint16_t>({997, 5, 998}, "SCALAR", u16);
    document.add_primitive({{"POSITION", positions}}, indices);
    const Scene scene = load(document);
    EXPECT_EQ(scene.meshes.at(1)->primitives.at(0).positions.size(), 3u);
    EXPECT_EQ(scene.meshes[1]->primitives[0].triangles.at(0), Vec3u(1, 0, 2));
}

TEST_F(Meshes, TwoUvSets) {
    Document document = with_attribute("TEXCOORD_0", {0, 0, 1, 0, 0, 1}, "VEC2");
    const int second = document.add_accessor<float>({0.5f, 0.5f, 1, NAN, 0, 1}, "VEC2", f32);
    document.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = second;
    const Primitive p = first(load(document));
    EXPECT_EQ(p.uv[0].at(1), Vec2(1, 0));
    EXPECT_EQ(p.uv[1].at(0), Vec2(0.5f));
    EXPECT_EQ(p.uv[1].at(1), Vec2(0)) << "not finite";
}

class MeshTangents : public Meshes {
  protected:
    Document normal_mapped() {
        Document document = with_attribute("NORMAL", {0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
        const int uv = document.add_accessor<float>({0, 1, 1, 1, 0, 0}, "VEC2", f32);
        Json& primitive = document.json["meshes"][0]["primitives"][0];
        primitive["attributes"]["TEXCOORD_0"] = uv;
        primitive["material"] = 0;
        document.json["images"] = {{{"uri", "n.png"}}};
        document.json["textures"] = {{{"source", 0}}};
        document.json["materials"] = {{{"normalTexture", {{"index", 0}, {"scale", 0.5}}}}};
        return document;
    }
};

TEST_F(MeshTangents, AreMadeWhereANormalTextureNeedsThem) {
    Document document = normal_mapped();
    const Primitive p = first(load(document));
    ASSERT_EQ(p.tangents.size(), p.positions.size());
    for (const Vec4& t : p.tangents)
        EXPECT_NEAR(glm::distance(t, Vec4(1, 0, 0, 1)), 0.0f, 1e-5f);
    document.json["materials"][0].erase("normalTexture");
    EXPECT_TRUE(first(load(document)).tangents.empty()) << "nobody reads them";
}

TEST_F(MeshTangents, OfTheFileAreKeptAndMended) {
    Document document = normal_mapped();
    const int tangents = document.add_accessor<float>({0, 3, 0, -1, 0, 1, 0, 0.5f, 0, 0, 0, 1}, "VEC4", f32);
    Json& attributes = document.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["TANGENT"] = tangents;
    const Primitive p = first(load(document));
    EXPECT_EQ(p.tangents.at(0), Vec4(0, 1, 0, -1));
    EXPECT_EQ(p.tangents.at(1), Vec4(0, 1, 0, 1));
    EXPECT_NEAR(glm::length(Vec3(p.tangents.at(2))), 1.0f, 1e-6f);
    EXPECT_EQ(p.tangents[2].z, 0.0f) << "perpendicular to the normal";

    // Without normals the file's tangents do not count (glTF 2.0, section 3.7.2.1).
    attributes.erase("NORMAL");
    const Primitive flat = first(load(document));
    EXPECT_TRUE(flat.flat_normals);
    ASSERT_FALSE(flat.tangents.empty());
    EXPECT_NEAR(glm::distance(flat.tangents[0], Vec4(1, 0, 0, 1)), 0.0f, 1e-5f);
}

TEST_F(MeshTangents, MissingTextureCoordinatesAreSaid) {
    Document document = normal_mapped();
    document.json["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
    EXPECT_TRUE(first(load(document)).tangents.empty());
    EXPECT_TRUE(warned("/meshes/0/primitives/0", "has no TEXCOORD_0 for its material's normal texture"))
        << all_warnings();
}

}  // namespace
}  // namespace candela
