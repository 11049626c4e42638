// SPDX-License-Identifier: MIT
#include "renderer/io/meshes.h"

#include <atomic>
#include <exception>

#include "renderer/io/deformations.h"
#include "renderer/io/draco_primitive.h"
#include "renderer/io/materials.h"
#include "renderer/io/repair.h"
#include "renderer/io/tangents.h"
#include "renderer/io/tinygltf.h"
#include "renderer/io/topology.h"
#include "renderer/io/variants.h"
#include "renderer/math/parallel.h"
#include "renderer/scene/deform.h"

namespace candela {
namespace {

class PrimitiveLoader {
  public:
    PrimitiveLoader(LoadContext& context, AccessorReader& accessors, DracoPrimitives& draco, const Scene& scene,
                    const tinygltf::Primitive& source, std::string where, bool skinned)
        : context_(context),
          accessors_(accessors),
          draco_(draco),
          scene_(scene),
          source_(source),
          where_(std::move(where)),
          skinned_(skinned) {}

    // Empty where there is nothing to show.
    std::optional<Primitive> load();

  private:
    std::optional<uint32_t> attribute(const char* name) const;
    std::string attribute_place(const char* name) const { return where_ + "/attributes/" + name; }
    std::vector<Vec3u> load_triangles(PrimitiveMode mode, uint64_t vertex_count, uint32_t positions);
    void load_attributes(Primitive& out, bool wants_tangents);
    template <typename Element>
    std::vector<Element> same_length(std::vector<Element> values, size_t vertex_count, const char* name) const;
    void load_materials(Primitive& out);
    bool wants_tangents(const Primitive& primitive) const;
    void repair(Primitive& out);
    void check_uv_sets(const Primitive& primitive);

