// SPDX-License-Identifier: MIT
#include "renderer/world/shape_table.h"

namespace candela {

namespace {

std::shared_ptr<const MeshVertices> make_vertices(const std::shared_ptr<const Mesh>& mesh,
                                                  const Mat4* world_from_object) {
    auto out = std::make_shared<MeshVertices>();
    out->mesh = mesh;
    if (world_from_object != nullptr) out->world_from_object = *world_from_object;
    const bool stays = world_from_object == nullptr || *world_from_object == Mat4(1.0f);
    for (const Primitive& primitive : mesh->primitives) {
        const std::vector<Vec3>& own = primitive.positions;
        if (stays && own.capacity() - own.size() >= position_padding) {
            out->positions.emplace_back(own);
        } else {
            out->copies.push_back(padded_positions(own, world_from_object));
            out->positions.emplace_back(std::span<const Vec3>(out->copies.back()).first(own.size()));
        }
        out->finite = out->finite && std::all_of(out->positions.back().begin(), out->positions.back().end(), is_finite);
    }
    return out;
}

// Whether a tree laid out for the one can be fitted to the other.
bool same_topology(const Mesh& rest, const Mesh& pose) {
    return std::equal(rest.primitives.begin(), rest.primitives.end(), pose.primitives.begin(), pose.primitives.end(),
                      [](const Primitive& a, const Primitive& b) {
                          return a.positions.size() == b.positions.size() && a.triangles == b.triangles;
                      });
}

bool is_flat_shape(const WorldShape& shape) {
    return shape.parts.front()->world_from_object.has_value();
}

AccelShape describe_shape(const WorldShape& shape) {
    AccelShape out;
    size_t k = 0;
    for (const std::shared_ptr<const MeshVertices>& part : shape.parts) {
        const Mesh& mesh = *(shape.rest ? shape.rest : part)->mesh;
        for (size_t i = 0; i < mesh.primitives.size(); ++i) {
            const size_t count = mesh.primitives[i].positions.size();
            AccelGeometry geometry;
            geometry.positions = part->positions[i].first(count);
            geometry.triangles = mesh.primitives[i].triangles;
            geometry.has_opacity = shape.has_opacity[k++] != 0;
            if (shape.rest) geometry.rest_positions = shape.rest->positions[i].first(count);
            out.geometries.push_back(geometry);
        }
    }
    out.owner = std::make_shared<const std::vector<std::shared_ptr<const MeshVertices>>>(shape.parts);
    out.rest = shape.rest;
    return out;
}

}  // namespace

ShapeTable::ShapeTable(World& world, const World* before)
    : world_(world), before_(before), opacity_(world, before), uses_(world.scene->meshes.size(), 0) {
    const Scene& scene = *world.scene;
    for (const Instance& instance : scene.instances) {
        const bool always_counts = instance.moves || instance.deforms;
        if (always_counts || classify_transform(instance.world_from_object) == TransformKind::invertible)
            ++uses_[instance.mesh.value];
    }
    // A mesh that an animation shows and hides counts in all poses.
    for (const Node& node : scene.nodes) {
        if (node.moves && node.mesh.valid()) uses_[node.mesh.value] += 2;
    }
    if (before == nullptr) return;
    for (uint32_t i = 0; i < before->shapes.size(); ++i) {
        const WorldShape& shape = before->shapes[i];
        if (is_flat_shape(shape)) continue;
        old_shapes_.emplace(shape.parts.front()->mesh.get(), i);
        if (shape.rest) rests_.emplace(shape.rest->mesh.get(), shape.rest);
    }
}

ShapeTable::Place ShapeTable::place(const Instance& instance, TransformKind kind) {
    const bool alone = !instance.moves && !instance.deforms;
    Place out;
    if (kind == TransformKind::invertible && !(alone && uses_[instance.mesh.value] < 2)) {
        out.shape = add_shape(instance);
    } else if (!alone) {
        out.shape = add_flat_shape(instance);
    } else {
        out.vertices = add_fixed(instance).get();
        return out;
    }
    out.vertices = world_.shapes[out.shape].parts.front().get();
    return out;
}

void ShapeTable::append_opacity(const Mesh& mesh, WorldShape& shape) {
    for (const Primitive& primitive : mesh.primitives)
        shape.has_opacity.push_back(opacity_.may_be_transparent(primitive) ? 1 : 0);
}

uint32_t ShapeTable::add_shape(const Instance& instance) {
    const std::shared_ptr<const Mesh>& mesh = world_.scene->meshes[instance.mesh.value];
    const auto [entry, is_new] = shapes_.emplace(mesh.get(), static_cast<uint32_t>(world_.shapes.size()));
    if (!is_new) return entry->second;
    WorldShape shape;
    append_opacity(*mesh, shape);
    if (const auto old = old_shapes_.find(mesh.get()); old != old_shapes_.end()) {
        shape.parts = before_->shapes[old->second].parts;
        shape.rest = before_->shapes[old->second].rest;
    } else {
        shape.parts = {make_vertices(mesh, nullptr)};
        if (instance.deforms) shape.rest = rest_of(instance, *shape.parts.front());
    }
    world_.shapes.push_back(std::move(shape));
    return entry->second;
}

// What animations shrink to a sheet can be no instance while it is one.
uint32_t ShapeTable::add_flat_shape(const Instance& instance) {
    const std::shared_ptr<const Mesh>& mesh = world_.scene->meshes[instance.mesh.value];
    WorldShape shape;
    append_opacity(*mesh, shape);
    shape.parts = {make_vertices(mesh, &instance.world_from_object)};
    world_.shapes.push_back(std::move(shape));
    return static_cast<uint32_t>(world_.shapes.size() - 1);
}

ShapeTable::Vertices ShapeTable::add_fixed(const Instance& instance) {
    const std::shared_ptr<const Mesh>& mesh = world_.scene->meshes[instance.mesh.value];
    append_opacity(*mesh, world_.fixed);
    const size_t index = world_.fixed.parts.size();
    Vertices vertices;
    if (before_ != nullptr && index < before_->fixed.parts.size()) {
        const Vertices& old = before_->fixed.parts[index];
        if (old->mesh == mesh && old->world_from_object == instance.world_from_object) vertices = old;
    }
    if (!vertices) vertices = make_vertices(mesh, &instance.world_from_object);
    world_.fixed.parts.push_back(vertices);
    return vertices;
}

// The mesh of its node, as the file models it; null: the tree has to be made for the pose.
ShapeTable::Vertices ShapeTable::rest_of(const Instance& instance, const MeshVertices& pose) {
    const Scene& scene = *world_.scene;
    const MeshId id = scene.nodes[instance.node.value].mesh;
    if (!id.valid() || !pose.finite || !same_topology(scene.mesh(id), *pose.mesh)) return nullptr;
    const std::shared_ptr<const Mesh>& mesh = scene.meshes[id.value];
    Vertices& rest = rests_[mesh.get()];
    if (!rest) rest = make_vertices(mesh, nullptr);
    return rest->finite ? rest : nullptr;
}

void ShapeTable::keep_hidden() {
    if (before_ == nullptr) return;
    const Scene& scene = *world_.scene;
    for (size_t i = 0; i + scene.posed_mesh_count < scene.meshes.size(); ++i) {
        const auto old = old_shapes_.find(scene.meshes[i].get());
        if (old == old_shapes_.end() || shapes_.contains(old->first)) continue;
        shapes_.emplace(old->first, static_cast<uint32_t>(world_.shapes.size()));
        world_.shapes.push_back(before_->shapes[old->second]);
    }
}

const WorldShape* ShapeTable::ready(const WorldShape& shape) const {
    if (before_ == nullptr || shape.parts.empty()) return nullptr;
    const WorldShape* old = &before_->fixed;
    if (&shape != &world_.fixed) {
        const auto found = old_shapes_.find(shape.parts.front()->mesh.get());
        if (is_flat_shape(shape) || found == old_shapes_.end()) return nullptr;
        old = &before_->shapes[found->second];
    }
    // Asking the opacity function where it need not be asked does no harm.
    const bool enough = std::equal(shape.has_opacity.begin(), shape.has_opacity.end(), old->has_opacity.begin(),
                                   old->has_opacity.end(), std::less_equal<uint8_t>());
    return enough && shape.parts == old->parts && shape.rest == old->rest ? old : nullptr;
}

void ShapeTable::describe(AccelInput& input) const {
    const auto described = [&](WorldShape& shape) {
        const WorldShape* old = ready(shape);
        if (old == nullptr) return describe_shape(shape);
        shape.has_opacity = old->has_opacity;
        AccelShape out;
        out.tree = old == &before_->fixed
                       ? before_->accel->fixed_tree()
                       : before_->accel->shape_tree(static_cast<size_t>(old - before_->shapes.data()));
        return out;
    };
    if (!world_.fixed.parts.empty()) input.fixed = described(world_.fixed);
    for (WorldShape& shape : world_.shapes)
        input.shapes.push_back(described(shape));
    input.relative = before_ != nullptr ? before_->accel.get() : nullptr;
}

}  // namespace candela
