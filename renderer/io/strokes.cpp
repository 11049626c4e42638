// SPDX-License-Identifier: MIT
#include "renderer/io/strokes.h"

#include <limits>
#include <map>

#include "renderer/io/repair.h"
#include "renderer/math/parallel.h"
#include "renderer/scene/place_nodes.h"

namespace candela {
namespace {

// A unit sphere of triangles, wound to be seen from outside.
struct UnitSphere {
    std::vector<Vec3> normals;
    std::vector<Vec3u> triangles;
};

UnitSphere tetrahedron() {
    const float s = 1.0f / std::sqrt(3.0f);
    return {{{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

UnitSphere octahedron() {
    return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
            {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

// Every edge is halved and its middle moved out to the sphere.
UnitSphere subdivided(const UnitSphere& from) {
    UnitSphere out{from.normals, {}};
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [found, is_new] =
            middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<uint32_t>(out.normals.size()));
        if (is_new) out.normals.push_back(glm::normalize(out.normals[a] + out.normals[b]));
        return found->second;
    };
    for (const Vec3u& t : from.triangles) {
        const uint32_t xy = middle(t.x, t.y), yz = middle(t.y, t.z), zx = middle(t.z, t.x);
        out.triangles.insert(out.triangles.end(), {{t.x, xy, zx}, {xy, t.y, yz}, {zx, yz, t.z}, {xy, yz, zx}});
    }
    return out;
}

struct Detail {
    UnitSphere sphere;
    uint32_t sides;  // of a tube
};

// Triangles are shared out: 128 to a sphere while there are few, 4 where there are tens of thousands.
Detail choose_detail(uint64_t count) {
    if (count <= 4'000) return {subdivided(subdivided(octahedron())), 12};
    if (count <= 10'000) return {subdivided(octahedron()), 8};
    if (count <= 40'000) return {octahedron(), 4};
    return {tetrahedron(), 3};
}

// Where the active scene has its meshes, hidden ones too.
class Placements {
  public:
    explicit Placements(const Scene& scene) : scene_(scene), world_from_node_(world_from_nodes(scene)) {
        std::vector<NodeId> stack = scene.roots;
        std::vector<uint8_t> seen(scene.nodes.size(), 0);
        while (!stack.empty()) {
            const NodeId id = stack.back();
            stack.pop_back();
            if (seen[id.value] != 0) continue;
            seen[id.value] = 1;
            const Node& node = scene.nodes[id.value];
            if (node.mesh.valid()) nodes_.push_back(id);
            stack.insert(stack.end(), node.children.rbegin(), node.children.rend());
        }
    }

    // The diagonal of the box around the boxes of all placed meshes.
    float diagonal(const std::vector<Mesh>& meshes) const {
        std::vector<Bounds3> boxes(meshes.size());
        for (size_t m = 0; m < meshes.size(); ++m) {
            for (const Primitive& primitive : meshes[m].primitives) {
                for (const Vec3& position : primitive.positions)
                    boxes[m].extend(position);
            }
        }
        Bounds3 all;
        for (const NodeId id : nodes_) {
            const Node& node = scene_.nodes[id.value];
            const Bounds3& box = boxes[node.mesh.value];
            if (box.empty()) continue;
            for_each_transform(id, [&](const glm::dmat4& world_from_object) {
                for (int corner = 0; corner < 8; ++corner) {
                    const Vec3 p((corner & 1) != 0 ? box.upper.x : box.lower.x,
                                 (corner & 2) != 0 ? box.upper.y : box.lower.y,
                                 (corner & 4) != 0 ? box.upper.z : box.lower.z);
                    const Vec3 placed(world_from_object * glm::dvec4(p, 1.0));
                    if (is_finite(placed)) all.extend(placed);
                }
            });
        }
        return all.empty() ? 0.0f : glm::length(all.upper - all.lower);
    }

    // How a mesh is placed where it is placed largest, by volume: the linear part.
    struct Largest {
        glm::dmat3 linear{1.0};
        bool others_are_smaller = false;  // by more than a hundredth along an edge
    };

    // Widths are the same in every direction of the world, whatever the node stretches.
    Largest largest_of(MeshId mesh) const {
        Largest out;
        double largest = 0.0, smallest = std::numeric_limits<double>::infinity();
        for (const NodeId id : nodes_) {
            if (scene_.nodes[id.value].mesh != mesh) continue;
            for_each_transform(id, [&](const glm::dmat4& world_from_object) {
                const glm::dmat3 linear(world_from_object);
                const double volume = std::abs(glm::determinant(linear));
                if (!std::isfinite(volume) || !(volume > 1e-30)) return;
                smallest = std::min(smallest, volume);
                if (!(volume > largest)) return;
                largest = volume;
                out.linear = linear;
            });
        }
        constexpr double hundredth = 1.01 * 1.01 * 1.01;
        out.others_are_smaller = largest > hundredth * smallest;
        return out;
    }

  private:
    template <typename Action>
    void for_each_transform(NodeId id, const Action& action) const {
        const Node& node = scene_.nodes[id.value];
        const glm::dmat4& world_from_node = world_from_node_[id.value];
        if (node.node_from_instance == nullptr) {
            action(world_from_node);
            return;
        }
        for (const Mat4& node_from_instance : *node.node_from_instance)
            action(world_from_node * glm::dmat4(node_from_instance));
    }

    const Scene& scene_;
    std::vector<glm::dmat4> world_from_node_;
    std::vector<NodeId> nodes_;  // of the active scene, with a mesh, in the order of the tree
};

class BodyMaker {
  public:
    BodyMaker(const Detail& detail, double radius, const glm::dmat3& world_from_object)
        : detail_(detail),
          radius_(radius),
          world_from_object_(world_from_object),
          object_from_world_(glm::inverse(world_from_object)),
          object_from_normal_(glm::transpose(world_from_object)),
          mirrored_(glm::determinant(world_from_object) < 0.0) {
        // All spheres are alike.
        for (const Vec3& normal : detail.sphere.normals)
            sphere_.push_back(relative(glm::dvec3(normal)));
        for (uint32_t i = 0; i < detail.sides; ++i) {
            const double angle = 2.0 * 3.14159265358979323846 * i / detail.sides;
            sides_.emplace_back(std::cos(angle), std::sin(angle));
        }
    }

    void make(Primitive& primitive) {
        const std::vector<Vec3u> strokes = std::move(primitive.triangles);
        const std::vector<Vec3> positions = std::move(primitive.positions);
        primitive.positions = primitive.normals = {};
        // Where each sphere and each tube begins is known, so many can be made at a time.
        std::vector<Vec3u> tubes;
        for (const Vec3u& stroke : strokes) {
            if (stroke.x != stroke.y && has_length(axis_of(positions, stroke))) tubes.push_back(stroke);
        }
        const size_t sphere_vertices = detail_.sphere.normals.size(),
                     sphere_triangles = detail_.sphere.triangles.size();
        const size_t tube_corners = size_t{2} * detail_.sides;
        const size_t vertices = positions.size() * sphere_vertices + tubes.size() * tube_corners;
        positions_.reserve(vertices + position_padding);
        positions_.resize(vertices);
        normals_.resize(vertices);
        const bool has_more = vertex_bytes(primitive) > 0 || primitive.deformation != nullptr;
        if (has_more) sources_.resize(vertices);
        triangles_.resize(positions.size() * sphere_triangles + tubes.size() * tube_corners);
        parallel_for_each(positions.size(), 64, [&](size_t v) {
            put_sphere(positions[v], static_cast<uint32_t>(v), v * sphere_vertices, v * sphere_triangles);
        });
        parallel_for_each(tubes.size(), 64, [&](size_t i) {
            put_tube(positions, tubes[i], positions.size() * sphere_vertices + i * tube_corners,
                     positions.size() * sphere_triangles + i * tube_corners);
        });
        if (has_more) gather_vertices(primitive, sources_);
        primitive.positions = std::move(positions_);
        primitive.normals = std::move(normals_);
        primitive.triangles = std::move(triangles_);
        primitive.flat_normals = false;
    }

  private:
    // A vertex of a body: how far from the middle, and its normal.
    struct Offset {
        glm::dvec3 offset;
        Vec3 normal;
    };
    Offset relative(const glm::dvec3& world_normal) const {
        return {object_from_world_ * (radius_ * world_normal),
                Vec3(glm::normalize(object_from_normal_ * world_normal))};
    }
    glm::dvec3 axis_of(const std::vector<Vec3>& positions, const Vec3u& stroke) const {
        return world_from_object_ * (glm::dvec3(positions[stroke.y]) - glm::dvec3(positions[stroke.x]));
    }
    static bool has_length(const glm::dvec3& axis) {
        const double length = glm::length(axis);
        return length > 0.0 && std::isfinite(length);
    }

    void put_vertex(size_t at, const Vec3& center, const Offset& offset, uint32_t source) {
        positions_[at] = Vec3(glm::dvec3(center) + offset.offset);
        normals_[at] = offset.normal;
        if (!sources_.empty()) sources_[at] = source;
    }

    // Wound as seen from outside in the world; a mirroring node turns that round (glTF 2.0, section 3.7.4).
    void put_triangle(size_t at, uint32_t a, uint32_t b, uint32_t c) {
        triangles_[at] = mirrored_ ? Vec3u(a, c, b) : Vec3u(a, b, c);
    }

    void put_sphere(const Vec3& center, uint32_t source, size_t vertex, size_t triangle) {
        const auto first = static_cast<uint32_t>(vertex);
        for (const Offset& offset : sphere_)
            put_vertex(vertex++, center, offset, source);
        for (const Vec3u& t : detail_.sphere.triangles)
            put_triangle(triangle++, first + t.x, first + t.y, first + t.z);
    }

    void put_tube(const std::vector<Vec3>& positions, const Vec3u& stroke, size_t vertex, size_t triangle) {
        const glm::dvec3 along = axis_of(positions, stroke);
        const glm::dvec3 d = along / glm::length(along);
        const glm::dvec3 axis = std::abs(d.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const glm::dvec3 u = glm::normalize(axis - d * glm::dot(d, axis)), v = glm::cross(d, u);
        const auto first = static_cast<uint32_t>(vertex);
        for (const auto& [cosine, sine] : sides_) {
            const Offset offset = relative(cosine * u + sine * v);
            put_vertex(vertex++, positions[stroke.x], offset, stroke.x);
            put_vertex(vertex++, positions[stroke.y], offset, stroke.y);
        }
        const auto sides = static_cast<uint32_t>(sides_.size());
        for (uint32_t i = 0; i < sides; ++i) {
            const uint32_t a0 = first + 2 * i, a1 = first + 2 * ((i + 1) % sides);
            put_triangle(triangle++, a0, a1, a0 + 1);
            put_triangle(triangle++, a1, a1 + 1, a0 + 1);
        }
    }

    const Detail& detail_;
    double radius_;
    glm::dmat3 world_from_object_, object_from_world_, object_from_normal_;
    bool mirrored_;
    std::vector<Offset> sphere_;
    std::vector<std::pair<double, double>> sides_;  // cosine and sine
    std::vector<Vec3> positions_, normals_;
    std::vector<Vec3u> triangles_;
    std::vector<uint32_t> sources_;  // of each vertex, where it has more than position and normal
};

}  // namespace

float stroke_width(float scene_diagonal, uint64_t count) {
    const float diagonal = scene_diagonal > 0.0f && std::isfinite(scene_diagonal) ? scene_diagonal : 1.0f;
    return diagonal / std::max(1.0f / stroke_width_per_diagonal, 4.0f * std::sqrt(static_cast<float>(count)));
}

void give_strokes_bodies(LoadContext& context, Scene& scene, std::vector<Mesh>& meshes) {
    // Count what there is, to choose how fine and how thick it may be.
    StrokeSummary& summary = scene.strokes;
    uint64_t spheres = 0, tubes = 0;
    for (const Mesh& mesh : meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            if (primitive.shape == PrimitiveShape::surface) continue;
            spheres += primitive.positions.size();
            if (primitive.shape == PrimitiveShape::points) {
                summary.points += primitive.positions.size();
            } else {
                tubes += primitive.triangles.size();
            }
        }
    }
    if (spheres == 0) return;
    summary.segments = tubes;
    const Placements placements(scene);
    summary.width_m = stroke_width(placements.diagonal(meshes), spheres + tubes);
    const Detail detail = choose_detail(spheres + tubes);

    for (uint32_t m = 0; m < meshes.size(); ++m) {
        const bool has_strokes = std::any_of(meshes[m].primitives.begin(), meshes[m].primitives.end(),
                                             [](const auto& p) { return p.shape != PrimitiveShape::surface; });
        if (!has_strokes) continue;
        const Placements::Largest largest = placements.largest_of(MeshId{m});
        if (largest.others_are_smaller) {
            context.warn(pointer_to("/meshes", m),
                         "is placed in several sizes: its points and lines are thinner where it is not the largest");
        }
        for (Primitive& primitive : meshes[m].primitives) {
            if (primitive.shape == PrimitiveShape::surface) continue;
            context.check_cancel();
            const uint64_t own_tubes = primitive.shape == PrimitiveShape::lines ? primitive.triangles.size() : 0;
            const uint64_t own_spheres = primitive.positions.size();
            const uint64_t vertices = own_spheres * detail.sphere.normals.size() + own_tubes * 2 * detail.sides;
            const uint64_t triangles = own_spheres * detail.sphere.triangles.size() + own_tubes * 2 * detail.sides;
            const uint64_t bytes_each = own_spheres == 0 ? 0 : vertex_bytes(primitive) / own_spheres + sizeof(Vec3);
            const std::string where = pointer_to("/meshes", m);
            context.charge(vertices, bytes_each + sizeof(uint32_t), where);
            context.charge(triangles, sizeof(Vec3u), where);
            if (vertices >= 0xffffffffu) context.fail(where, "has more points and lines than can be drawn");
            BodyMaker(detail, 0.5 * static_cast<double>(summary.width_m), largest.linear).make(primitive);
            context.release(vertices * sizeof(uint32_t));
        }
    }
}

}  // namespace candela
