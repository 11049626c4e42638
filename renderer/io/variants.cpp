// SPDX-License-Identifier: MIT
#include "renderer/io/variants.h"

#include <nlohmann/json.hpp>

#include "renderer/io/tinygltf.h"

namespace candela {
namespace {

constexpr const char* name = "KHR_materials_variants";

}  // namespace

void load_variants(LoadContext& context, const Json& document, Scene& scene) {
    const auto extensions = document.find("extensions");
    if (extensions != document.end()) {
        const auto extension = extensions->find(name);
        if (extension != extensions->end()) {
            for (const Json& variant : (*extension)["variants"])
                scene.variant_names.push_back(variant["name"].get<std::string>());
        }
    }
    const std::string& wanted = context.options().variant;
    if (wanted.empty()) return;
    const auto found = std::find(scene.variant_names.begin(), scene.variant_names.end(), wanted);
    if (found != scene.variant_names.end()) {
        scene.active_variant = static_cast<uint32_t>(found - scene.variant_names.begin());
        return;
    }
    std::string known;
    for (const std::string& each : scene.variant_names)
        known += (known.empty() ? "\"" : ", \"") + each + "\"";
    context.fail_choice("/extensions/KHR_materials_variants",
                        "the variant \"" + wanted + "\" was asked for, but the file " +
                            (known.empty() ? "has no variants" : "has only " + known));
}

void read_variant_mappings(LoadContext& context, const tinygltf::Primitive& primitive, const std::string& where,
                           std::vector<VariantMaterial>& out) {
    const tinygltf::Value* extension = find_extension(primitive.extensions, name);
    if (extension == nullptr || !extension->Has("mappings")) return;
    const tinygltf::Value& mappings = extension->Get("mappings");
    for (size_t m = 0; m < mappings.ArrayLen(); ++m) {
        const tinygltf::Value& mapping = mappings.Get(static_cast<int>(m));
        const MaterialId material{static_cast<uint32_t>(mapping.Get("material").GetNumberAsInt())};
        const tinygltf::Value& variants = mapping.Get("variants");
        for (size_t v = 0; v < variants.ArrayLen(); ++v) {
            const auto variant = static_cast<uint32_t>(variants.Get(static_cast<int>(v)).GetNumberAsInt());
            const bool repeated = std::any_of(out.begin(), out.end(),
                                              [&](const VariantMaterial& each) { return each.variant == variant; });
            if (repeated) {
                context.warn(where + "/extensions/" + name,
                             "maps variant " + std::to_string(variant) + " twice; the first mapping is used");
            } else {
                out.push_back({variant, material});
            }
        }
    }
}

}  // namespace candela
