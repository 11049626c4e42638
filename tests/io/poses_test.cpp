// SPDX-License-Identifier: MIT
// Posed scenes of the shared models against vertices that are moved here, in double precision, from the file's own
// numbers.
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "renderer/scene/animation.h"
#include "renderer/scene/pose.h"
#include "tests/io/document.h"
#include "tests/io/raw_gltf.h"
#include "tests/support/shared_data.h"

namespace candela {
namespace {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;
using test::Json;
using test::RawGltf;

// A value of an animation's sampler at a time, as appendix C of glTF 2.0 writes it.
std::vector<double> sample(const RawGltf& gltf, const Json& sampler, double time, bool is_rotation) {
    const std::vector<double> times = gltf.read(sampler["input"]);
    std::vector<double> values = gltf.read(sampler["output"]);
    const std::string interpolation = sampler.value("interpolation", "LINEAR");
    const bool cubic = interpolation == "CUBICSPLINE";
    // Files round their quaternions: the formula wants unit ones.
    for (size_t i = 0; is_rotation && !cubic && i < values.size(); i += 4) {
        const double length =
            std::hypot(std::hypot(values[i], values[i + 1]), std::hypot(values[i + 2], values[i + 3]));
        for (size_t c = i; c < i + 4; ++c)
            values[c] /= length;
    }
    const size_t width = values.size() / times.size() / (cubic ? 3 : 1);
    const auto value = [&](size_t key, size_t part, size_t c) {
        return values[(key * (cubic ? 3 : 1) + (cubic ? part : 0)) * width + c];
    };
    size_t k = 0;
    while (k + 1 < times.size() && times[k + 1] <= time)
        ++k;
    const bool inside = time >= times[0] && k + 1 < times.size();
    std::vector<double> out(width);
    for (size_t c = 0; c < width; ++c)
        out[c] = value(k, 1, c);
    if (inside && interpolation != "STEP") {
        const double step = times[k + 1] - times[k], t = (time - times[k]) / step;
        if (is_rotation && !cubic) {
            double dot = 0;
            for (size_t c = 0; c < 4; ++c)
                dot += value(k, 1, c) * value(k + 1, 1, c);
            const double sign = dot < 0 ? -1 : 1, angle = std::acos(std::min(std::abs(dot), 1.0));
            const double a = angle < 1e-9 ? 1 - t : std::sin((1 - t) * angle) / std::sin(angle);
            const double b = angle < 1e-9 ? t : std::sin(t * angle) / std::sin(angle);
            for (size_t c = 0; c < 4; ++c)
                out[c] = a * value(k, 1, c) + sign * b * value(k + 1, 1, c);
        } else {
            for (size_t c = 0; c < width; ++c) {
                const double p0 = value(k, 1, c), p1 = value(k + 1, 1, c);
                out[c] = p0 + t * (p1 - p0);
                if (!cubic) continue;
                const double m0 = step * value(k, 2, c), m1 = step * value(k + 1, 0, c), t2 = t * t, t3 = t2 * t;
                out[c] = (2 * t3 - 3 * t2 + 1) * p0 + (t3 - 2 * t2 + t) * m0 + (-2 * t3 + 3 * t2) * p1 + (t3 - t2) * m1;
            }
        }
    }
    return out;
}

// The document with the animation's values at a time written into its nodes.
Json posed_nodes(const RawGltf& gltf, size_t animation, double time) {
    Json nodes = gltf.json["nodes"];
    if (!gltf.json.contains("animations")) return nodes;
    for (const Json& channel : gltf.json["animations"][animation]["channels"]) {
        if (!channel["target"].contains("node")) continue;
        const std::string path = channel["target"]["path"];
        const Json& sampler = gltf.json["animations"][animation]["samplers"][channel["sampler"].get<size_t>()];
        nodes[channel["target"]["node"].get<size_t>()][path] = sample(gltf, sampler, time, path == "rotation");
    }
    return nodes;
}

dmat4 local_transform(const Json& node) {
    if (node.contains("matrix")) {
        const std::vector<double> m = node["matrix"];
        return glm::make_mat4(m.data());
    }
    const std::vector<double> t = node.value("translation", std::vector<double>{0, 0, 0});
    const std::vector<double> r = node.value("rotation", std::vector<double>{0, 0, 0, 1});
    const std::vector<double> s = node.value("scale", std::vector<double>{1, 1, 1});
    return glm::translate(dmat4(1), dvec3(t[0], t[1], t[2])) *
           glm::mat4_cast(glm::normalize(glm::dquat(r[3], r[0], r[1], r[2]))) *
           glm::scale(dmat4(1), dvec3(s[0], s[1], s[2]));
}

dmat4 world_transform(const Json& nodes, size_t index) {
    for (size_t parent = 0; parent < nodes.size(); ++parent) {
        const std::vector<size_t> children = nodes[parent].value("children", std::vector<size_t>());
        if (std::find(children.begin(), children.end(), index) != children.end())
            return world_transform(nodes, parent) * local_transform(nodes[index]);
    }
    return local_transform(nodes[index]);
}

struct Corner {
    dvec3 position{0};
    dvec3 normal{0};  // 0: the file has none
};

// The corners of a node's triangles in the world, primitive by primitive.
std::vector<Corner> corners_of(const RawGltf& gltf, const Json& nodes, size_t index) {
    const Json& node = nodes[index];
    const Json& mesh = gltf.json["meshes"][node["mesh"].get<size_t>()];
    const dmat4 world = world_transform(nodes, index);
    std::vector<dmat4> joint_matrices;
    if (node.contains("skin")) {
        const Json& skin = gltf.json["skins"][node["skin"].get<size_t>()];
        std::vector<double> bind;
        if (skin.contains("inverseBindMatrices")) bind = gltf.read(skin["inverseBindMatrices"]);
        for (size_t j = 0; j < skin["joints"].size(); ++j) {
            const dmat4 inverse_bind = bind.empty() ? dmat4(1) : glm::make_mat4(bind.data() + 16 * j);
            joint_matrices.push_back(world_transform(nodes, skin["joints"][j]) * inverse_bind);
        }
    }
    const std::vector<double> weights = node.value("weights", mesh.value("weights", std::vector<double>()));
    std::vector<Corner> out;
    for (const Json& primitive : mesh["primitives"]) {
        const Json& attributes = primitive["attributes"];
        std::vector<dvec3> positions = gltf.read3(attributes["POSITION"]);
        std::vector<dvec3> normals;
        if (attributes.contains("NORMAL")) normals = gltf.read3(attributes["NORMAL"]);
        for (dvec3& n : normals)
            n = glm::normalize(n);
        const Json targets = primitive.value("targets", Json::array());
        for (size_t t = 0; t < std::min(targets.size(), weights.size()); ++t) {
            for (auto [name, values] : {std::pair{"POSITION", &positions}, std::pair{"NORMAL", &normals}}) {
                if (!targets[t].contains(name) || values->empty()) continue;
                const std::vector<dvec3> deltas = gltf.read3(targets[t][name]);
                for (size_t i = 0; i < values->size(); ++i)
                    (*values)[i] += weights[t] * deltas[i];
            }
        }
        std::vector<dmat4> transforms(positions.size(), world);
        if (!joint_matrices.empty() && attributes.contains("JOINTS_0")) {
            std::vector<double> sums(positions.size(), 0.0);
            std::fill(transforms.begin(), transforms.end(), dmat4(0));
            for (int set = 0; attributes.contains("JOINTS_" + std::to_string(set)); ++set) {
                const std::vector<double> joints = gltf.read(attributes["JOINTS_" + std::to_string(set)]);
                const std::vector<double> influence = gltf.read(attributes["WEIGHTS_" + std::to_string(set)]);
                for (size_t i = 0; i < joints.size(); ++i) {
                    if (influence[i] == 0) continue;
                    transforms[i / 4] += influence[i] * joint_matrices.at(static_cast<size_t>(joints[i]));
                    sums[i / 4] += influence[i];
                }
            }
            for (size_t i = 0; i < sums.size(); ++i)
                transforms[i] /= sums[i];
        }
        std::vector<double> indices;
        if (primitive.contains("indices")) {
            indices = gltf.read(primitive["indices"]);
        } else {
            for (size_t i = 0; i < positions.size(); ++i)
                indices.push_back(static_cast<double>(i));
        }
        for (const double corner : indices) {
            const auto i = static_cast<size_t>(corner);
            Corner& added = out.emplace_back();
            added.position = dvec3(transforms[i] * dvec4(positions[i], 1));
            if (!normals.empty()) {
                added.normal = glm::normalize(glm::transpose(glm::inverse(glm::dmat3(transforms[i]))) * normals[i]);
            }
        }
    }
    return out;
}

std::vector<Corner> corners_of(const Scene& scene, uint32_t node) {
    std::vector<Corner> out;
    for (const Instance& instance : scene.instances) {
        if (instance.node.value != node) continue;
        const dmat4 world(instance.world_from_object);
        const glm::dmat3 normal_map = glm::transpose(glm::inverse(glm::dmat3(world)));
        for (const Primitive& primitive : scene.mesh(instance.mesh).primitives) {
            for (const Vec3u& t : primitive.triangles) {
                for (int c = 0; c < 3; ++c) {
                    Corner& added = out.emplace_back();
                    added.position = dvec3(world * dvec4(dvec3(primitive.positions[t[c]]), 1));
                    if (!primitive.normals.empty())
                        added.normal = glm::normalize(normal_map * dvec3(primitive.normals[t[c]]));
                }
            }
        }
    }
    return out;
}

// The largest distance between corners, in units of the posed model's largest coordinate, and between normals.
struct Difference {
    double position = 0, normal = 0;
    size_t corners = 0;
};

Difference compare(const std::vector<Corner>& a, const std::vector<Corner>& b, const std::string& what) {
    Difference out;
    out.corners = a.size();
    EXPECT_EQ(a.size(), b.size()) << what;
    if (a.size() != b.size()) return out;
    double size = 1e-9;
    for (const Corner& corner : a)
        size = std::max({size, std::abs(corner.position.x), std::abs(corner.position.y), std::abs(corner.position.z)});
    for (size_t i = 0; i < a.size(); ++i) {
        out.position = std::max(out.position, glm::distance(a[i].position, b[i].position) / size);
        out.normal = std::max(out.normal, glm::distance(a[i].normal, b[i].normal));
    }
    return out;
}

std::shared_ptr<const Scene> load(const std::filesystem::path& file) {
    Diagnostics diagnostics;
    LoadOptions options;
    options.decode_images = false;
    auto scene = std::make_shared<const Scene>(load_gltf(file, diagnostics, options));
    for (const Diagnostic& warning : diagnostics.warnings())
        ADD_FAILURE() << file << " " << warning.where << ": " << warning.message;
    return scene;
}

// At rest, and at several times of every animation, before its start and after its end too.
void expect_poses(const std::string& name, size_t least_corners) {
    const std::filesystem::path file = test::shared_data() / "models" / name;
    const RawGltf gltf(file);
    const auto rest = load(file);
    const auto check = [&](const Scene& scene, const Json& nodes, const std::string& when) {
        size_t corners = 0;
        for (uint32_t n = 0; n < nodes.size(); ++n) {
            if (!nodes[n].contains("mesh") || !scene.nodes[n].in_active_scene) continue;
            const std::string what = name + " node " + std::to_string(n) + " " + when;
            const Difference difference = compare(corners_of(gltf, nodes, n), corners_of(scene, n), what);
            EXPECT_LT(difference.position, 2e-6) << what;
            EXPECT_LT(difference.normal, 2e-5) << what;
            corners += difference.corners;
        }
        EXPECT_GE(corners, least_corners) << name;
    };
    check(*rest, gltf.json["nodes"], "at rest");
    for (uint32_t a = 0; a < rest->animations.size(); ++a) {
        const float duration = rest->animations[a]->duration_s;
        EXPECT_GT(rest->animations[a]->channels.size(), 0u) << name;
        for (const float time : {-1.0f, 0.0f, 0.21f * duration, 0.5f * duration, 0.87f * duration, 2.0f * duration}) {
            check(*posed_scene(rest, a, time), posed_nodes(gltf, a, static_cast<double>(time)),
                  "animation " + std::to_string(a) + " at " + std::to_string(time));
        }
    }
}

TEST(Poses, AreTheVerticesThatThisTestMoves) {
    if (!std::filesystem::exists(test::shared_data() / "models")) GTEST_SKIP() << "skipped: no shared data";
    expect_poses("AnimatedTriangle/glTF-Embedded/AnimatedTriangle.gltf", 3);
    expect_poses("BoxAnimated/glTF-Binary/BoxAnimated.glb", 36);
    expect_poses("InterpolationTest/glTF/InterpolationTest.gltf", 300);
    expect_poses("SimpleSkin/glTF-Embedded/SimpleSkin.gltf", 24);
    expect_poses("RiggedSimple/glTF/RiggedSimple.gltf", 500);
    expect_poses("CesiumMan/glTF-Binary/CesiumMan.glb", 10000);
    expect_poses("Fox/glTF/Fox.gltf", 1000);
    expect_poses("AnimatedMorphCube/glTF/AnimatedMorphCube.gltf", 36);
    expect_poses("AnimatedMorphCube/glTF-Quantized/AnimatedMorphCube.gltf", 36);
    expect_poses("MorphPrimitivesTest/glTF/MorphPrimitivesTest.gltf", 6);
}

TEST(Poses, OfTheAssetGeneratorAreTheVerticesThatThisTestMoves) {
    const std::filesystem::path folder = test::shared_data() / "models/AssetGenerator";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "skipped: no shared data";
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() != ".gltf" || name.rfind("Animation_", 0) != 0) continue;
        expect_poses(std::filesystem::relative(entry.path(), test::shared_data() / "models").string(), 6);
        ++files;
    }
    EXPECT_GE(files, 9);
}

