// SPDX-License-Identifier: MIT
#include "renderer/io/deformations.h"

#include "renderer/io/tinygltf.h"
#include "renderer/scene/deform.h"

namespace candela {
namespace {

class DeformationLoader {
  public:
    DeformationLoader(LoadContext& context, AccessorReader& accessors, const tinygltf::Primitive& source,
                      const std::string& where, const Primitive& primitive)
        : context_(context), accessors_(accessors), source_(source), where_(where), primitive_(primitive) {}

    void load_targets(Deformation& out);
    void load_influences(Deformation& out);

  private:
    template <typename Vector>
    std::vector<Vector> mended(std::vector<Vector> values, const std::string& where);
    template <typename Action>
    void with_attribute(const std::map<std::string, int>& target, const char* name, const std::string& place,
                        const Action& action);
    std::vector<Vec3> differences(const std::map<std::string, int>& target, const char* name, const std::string& place);
    std::vector<Vec4> color_differences(uint32_t accessor, const std::string& where);
    std::optional<uint32_t> attribute(const std::string& name) const;
    template <typename Element>
    void check_length(const std::vector<Element>& values, const std::string& place) const;
    std::vector<Vec4> read_joints(uint32_t accessor, const std::string& place);
    void normalize_weights(Deformation& out, float tolerance);

