// SPDX-License-Identifier: MIT
// Points and lines: which there are, and the bodies that they get.
#include <map>

#include "renderer/io/strokes.h"
#include "tests/io/document.h"

namespace candela {
namespace {

using namespace test;

class Strokes : public GltfTest {
  protected:
    // Corners 1 m apart along x.
    static Document row(int corners, int mode) {
        Document document;
        std::vector<float> positions;
        for (int i = 0; i < corners; ++i)
            positions.insert(positions.end(), {static_cast<float>(i), 0.0f, 0.0f});
        document.add_primitive({{"POSITION", document.add_accessor(positions, "VEC3", f32)}}, -1, {{"mode", mode}});
        return document;
    }
    static double signed_volume(const Primitive& p, const Mat4& world_from_object = Mat4(1.0f)) {
        double volume = 0;
        const auto at = [&](uint32_t v) {
            return glm::dvec3(glm::dmat4(world_from_object) * glm::dvec4(glm::dvec3(p.positions[v]), 1.0));
        };
        for (const Vec3u& t : p.triangles)
            volume += glm::dot(at(t.x), glm::cross(at(t.y), at(t.z))) / 6.0;
        return volume;
    }
};

TEST_F(Strokes, CountsOfEveryMode) {
    struct Case {
        int corners, mode;
        uint64_t points, segments;
    };
    for (const Case& c :
         {Case{6, 0, 6, 0}, Case{6, 1, 0, 3}, Case{5, 1, 0, 2}, Case{6, 2, 0, 6}, Case{6, 3, 0, 5}, Case{2, 2, 0, 2}}) {
        const Scene scene = load(row(c.corners, c.mode));
        EXPECT_EQ(scene.strokes.points, c.points) << "mode " << c.mode;
        EXPECT_EQ(scene.strokes.segments, c.segments) << "mode " << c.mode;
        EXPECT_EQ(first(scene).shape, c.mode == 0 ? PrimitiveShape::points : PrimitiveShape::lines);
        EXPECT_EQ(scene.instances.size(), 1u);
    }
    load(row(5, 1));
    EXPECT_TRUE(warned("/meshes/0/primitives/0", "not a multiple of 2")) << all_warnings();
    load(row(1, 3));
    EXPECT_TRUE(warned("/meshes/0/primitives/0", "nothing that can be shown")) << all_warnings();
    EXPECT_EQ(failure(row(6, 7)), "/meshes/0/primitives/0/mode: 7 is not a primitive mode of glTF");
}

TEST_F(Strokes, SpheresAreRoundWatertightAndOfTheStatedWidth) {
    const Scene scene = load(row(5, 0));
    const Primitive& p = first(scene);
    const float radius = 0.5f * 4.0f / 500.0f;
    EXPECT_NEAR(scene.strokes.width_m, 2 * radius, 1e-6f);
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (const Vec3u& t : p.triangles) {
        for (int c = 0; c < 3; ++c)
            ++edges[{t[c], t[(c + 1) % 3]}];
    }
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << "an open edge";
    }
    for (size_t v = 0; v < p.positions.size(); ++v) {
        const Vec3 center(std::round(p.positions[v].x), 0, 0);
        EXPECT_NEAR(glm::distance(p.positions[v], center), radius, 1e-5f);
        EXPECT_NEAR(glm::distance(p.normals[v], (p.positions[v] - center) / radius), 0.0f, 1e-3f);
    }
    const double sphere = 4.0 / 3.0 * 3.14159265 * std::pow(static_cast<double>(radius), 3);
    EXPECT_GT(signed_volume(p), 0.9 * 5 * sphere) << "wound to be seen from outside";
    EXPECT_LT(signed_volume(p), 5 * sphere);
}

TEST_F(Strokes, TubesJoinTheirEndsAndCarryWhatTheVerticesCarry) {
    Document document = row(3, 3);
    const std::vector<float> colors = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::vector<float> uv = {0, 0, 0.5f, 0, 1, 0};
    Json& attributes = document.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["COLOR_0"] = document.add_accessor(colors, "VEC3", f32);
    attributes["TEXCOORD_0"] = document.add_accessor(uv, "VEC2", f32);
    const Scene scene = load(document);
    const Primitive& p = first(scene);
    ASSERT_EQ(p.colors.size(), p.positions.size());
    const float radius = 0.5f * scene.strokes.width_m;
    for (size_t v = 0; v < p.positions.size(); ++v) {
        const int source = static_cast<int>(std::round(p.positions[v].x));
        EXPECT_EQ(p.colors[v][source], 1.0f);
        EXPECT_EQ(p.uv[0][v].x, 0.5f * static_cast<float>(source));
        EXPECT_LE(glm::length(Vec2(p.positions[v].y, p.positions[v].z)), radius * 1.0001f);
    }
    float longest = 0;
    for (const Vec3u& t : p.triangles) {
        const Vec3 twice = glm::cross(p.positions[t.y] - p.positions[t.x], p.positions[t.z] - p.positions[t.x]);
        EXPECT_GT(glm::dot(twice, p.normals[t.x] + p.normals[t.y] + p.normals[t.z]), 0.0f);
        longest = std::max(longest, glm::distance(p.positions[t.x], p.positions[t.y]));
    }
    EXPECT_GE(longest, 1.0f) << "from one vertex to the next";
}

TEST_F(Strokes, NodesThatStretchOrMirrorDoNotStretchTheWidth) {
    Document document = row(2, 0);
    document.json["nodes"][0]["scale"] = {-2, 5, 0.25};
    const Scene scene = load(document);
    const Primitive& p = first(scene);
    const Mat4& world_from_object = scene.instances.at(0).world_from_object;
    const float radius = 0.5f * scene.strokes.width_m;
    EXPECT_NEAR(scene.strokes.width_m, 2.0f / 500.0f, 1e-6f);
    const Mat3 normal_matrix = glm::transpose(glm::inverse(Mat3(world_from_object)));
    for (size_t v = 0; v < p.positions.size(); ++v) {
        const Vec3 world(world_from_object * Vec4(p.positions[v], 1.0f));
        const Vec3 center(-2.0f * std::round(p.positions[v].x), 0, 0);
        EXPECT_NEAR(glm::distance(world, center), radius, 1e-5f);
        EXPECT_NEAR(glm::dot(glm::normalize(normal_matrix * p.normals[v]), (world - center) / radius), 1.0f, 1e-3f);
    }
    // A mirroring transform turns the winding: what faces out is clockwise in the world (glTF 2.0, section 3.7.4).
    EXPECT_LT(signed_volume(p, world_from_object), 0.0);
}

// Whichever comes first, the width is that of the largest placement; the smaller copy is thinner, as is said.
TEST_F(Strokes, OfAMeshInSeveralSizesTheLargestHasTheWidth) {
    for (const size_t large : {0u, 1u}) {
        Document document = row(2, 0);
        document.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}}};
        document.json["nodes"][large]["scale"] = {4, 4, 4};
        document.json["scenes"][0]["nodes"] = {0, 1};
        const Scene scene = load(document);
        const float radius = 0.5f * scene.strokes.width_m;
        const Vec3& vertex = first(scene).positions.at(0);
        EXPECT_NEAR(glm::length(4.0f * vertex), radius, 1e-6f) << "of the sphere around the first point";
        EXPECT_TRUE(warned("/meshes/0", "placed in several sizes")) << all_warnings();
        document.json["nodes"][1 - large]["scale"] = {-4, 4, 4};
        load(document);
        EXPECT_EQ(all_warnings(), "");
    }
}