    LoadContext& context_;
    AccessorReader& accessors_;
    DracoPrimitives& draco_;
    const Scene& scene_;
    const tinygltf::Primitive& source_;
    std::string where_;
    bool skinned_;
};

// The primitive's own material and those of its variants, as far as it has any.
template <typename Action>
void for_each_material(const Primitive& primitive, const Action& action) {
    if (primitive.material.valid()) action(primitive.material);
    for (const VariantMaterial& each : primitive.variants) {
        if (each.material.valid()) action(each.material);
    }
}

// Tangents run along one set of coordinates: the first that a material of the primitive asks for.
std::optional<uint32_t> tangent_uv_set_of(const Scene& scene, const Primitive& primitive) {
    std::optional<uint32_t> out;
    for_each_material(primitive, [&](MaterialId id) {
        if (!out) out = tangent_uv_set(scene.materials[id.value]);
    });
    return out;
}

bool is_required(const Scene& scene, std::string_view extension) {
    return std::any_of(scene.extensions.begin(), scene.extensions.end(),
                       [&](const ExtensionUse& use) { return use.required && use.name == extension; });
}

// The largest value of the type (glTF 2.0, section 3.7.2.1).
uint32_t restart_value(ComponentType type) {
    return type == ComponentType::u8 ? 0xffu : type == ComponentType::u16 ? 0xffffu : 0xffffffffu;
}

std::optional<uint32_t> PrimitiveLoader::attribute(const char* name) const {
    const auto found = source_.attributes.find(name);
    if (found == source_.attributes.end()) return std::nullopt;
    return static_cast<uint32_t>(found->second);
}

std::vector<Vec3u> PrimitiveLoader::load_triangles(PrimitiveMode mode, uint64_t vertex_count, uint32_t positions) {
    const std::string indices_place = where_ + "/indices";
    std::vector<uint32_t> corners;
    uint64_t corner_count = vertex_count;
    if (source_.indices >= 0) {
        corners = accessors_.read_indices(static_cast<uint32_t>(source_.indices), indices_place);
        corner_count = corners.size();
        // Any vertex index that passes here may be used unchecked from now on.
        const uint32_t restart = restart_value(accessors_.layout(static_cast<uint32_t>(source_.indices)).type);
        for (size_t i = 0; i < corners.size(); ++i) {
            if (corners[i] == restart) {
                context_.fail(indices_place, "holds the primitive restart value " + std::to_string(restart) +
                                                 " at element " + std::to_string(i) +
                                                 ", which glTF forbids; export the strips as primitives of their own");
            }
            if (corners[i] < vertex_count) continue;
            context_.fail(indices_place, "vertex index " + std::to_string(corners[i]) + " at element " +
                                             std::to_string(i) + " is not below the " + std::to_string(vertex_count) +
                                             " vertices of " + pointer_to("/accessors", positions));
        }
    }
    const uint64_t count = triangle_count(mode, corner_count);
    const uint64_t corners_each = mode == PrimitiveMode::triangles ? 3 : mode == PrimitiveMode::lines ? 2 : 1;
    if (corner_count % corners_each != 0) {
        context_.warn(where_, "the number of corners is not a multiple of " + std::to_string(corners_each) +
                                  "; the last are ignored");
    }
    context_.charge(count, sizeof(Vec3u), where_);
    std::vector<Vec3u> triangles = source_.indices >= 0 ? assemble_triangles(mode, corners)
                                                        : assemble_triangles(mode, static_cast<uint32_t>(vertex_count));
    context_.release(corners.size() * sizeof(uint32_t));
    return triangles;
}

template <typename Element>
std::vector<Element> PrimitiveLoader::same_length(std::vector<Element> values, size_t vertex_count,
                                                  const char* name) const {
    if (values.size() != vertex_count) {
        context_.fail(attribute_place(name), "has " + std::to_string(values.size()) + " elements, but POSITION has " +
                                                 std::to_string(vertex_count));
    }
    return values;
}

void PrimitiveLoader::load_attributes(Primitive& out, bool wants_tangents) {
    const size_t count = out.positions.size();
    // Points and lines get the normals of their bodies.
    const auto normals = out.shape == PrimitiveShape::surface ? attribute("NORMAL") : std::nullopt;
    if (normals) {
        out.normals = same_length(accessors_.read_vec3(*normals, attribute_place("NORMAL")), count, "NORMAL");
        // Without normals of its own a mesh gets flat ones, and its tangents are to be ignored (section 3.7.2.1).
        const auto tangents = attribute("TANGENT");
        if (wants_tangents && tangents) {
            out.tangents = same_length(accessors_.read_vec4(*tangents, attribute_place("TANGENT")), count, "TANGENT");
        }
    }
    out.flat_normals = out.normals.empty();
    for (const auto& [set, name] : {std::pair{0, "TEXCOORD_0"}, std::pair{1, "TEXCOORD_1"}}) {
        const auto uv = attribute(name);
        if (uv) out.uv[set] = same_length(accessors_.read_vec2(*uv, attribute_place(name)), count, name);
    }
    if (const auto colors = attribute("COLOR_0")) {
        out.colors = same_length(accessors_.read_colors(*colors, attribute_place("COLOR_0")), count, "COLOR_0");
    }
}

void PrimitiveLoader::repair(Primitive& out) {
    // Exporters let many primitives share one large set of vertices; each keeps only its own part.
    const uint64_t bytes_before = vertex_bytes(out);
    drop_unused_vertices(out);
    context_.release(bytes_before - vertex_bytes(out));
    if (drop_unplaceable_triangles(out) > 0) {
        context_.warn(attribute_place("POSITION"),
                      "holds values that are not finite or beyond 1e9; the triangles there are dropped");
        if (out.shape != PrimitiveShape::surface) drop_unused_vertices(out);
    }
    if (repair_normals(out) > 0) {
        context_.warn(attribute_place("NORMAL"),
                      "holds vectors without a direction; normals of the adjoining triangles are used there");
    }
    if (repair_tangents(out) > 0) {
        context_.warn(attribute_place("TANGENT"), "holds vectors without a direction; arbitrary ones are used there");
    }
    if (repair_uv_and_colors(out) > 0) {
        context_.warn(where_ + "/attributes", "texture coordinates or colours that are not finite were replaced");
    }
}

void PrimitiveLoader::check_uv_sets(const Primitive& primitive) {
    for_each_material(primitive, [&](MaterialId id) {
        for (const TextureSlot& slot : texture_slots(scene_.materials[id.value])) {
            if (!primitive.uv[slot.ref->uv_set].empty()) continue;
            context_.warn(where_, "has no TEXCOORD_" + std::to_string(slot.ref->uv_set) + " for its material's " +
                                      slot.name + "; one texel is used throughout");
        }
    });
}

void PrimitiveLoader::load_materials(Primitive& out) {
    if (source_.material >= 0) out.material = MaterialId{static_cast<uint32_t>(source_.material)};
    read_variant_mappings(context_, source_, where_, out.variants);
}

// Whether some material of the primitive shades along tangents.
bool PrimitiveLoader::wants_tangents(const Primitive& primitive) const {
    return tangent_uv_set_of(scene_, primitive).has_value();
}

std::optional<Primitive> PrimitiveLoader::load() {
    if (source_.mode < 0 || source_.mode > 6) {
        context_.fail(where_ + "/mode", std::to_string(source_.mode) + " is not a primitive mode of glTF");
    }
    auto mode = static_cast<PrimitiveMode>(source_.mode);
    const auto positions = attribute("POSITION");
    if (!positions) {
        context_.warn(where_, "has no POSITION and is not shown");
        return std::nullopt;
    }
    if (accessors_.layout(*positions).count >= 0xffffffffu) {
        context_.fail(pointer_to("/accessors", *positions, "count"), "more vertices than 32-bit indices can name");
    }
    if (draco_.decode(source_, where_, is_required(scene_, "KHR_draco_mesh_compression"))) {
        mode = PrimitiveMode::triangles;
    }

    Primitive out;
    if (mode < PrimitiveMode::triangles) {
        out.shape = mode == PrimitiveMode::points ? PrimitiveShape::points : PrimitiveShape::lines;
    }
    out.positions = accessors_.read_vec3(*positions, attribute_place("POSITION"));
    out.triangles = load_triangles(mode, out.positions.size(), *positions);
    load_materials(out);
    load_attributes(out, wants_tangents(out));
    load_deformation(context_, accessors_, source_, where_, skinned_, out);
    draco_.finish();
    repair(out);
    if (out.triangles.empty()) {
        context_.warn(where_, "has nothing that can be shown");
        return std::nullopt;
    }
    check_uv_sets(out);
    return out;
}

// Every primitive of the file, in order, and what becomes of it.
struct PrimitiveSource {
    const tinygltf::Primitive* source = nullptr;
    std::string where;
    bool skinned = false;
};

class PrimitivesLoader {
  public:
    PrimitivesLoader(LoadContext& context, AccessorReader& accessors, const Scene& scene,
                     std::vector<PrimitiveSource> sources)
        : context_(context), accessors_(accessors), scene_(scene), sources_(std::move(sources)) {}