    LoadContext& context_;
    AccessorReader& accessors_;
    const tinygltf::Primitive& source_;
    const std::string& where_;
    const Primitive& primitive_;
};

template <typename Element>
void DeformationLoader::check_length(const std::vector<Element>& values, const std::string& place) const {
    if (values.size() == primitive_.positions.size()) return;
    context_.fail(place, "has " + std::to_string(values.size()) + " elements, but POSITION has " +
                             std::to_string(primitive_.positions.size()));
}

// Empty where the target does not change the attribute.
template <typename Vector>
std::vector<Vector> DeformationLoader::mended(std::vector<Vector> values, const std::string& where) {
    check_length(values, where);
    constexpr float largest = 1e9f;
    size_t bad = 0;
    for (Vector& value : values) {
        if (glm::all(glm::lessThanEqual(glm::abs(value), Vector(largest)))) continue;
        value = Vector(0);
        ++bad;
    }
    if (bad > 0) context_.warn(where, "holds values that are not finite or beyond 1e9; they are taken as 0");
    // The memory stays booked, or a file could have nothing read as often as it likes.
    if (std::all_of(values.begin(), values.end(), [](const Vector& v) { return v == Vector(0); })) return {};
    return values;
}

template <typename Action>
void DeformationLoader::with_attribute(const std::map<std::string, int>& target, const char* name,
                                       const std::string& place, const Action& action) {
    const auto found = target.find(name);
    if (found != target.end()) action(static_cast<uint32_t>(found->second), place + "/" + name);
}

std::vector<Vec3> DeformationLoader::differences(const std::map<std::string, int>& target, const char* name,
                                                 const std::string& place) {
    std::vector<Vec3> out;
    with_attribute(target, name, place, [&](uint32_t accessor, const std::string& where) {
        out = mended(accessors_.read_vec3(accessor, where), where);
    });
    return out;
}

std::vector<Vec4> DeformationLoader::color_differences(uint32_t accessor, const std::string& where) {
    std::vector<Vec4> values = accessors_.read_colors(accessor, where);
    // Three components leave the fourth as it is.
    if (accessors_.layout(accessor).rows == 3) {
        for (Vec4& value : values)
            value.a = 0.0f;
    }
    return mended(std::move(values), where);
}

void DeformationLoader::load_targets(Deformation& out) {
    for (size_t t = 0; t < source_.targets.size(); ++t) {
        context_.check_cancel();
        const std::string place = pointer_to(where_ + "/targets", t);
        const std::map<std::string, int>& target = source_.targets[t];
        MorphTarget& morph = out.targets.emplace_back();
        morph.positions = differences(target, "POSITION", place);
        for (size_t set = 0; set < 2; ++set) {
            if (primitive_.uv[set].empty()) continue;
            const char* name = set == 0 ? "TEXCOORD_0" : "TEXCOORD_1";
            with_attribute(target, name, place, [&](uint32_t accessor, const std::string& where) {
                morph.uv[set] = mended(accessors_.read_vec2(accessor, where), where);
            });
        }
        if (!primitive_.colors.empty()) {
            with_attribute(target, "COLOR_0", place, [&](uint32_t accessor, const std::string& where) {
                morph.colors = color_differences(accessor, where);
            });
        }
        for (const auto& [name, accessor] : target) {
            const bool is_read = name == "POSITION" || name == "NORMAL" || name == "TANGENT" ||
                                 (name == "TEXCOORD_0" && !primitive_.uv[0].empty()) ||
                                 (name == "TEXCOORD_1" && !primitive_.uv[1].empty()) ||
                                 (name == "COLOR_0" && !primitive_.colors.empty());
            if (!is_read) context_.warn(place, "its differences of " + name.substr(0, 40) + " are ignored");
        }
        // Flat normals follow from the positions, tangents that are not the file's are made for each target, and those
        // of points and lines come from their bodies.
        if (primitive_.shape != PrimitiveShape::surface) continue;
        if (!primitive_.normals.empty()) morph.normals = differences(target, "NORMAL", place);
        if (!primitive_.tangents.empty()) morph.tangents = differences(target, "TANGENT", place);
    }
}

std::optional<uint32_t> DeformationLoader::attribute(const std::string& name) const {
    const auto found = source_.attributes.find(name);
    if (found == source_.attributes.end()) return std::nullopt;
    return static_cast<uint32_t>(found->second);
}

std::vector<Vec4> DeformationLoader::read_joints(uint32_t accessor, const std::string& place) {
    const AccessorLayout& layout = accessors_.layout(accessor);
    if (layout.normalized || (layout.type != ComponentType::u8 && layout.type != ComponentType::u16)) {
        context_.fail(place, pointer_to("/accessors", accessor) + " is not of unsigned 8-bit or 16-bit integers");
    }
    std::vector<Vec4> joints = accessors_.read_vec4(accessor, place);
    check_length(joints, place);
    return joints;
}

void DeformationLoader::load_influences(Deformation& out) {
    struct Set {
        std::vector<Vec4> joints, weights;
    };
    std::vector<Set> sets;
    float tolerance = 0.0f;
    for (uint32_t n = 0;; ++n) {
        const std::string joints_name = "JOINTS_" + std::to_string(n), weights_name = "WEIGHTS_" + std::to_string(n);
        const auto joints = attribute(joints_name), weights = attribute(weights_name);
        if (!joints && !weights) break;
        if (!joints || !weights) {
            context_.warn(where_ + "/attributes/" + (joints ? joints_name : weights_name),
                          "has no " + (joints ? weights_name : joints_name) + " beside it and is ignored");
            continue;
        }
        const std::string weights_place = where_ + "/attributes/" + weights_name;
        Set& set = sets.emplace_back();
        set.joints = read_joints(*joints, where_ + "/attributes/" + joints_name);
        set.weights = accessors_.read_vec4(*weights, weights_place);
        check_length(set.weights, weights_place);
        // Integers count as normalized even where the file forgot to say so. Each may be half a step off.
        const AccessorLayout& layout = accessors_.layout(*weights);
        const float largest = layout.type == ComponentType::u8    ? 255.0f
                              : layout.type == ComponentType::u16 ? 65535.0f
                                                                  : 1.0f;
        if (!layout.normalized && largest > 1.0f) {
            for (Vec4& weight : set.weights)
                weight /= largest;
        }
        tolerance += largest > 1.0f ? 4.0f / largest : 1e-3f;
    }
    if (sets.empty()) return;

    const size_t count = primitive_.positions.size();
    const size_t each = 4 * sets.size();
    context_.charge(count * each, sizeof(uint16_t) + sizeof(float), where_ + "/attributes");
    out.influences_per_vertex = static_cast<uint32_t>(each);
    out.joints.reserve(count * each);
    out.weights.reserve(count * each);
    for (size_t i = 0; i < count; ++i) {
        for (const Set& set : sets) {
            for (int c = 0; c < 4; ++c) {
                out.joints.push_back(static_cast<uint16_t>(set.joints[i][c]));
                out.weights.push_back(set.weights[i][c]);
            }
        }
    }
    context_.release(sets.size() * count * 2 * sizeof(Vec4));
    normalize_weights(out, tolerance);
}

void DeformationLoader::normalize_weights(Deformation& out, float tolerance) {
    const size_t each = out.influences_per_vertex;
    size_t invalid = 0, unbound = 0, off = 0;
    for (size_t first = 0; first < out.weights.size(); first += each) {
        double sum = 0.0;
        for (size_t k = first; k < first + each; ++k) {
            float& weight = out.weights[k];
            if (!(weight >= 0.0f && weight <= 1e9f)) {
                weight = 0.0f;
                ++invalid;
            }
            sum += static_cast<double>(weight);
        }
        if (sum <= 0.0) ++unbound;
        if (sum > 0.0 && std::abs(sum - 1.0) > static_cast<double>(tolerance)) ++off;
        for (size_t k = first; k < first + each; ++k) {
            if (sum > 0.0) out.weights[k] = static_cast<float>(static_cast<double>(out.weights[k]) / sum);
            // Joints without weight may be anything.
            if (out.weights[k] == 0.0f) out.joints[k] = 0;
            if (out.weights[k] > 0.0f) out.joint_count = std::max(out.joint_count, uint32_t{out.joints[k]} + 1);
        }
    }
    const std::string place = where_ + "/attributes/WEIGHTS_0";
    if (invalid > 0) context_.warn(place, "holds weights that are negative or not finite; they are taken as 0");
    if (off > 0) context_.warn(place, "weights do not sum to 1 at some vertices; they are scaled to");
    if (unbound > 0) context_.warn(place, "some vertices follow no joint; they stay where the mesh has them");
}

}  // namespace

void load_deformation(LoadContext& context, AccessorReader& accessors, const tinygltf::Primitive& source,
                      const std::string& where, bool skinned, Primitive& out) {
    Deformation deformation;
    DeformationLoader loader(context, accessors, source, where, out);
    loader.load_targets(deformation);
    if (skinned) loader.load_influences(deformation);
    if (deformation.targets.empty() && deformation.influences_per_vertex == 0) return;
    out.deformation = std::make_shared<const Deformation>(std::move(deformation));
}

}  // namespace candela
