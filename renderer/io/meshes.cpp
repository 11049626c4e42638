// SPDX-License-Identifier: MIT
#include "renderer/io/meshes.h"

#include "renderer/io/repair.h"
#include "renderer/io/tangents.h"
#include "renderer/io/tinygltf.h"
#include "renderer/io/topology.h"

namespace candela {
namespace {

class MeshLoader {
  public:
    MeshLoader(LoadContext& context, AccessorReader& accessors, Scene& scene)
        : context_(context), accessors_(accessors), scene_(scene) {}

    Mesh mesh(const tinygltf::Mesh& source, const std::string& where);

  private:
    bool primitive(const tinygltf::Primitive& source, const std::string& where, Primitive& out);
    void read_attributes(const tinygltf::Primitive& source, const std::string& where, Primitive& out);
    void read_triangles(const tinygltf::Primitive& source, PrimitiveMode mode, const std::string& where, Primitive& out);
    void mend(const std::string& where, Primitive& out);
    void find_tangents(const std::string& where, Primitive& out);

    LoadContext& context_;
    AccessorReader& accessors_;
    Scene& scene_;
};

void MeshLoader::read_attributes(const tinygltf::Primitive& source, const std::string& where, Primitive& out) {
    const std::string place = where + "/attributes/";
    out.positions = accessors_.read_vec3(static_cast<uint32_t>(source.attributes.at("POSITION")), place + "POSITION");
    const auto with = [&](const char* name, auto&& read) {
        const auto found = source.attributes.find(name);
        if (found == source.attributes.end()) return;
        const auto accessor = static_cast<uint32_t>(found->second);
        if (accessors_.layout(accessor).count != out.positions.size()) {
            context_.fail(place + name, "has " + std::to_string(accessors_.layout(accessor).count) +
                                            " elements, but POSITION has " + std::to_string(out.positions.size()));
        }
        read(accessor, place + name);
    };
    with("NORMAL", [&](uint32_t a, const std::string& w) { out.normals = accessors_.read_vec3(a, w); });
    with("TANGENT", [&](uint32_t a, const std::string& w) { out.tangents = accessors_.read_vec4(a, w); });
    with("TEXCOORD_0", [&](uint32_t a, const std::string& w) { out.uv[0] = accessors_.read_vec2(a, w); });
    with("TEXCOORD_1", [&](uint32_t a, const std::string& w) { out.uv[1] = accessors_.read_vec2(a, w); });
    with("COLOR_0", [&](uint32_t a, const std::string& w) { out.colors = accessors_.read_colors(a, w); });
}

void MeshLoader::read_triangles(const tinygltf::Primitive& source, PrimitiveMode mode, const std::string& where,
                                Primitive& out) {
    const uint64_t vertices = out.positions.size();
    if (source.indices < 0) {
        context_.charge(triangle_count(mode, vertices), sizeof(Vec3u), where);
        out.triangles = assemble_triangles(mode, static_cast<uint32_t>(vertices));
        return;
    }
    const auto accessor = static_cast<uint32_t>(source.indices);
    const std::vector<uint32_t> corners = accessors_.read_indices(accessor, where + "/indices");
    for (size_t i = 0; i < corners.size(); ++i) {
        if (corners[i] < vertices) continue;
        context_.fail(pointer_to("/accessors", accessor), "index " + std::to_string(corners[i]) + " at element " +
                                                              std::to_string(i) + " is not below the vertex count of " +
                                                              std::to_string(vertices));
    }
    context_.charge(triangle_count(mode, corners.size()), sizeof(Vec3u), where);
    out.triangles = assemble_triangles(mode, corners);
    context_.release(corners.size() * sizeof(uint32_t));
}

// What the renderer relies on is made true here; what had to be mended is said.
void MeshLoader::mend(const std::string& where, Primitive& out) {
    drop_unused_vertices(out);
    if (const size_t n = drop_unplaceable_triangles(out); n > 0) {
        context_.warn(where, std::to_string(n) + " triangles have corners that are not finite and were left out");
    }
    if (out.normals.empty()) {
        // glTF 2.0, section 3.7.2.1: without normals the mesh is flat, and given tangents do not count.
        out.flat_normals = true;
        out.tangents.clear();
    } else if (const size_t n = repair_normals(out); n > 0) {
        context_.warn(where + "/attributes/NORMAL", std::to_string(n) + " normals have no direction and were replaced");
    }
    if (const size_t n = repair_uv_and_colors(out); n > 0) {
        context_.warn(where + "/attributes", std::to_string(n) + " values are not finite or negative and were replaced");
    }
}

void MeshLoader::find_tangents(const std::string& where, Primitive& out) {
    const Material* material = out.material.valid() ? &scene_.materials[out.material.value] : nullptr;
    if (material == nullptr || !material->normal.valid()) {
        out.tangents.clear();
        return;
    }
    const uint32_t uv_set = material->normal.uv_set;
    if (!out.tangents.empty()) {
        if (const size_t n = repair_tangents(out); n > 0) {
            context_.warn(where + "/attributes/TANGENT", std::to_string(n) + " tangents have no direction and were replaced");
        }
    } else if (out.uv[uv_set].empty()) {
        context_.warn(where, "has a normal map but no texture coordinates for it");
    } else {
        generate_tangents(out, uv_set);
    }
}

bool MeshLoader::primitive(const tinygltf::Primitive& source, const std::string& where, Primitive& out) {
    if (source.mode < 0 || source.mode > 6) {
        context_.fail(where + "/mode", std::to_string(source.mode) + " is no primitive mode of glTF");
    }
    const auto mode = static_cast<PrimitiveMode>(source.mode);
    if (std::string_view(mode_name(mode)) != "triangles") {
        context_.warn(where + "/mode", std::string(mode_name(mode)) + " are not drawn");
        return false;
    }
    if (source.attributes.count("POSITION") == 0) {
        context_.warn(where + "/attributes", "has no POSITION and is not drawn");
        return false;
    }
    if (!source.targets.empty()) context_.warn(where + "/targets", "morph targets are not applied; the base shape is shown");
    if (source.material >= 0) out.material = MaterialId{static_cast<uint32_t>(source.material)};
    read_attributes(source, where, out);
    read_triangles(source, mode, where, out);
    mend(where, out);
    find_tangents(where, out);
    return !out.triangles.empty();
}

Mesh MeshLoader::mesh(const tinygltf::Mesh& source, const std::string& where) {
    Mesh out;
    out.name = source.name;
    for (size_t i = 0; i < source.primitives.size(); ++i) {
        context_.check_cancel();
        Primitive made;
        if (primitive(source.primitives[i], pointer_to(where + "/primitives", i), made)) {
            out.primitives.push_back(std::move(made));
        }
    }
    return out;
}

}  // namespace

void load_meshes(LoadContext& context, const tinygltf::Model& model, AccessorReader& accessors, Scene& scene) {
    MeshLoader loader(context, accessors, scene);
    for (size_t i = 0; i < model.meshes.size(); ++i) {
        scene.meshes.push_back(loader.mesh(model.meshes[i], pointer_to("/meshes", i)));
        context.progress(0.1f + 0.3f * static_cast<float>(i + 1) / static_cast<float>(model.meshes.size()), "meshes");
    }
}

}  // namespace candela
