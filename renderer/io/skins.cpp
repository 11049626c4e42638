// SPDX-License-Identifier: MIT
#include "renderer/io/skins.h"

#include <nlohmann/json.hpp>

#include "renderer/io/tinygltf.h"
#include "renderer/scene/deform.h"

namespace candela {
namespace {

bool is_finite(const Mat4& m) {
    return candela::is_finite(Vec3(m[0])) && candela::is_finite(Vec3(m[1])) && candela::is_finite(Vec3(m[2])) &&
           candela::is_finite(Vec3(m[3]));
}

std::vector<Mat4> read_bind_matrices(LoadContext& context, AccessorReader& accessors, uint32_t accessor,
                                     size_t joint_count, const std::string& where) {
    std::vector<Mat4> matrices = accessors.read_mat4(accessor, where);
    if (matrices.size() < joint_count) {
        context.fail(where, "has " + std::to_string(matrices.size()) + " matrices for " + std::to_string(joint_count) +
                                " joints");
    }
    matrices.resize(joint_count);
    bool affine = true;
    for (size_t i = 0; i < matrices.size(); ++i) {
        Mat4& m = matrices[i];
        if (!is_finite(m)) context.fail(where, "matrix " + std::to_string(i) + " is not finite");
        affine = affine && m[0][3] == 0.0f && m[1][3] == 0.0f && m[2][3] == 0.0f && m[3][3] == 1.0f;
        m[0][3] = m[1][3] = m[2][3] = 0.0f;
        m[3][3] = 1.0f;
    }
    if (!affine) context.warn(where, "holds matrices that are not affine; their last rows are taken as 0 0 0 1");
    return matrices;
}

uint32_t target_count(const Mesh& mesh) {
    uint32_t count = 0;
    for (const Primitive& primitive : mesh.primitives) {
        if (primitive.deformation) {
            count = std::max(count, static_cast<uint32_t>(primitive.deformation->targets.size()));
        }
    }
    return count;
}

uint32_t joint_count(const Mesh& mesh) {
    uint32_t count = 0;
    for (const Primitive& primitive : mesh.primitives) {
        if (primitive.deformation) count = std::max(count, primitive.deformation->joint_count);
    }
    return count;
}

// As many as there are targets; what is missing is 0.
std::vector<float> initial_weights(LoadContext& context, const std::vector<double>& given, uint32_t targets,
                                   const std::string& where) {
    if (!given.empty() && given.size() != targets) {
        context.warn(where, "has " + std::to_string(given.size()) + " weights for " + std::to_string(targets) +
                                " morph targets; missing ones are 0, others are ignored");
    }
    std::vector<float> out(targets, 0.0f);
    for (size_t i = 0; i < std::min(given.size(), out.size()); ++i)
        out[i] = static_cast<float>(given[i]);
    return out;
}

uint64_t bytes_of(const Mesh& mesh) {
    uint64_t bytes = 0;
    for (const Primitive& p : mesh.primitives) {
        bytes += p.positions.size() * sizeof(Vec3) + p.normals.size() * sizeof(Vec3) +
                 p.tangents.size() * sizeof(Vec4) + (p.uv[0].size() + p.uv[1].size()) * sizeof(Vec2) +
                 p.colors.size() * sizeof(Vec4) + p.triangles.size() * sizeof(Vec3u);
    }
    return bytes;
}

}  // namespace

void load_skins(LoadContext& context, const Json& document, AccessorReader& accessors, Scene& scene) {
    const auto skins = document.find("skins");
    if (skins == document.end()) return;
    for (size_t s = 0; s < skins->size(); ++s) {
        const Json& source = (*skins)[s];
        const std::string where = pointer_to("/skins", s);
        auto skin = std::make_shared<Skin>();
        skin->name = source.value("name", std::string());
        for (const Json& joint : source["joints"])
            skin->joints.push_back(NodeId{joint.get<uint32_t>()});
        if (skin->joints.empty()) context.warn(where + "/joints", "is empty; meshes with this skin are not deformed");
        const auto matrices = source.find("inverseBindMatrices");
        if (matrices != source.end()) {
            skin->joint_from_mesh = read_bind_matrices(context, accessors, matrices->get<uint32_t>(),
                                                       skin->joints.size(), where + "/inverseBindMatrices");
        } else {
            context.charge(skin->joints.size(), sizeof(Mat4), where);
            skin->joint_from_mesh.assign(skin->joints.size(), Mat4(1.0f));
        }
        scene.skins.push_back(std::move(skin));
    }
}

void connect_deformations(LoadContext& context, const tinygltf::Model& model, Scene& scene) {
    std::vector<uint32_t> targets, joints;
    for (const std::shared_ptr<const Mesh>& mesh : scene.meshes) {
        targets.push_back(target_count(*mesh));
        joints.push_back(joint_count(*mesh));
    }
    for (size_t m = 0; m < model.meshes.size(); ++m) {
        for (size_t p = 0; p < model.meshes[m].primitives.size(); ++p) {
            const size_t count = model.meshes[m].primitives[p].targets.size();
            if (count != targets[m] && targets[m] > 0) {
                context.warn(pointer_to("/meshes", m, "primitives", p, "targets"),
                             "has " + std::to_string(count) +
                                 " morph targets, where another primitive of the mesh has " +
                                 std::to_string(targets[m]));
            }
        }
    }
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        Node& node = scene.nodes[n];
        const std::string where = pointer_to("/nodes", n);
        if (!node.mesh.valid()) {
            if (node.skin.valid()) context.warn(where + "/skin", "the node has no mesh for it");
            node.skin = SkinId{};
            continue;
        }
        const uint32_t mesh = node.mesh.value;
        node.has_own_weights = !model.nodes[n].weights.empty();
        node.morph_weights = node.has_own_weights
                                 ? initial_weights(context, model.nodes[n].weights, targets[mesh], where + "/weights")
                                 : initial_weights(context, model.meshes[mesh].weights, targets[mesh],
                                                   pointer_to("/meshes", mesh, "weights"));
        if (!node.skin.valid()) continue;
        if (joints[mesh] == 0 || scene.skins[node.skin.value]->joints.empty()) {
            context.warn(where + "/skin", "no vertex of its mesh follows a joint; the skin is ignored");
            node.skin = SkinId{};
        } else if (joints[mesh] > scene.skins[node.skin.value]->joints.size()) {
            context.fail(where + "/skin", pointer_to("/skins", node.skin.value) + " has " +
                                              std::to_string(scene.skins[node.skin.value]->joints.size()) +
                                              " joints, but " + pointer_to("/meshes", mesh) + " uses joint " +
                                              std::to_string(joints[mesh] - 1));
        }
    }
}

void charge_posed_meshes(LoadContext& context, const Scene& scene) {
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        if (!node.mesh.valid() || !can_deform(scene.mesh(node.mesh), node.skin.valid())) continue;
        context.charge(bytes_of(scene.mesh(node.mesh)), pointer_to("/nodes", n));
    }
}

}  // namespace candela
