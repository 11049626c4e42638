// SPDX-License-Identifier: MIT
#include "renderer/io/instancing.h"

#include "renderer/io/tinygltf.h"

namespace candela {
namespace {

constexpr const char* name = "EXT_mesh_gpu_instancing";

class InstancingReader {
  public:
    InstancingReader(LoadContext& context, const Layout& layout, AccessorReader& accessors,
                     const tinygltf::Value& attributes, std::string where)
        : context_(context),
          layout_(layout),
          accessors_(accessors),
          attributes_(attributes),
          where_(std::move(where)) {}

    std::vector<Mat4> read() {
        const std::optional<uint32_t> translation = attribute("TRANSLATION");
        const std::optional<uint32_t> rotation = attribute("ROTATION");
        const std::optional<uint32_t> scale = attribute("SCALE");
        if (!translation && !rotation && !scale) return {};
        context_.charge(count_, sizeof(Mat4) + sizeof(Instance), where_);
        std::vector<Mat4> out(count_, Mat4(1.0f));
        if (rotation) apply_rotation(accessors_.read_vec4(*rotation, where_ + "/ROTATION"), out);
        if (scale) {
            const std::vector<Vec3> factors = accessors_.read_vec3(*scale, where_ + "/SCALE");
            for (size_t i = 0; i < out.size(); ++i) {
                for (int c = 0; c < 3; ++c)
                    out[i][c] *= factors[i][c];
            }
            context_.release(factors.size() * sizeof(Vec3));
        }
        if (translation) {
            const std::vector<Vec3> offsets = accessors_.read_vec3(*translation, where_ + "/TRANSLATION");
            for (size_t i = 0; i < out.size(); ++i)
                out[i][3] = Vec4(offsets[i], 1.0f);
            context_.release(offsets.size() * sizeof(Vec3));
        }
        return out;
    }

  private:
    // All attributes of a node have one count.
    std::optional<uint32_t> attribute(const char* attribute_name) {
        if (!attributes_.Has(attribute_name)) return std::nullopt;
        const auto accessor = static_cast<uint32_t>(attributes_.Get(attribute_name).GetNumberAsInt());
        const uint64_t count = layout_.accessors[accessor].count;
        if (count_ != 0 && count != count_) {
            context_.fail(
                where_ + "/" + attribute_name,
                "has " + std::to_string(count) + " elements, but another attribute has " + std::to_string(count_));
        }
        count_ = count;
        return accessor;
    }

    void apply_rotation(const std::vector<Vec4>& quaternions, std::vector<Mat4>& out) {
        bool has_zero = false;
        for (size_t i = 0; i < out.size(); ++i) {
            const glm::dvec4 q(quaternions[i]);  // x y z w
            const double length = glm::length(q);
            if (length > 1e-12) {
                out[i] = Mat4(glm::mat4_cast(glm::dquat(q.w / length, q.x / length, q.y / length, q.z / length)));
            } else {
                has_zero = true;
            }
        }
        if (has_zero) context_.warn(where_ + "/ROTATION", "holds zero quaternions; no rotation is used there");
        context_.release(quaternions.size() * sizeof(Vec4));
    }

    LoadContext& context_;
    const Layout& layout_;
    AccessorReader& accessors_;
    const tinygltf::Value& attributes_;
    std::string where_;
    uint64_t count_ = 0;
};

}  // namespace

void load_instancing(LoadContext& context, const tinygltf::Model& model, AccessorReader& accessors, Scene& scene) {
    uint64_t total = 0;
    for (size_t n = 0; n < model.nodes.size(); ++n) {
        const tinygltf::Value* extension = find_extension(model.nodes[n].extensions, name);
        if (extension == nullptr || !extension->Has("attributes")) continue;
        const std::string where = pointer_to("/nodes", n, "extensions") + "/" + name + "/attributes";
        InstancingReader reader(context, accessors.layout(), accessors, extension->Get("attributes"), where);
        std::vector<Mat4> transforms = reader.read();
        total += transforms.size();
        context.check_limit(total, context.options().max_instances, "instances", "--limit-instances", where);
        if (transforms.empty()) {
            context.warn(where, "has no TRANSLATION, ROTATION or SCALE; the mesh is placed once");
            continue;
        }
        scene.nodes[n].node_from_instance = std::make_shared<const std::vector<Mat4>>(std::move(transforms));
    }
}

}  // namespace candela