// Compressed vertices are not read here; what moves are whole nodes.
TEST(Poses, WheelsOfTheTruckTurn) {
    const auto file = test::shared_data() / "models/CesiumMilkTruck/glTF-Draco/CesiumMilkTruck.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "skipped: no shared data";
    const RawGltf gltf(file);
    const auto rest = load(file);
    int moving = 0;
    for (const float time : {0.0f, 0.4f, 1.1f}) {
        const auto posed = posed_scene(rest, 0, time);
        const Json nodes = posed_nodes(gltf, 0, static_cast<double>(time));
        ASSERT_EQ(posed->instances.size(), rest->instances.size());
        for (const Instance& instance : posed->instances) {
            const dmat4 expected = world_transform(nodes, instance.node.value);
            for (int c = 0; c < 4; ++c)
                EXPECT_LT(glm::distance(expected[c], dvec4(instance.world_from_object[c])), 1e-6) << time;
            EXPECT_EQ(posed->meshes[instance.mesh.value], rest->meshes[instance.mesh.value]);
            moving += instance.moves ? 1 : 0;
        }
    }
    EXPECT_EQ(moving, 3 * 2) << "both axles and nothing else";
}

// Positions and both targets are off by half a step of their node's scale along each axis, and the weights, bytes, by
// half of 1/255 of what the targets move.
TEST(Poses, QuantisedMorphsAreThePlainOnesToTheStep) {
    const std::filesystem::path folder = test::shared_data() / "models/AnimatedMorphCube";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "skipped: no shared data";
    const auto plain = load(folder / "glTF/AnimatedMorphCube.gltf");
    const auto quantised = load(folder / "glTF-Quantized/AnimatedMorphCube.gltf");
    const auto node_with_mesh = [](const Scene& scene) { return scene.instances.at(0).node.value; };
    ASSERT_EQ(plain->animations.size(), quantised->animations.size());
    constexpr double position_step = 3.649e-4, moved = 1.893 + 1.989;
    const double tolerance = 3 * std::sqrt(3.0) * position_step / 2 + moved / 255 / 2;
    for (const float time : {0.0f, 0.7f, 1.3f, 2.9f, 4.0f}) {
        // Corners may come in another order: each has one that is near.
        const auto a = corners_of(*posed_scene(plain, 0, time), node_with_mesh(*plain));
        const auto b = corners_of(*posed_scene(quantised, 0, time), node_with_mesh(*quantised));
        ASSERT_EQ(a.size(), b.size());
        for (const Corner& corner : a) {
            double nearest = 1e9;
            for (const Corner& other : b) {
                if (glm::distance(corner.normal, other.normal) < 0.05)
                    nearest = std::min(nearest, glm::distance(corner.position, other.position));
            }
            EXPECT_LT(nearest, tolerance) << time;
        }
    }
}

}  // namespace
}  // namespace candela