TEST_F(Strokes, ManyAreThinnerAndCoarser) {
    EXPECT_FLOAT_EQ(stroke_width(10.0f, 100), 0.02f);
    EXPECT_FLOAT_EQ(stroke_width(10.0f, 1'000'000), 0.0025f);
    EXPECT_GT(stroke_width(0.0f, 1), 0.0f) << "a single point has no diagonal";
    const Scene scene = load(row(600'000, 0));
    EXPECT_EQ(unique_triangle_count(scene), 4u * 600'000u);
    options_.max_memory_bytes = 60'000'000;
    EXPECT_NE(failure(row(600'000, 0)).find("memory limit"), std::string::npos);
}

TEST_F(Strokes, WhatIsNotFiniteIsDropped) {
    Document document = row(3, 3);
    const float bad = NAN;
    std::memcpy(document.bytes.data() + 2 * 3 * sizeof(float), &bad, sizeof(bad));
    const Scene scene = load(document);
    EXPECT_EQ(scene.strokes.segments, 1u);
    for (const Vec3& position : first(scene).positions)
        EXPECT_LT(position.x, 1.1f);
}

TEST_F(Strokes, RestartValuesAreRefused) {
    Document document = row(300, 3);
    const int indices = document.add_accessor<uint8_t>({0, 1, 255, 2, 3}, "SCALAR", u8);
    document.json["meshes"][0]["primitives"][0]["indices"] = indices;
    EXPECT_EQ(failure(document).rfind("/meshes/0/primitives/0/indices: holds the primitive restart value 255", 0), 0u)
        << failure(document);
    // In a wider type the same number names a vertex.
    const int wide = document.add_accessor<uint16_t>({0, 1, 255, 2, 3}, "SCALAR", u16);
    document.json["meshes"][0]["primitives"][0]["indices"] = wide;
    EXPECT_EQ(failure(document), "loaded");
}

}  // namespace
}  // namespace candela