    std::vector<std::optional<Primitive>> run();

  private:
    struct Part {
        size_t first = 0, last = 0;
        Diagnostics diagnostics;
        std::exception_ptr error;
        bool over_limit = false;
        uint64_t booked_bytes = 0, most_bytes = 0;
    };
    std::vector<Part> parts() const;
    void load(LoadContext& context, AccessorReader& accessors, size_t first, size_t last);
    bool run_together();
    bool fits_in_order(const std::vector<Part>& all, uint64_t held_bytes) const;

    LoadContext& context_;
    AccessorReader& accessors_;
    const Scene& scene_;
    std::vector<PrimitiveSource> sources_;
    std::vector<std::optional<Primitive>> out_;
};

void PrimitivesLoader::load(LoadContext& context, AccessorReader& accessors, size_t first, size_t last) {
    DracoPrimitives draco(context, accessors);
    for (size_t i = first; i < last; ++i) {
        context.check_cancel();
        const PrimitiveSource& each = sources_[i];
        PrimitiveLoader loader(context, accessors, draco, scene_, *each.source, each.where, each.skinned);
        if (std::optional<Primitive> loaded = loader.load()) out_[i].emplace(std::move(*loaded));
    }
}

// Primitives that share compressed data stay together.
std::vector<PrimitivesLoader::Part> PrimitivesLoader::parts() const {
    std::vector<Part> out;
    std::optional<uint32_t> last_view;
    for (size_t i = 0; i < sources_.size(); ++i) {
        const std::optional<uint32_t> view = draco_view(*sources_[i].source);
        if (i == 0 || !view || view != last_view) out.emplace_back().first = i;
        out.back().last = i + 1;
        last_view = view;
    }
    return out;
}

// Whether each would have had memory enough after those before it. Several at a time may come by with a little less, as
// chance has it.
bool PrimitivesLoader::fits_in_order(const std::vector<Part>& all, uint64_t held_bytes) const {
    for (const Part& part : all) {
        if (part.over_limit || held_bytes + part.most_bytes > context_.options().max_memory_bytes) return false;
        if (part.error) break;
        held_bytes += part.booked_bytes;
    }
    return true;
}

// False where there was not memory enough for several at a time, or not for all in order: nothing has happened then.
bool PrimitivesLoader::run_together() {
    // Primitives often share their views.
    std::vector<uint32_t> read;
    for (const PrimitiveSource& each : sources_) {
        for (const auto& [name, accessor] : each.source->attributes)
            read.push_back(static_cast<uint32_t>(accessor));
        if (each.source->indices >= 0) read.push_back(static_cast<uint32_t>(each.source->indices));
    }
    accessors_.decode_early(read);

    std::vector<Part> all = parts();
    const uint64_t held_bytes = context_.net_bytes();
    std::atomic<size_t> first_failed{all.size()};
    parallel_for_each(all.size(), 1, [&](size_t i) {
        // What comes after a failure need not be known; what comes before must.
        if (i > first_failed.load(std::memory_order_relaxed)) return;
        Part& part = all[i];
        LoadContext context(context_, part.diagnostics);
        AccessorReader accessors(context, accessors_);
        try {
            load(context, accessors, part.first, part.last);
        } catch (const OverMemoryLimit&) {
            part.error = std::current_exception();
            part.over_limit = true;
        } catch (...) {
            part.error = std::current_exception();
        }
        part.booked_bytes = context.net_bytes();
        part.most_bytes = context.most_bytes();
        size_t lowest = first_failed.load();
        while (part.error && i < lowest && !first_failed.compare_exchange_weak(lowest, i)) {
        }
    });
    if (!fits_in_order(all, held_bytes)) {
        for (const Part& part : all)
            context_.release(part.booked_bytes);
        return false;
    }
    for (const Part& part : all) {
        for (const Diagnostic& warning : part.diagnostics.warnings())
            context_.warn(warning.where, warning.message);
        if (part.error) std::rethrow_exception(part.error);
    }
    return true;
}

std::vector<std::optional<Primitive>> PrimitivesLoader::run() {
    out_.resize(sources_.size());
    // Only the loading thread may ask the images for their memory.
    std::function<void()> relief = context_.take_relief();
    const bool done = run_together();
    context_.set_relief(std::move(relief));
    if (!done) {
        out_.clear();
        out_.resize(sources_.size());
        load(context_, accessors_, 0, sources_.size());
    }
    return std::move(out_);
}

}  // namespace

std::vector<Mesh> load_meshes(LoadContext& context, const tinygltf::Model& model, AccessorReader& accessors,
                              const Scene& scene) {
    std::vector<uint8_t> skinned(model.meshes.size(), 0);
    for (const Node& node : scene.nodes) {
        if (node.mesh.valid() && node.skin.valid()) skinned[node.mesh.value] = 1;
    }
    std::vector<PrimitiveSource> sources;
    for (size_t m = 0; m < model.meshes.size(); ++m) {
        for (size_t p = 0; p < model.meshes[m].primitives.size(); ++p)
            sources.push_back(
                {&model.meshes[m].primitives[p], pointer_to("/meshes", m, "primitives", p), skinned[m] != 0});
    }
    std::vector<std::optional<Primitive>> primitives =
        PrimitivesLoader(context, accessors, scene, std::move(sources)).run();

    std::vector<Mesh> meshes;
    size_t next = 0;
    for (const tinygltf::Mesh& source : model.meshes) {
        Mesh& mesh = meshes.emplace_back();
        mesh.name = source.name;
        for (size_t p = 0; p < source.primitives.size(); ++p, ++next) {
            if (primitives[next]) mesh.primitives.push_back(std::move(*primitives[next]));
        }
    }
    return meshes;
}

void generate_missing_tangents(LoadContext& context, const Scene& scene, std::vector<Mesh>& meshes) {
    std::vector<std::pair<Primitive*, uint32_t>> missing;
    for (size_t m = 0; m < meshes.size(); ++m) {
        for (Primitive& primitive : meshes[m].primitives) {
            if (!primitive.tangents.empty()) continue;
            const std::optional<uint32_t> uv_set = tangent_uv_set_of(scene, primitive);
            if (!uv_set || primitive.uv[*uv_set].empty()) continue;
            // Vertices may be split, up to one per corner.
            context.charge(primitive.triangles.size() * 3, sizeof(Vec4), pointer_to("/meshes", m));
            const size_t targets = primitive.deformation ? primitive.deformation->targets.size() : 0;
            context.charge(primitive.triangles.size() * 3, targets * sizeof(Vec3), pointer_to("/meshes", m));
            missing.emplace_back(&primitive, *uv_set);
        }
    }
    parallel_for_each(missing.size(), 1, [&](size_t i) {
        context.check_cancel();
        generate_tangents(*missing[i].first, missing[i].second);
    });
}

}  // namespace candela
