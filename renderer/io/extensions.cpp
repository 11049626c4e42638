// SPDX-License-Identifier: MIT
#include "renderer/io/extensions.h"

#include <nlohmann/json.hpp>

namespace candela {
namespace {

using Treatment = ExtensionUse::Treatment;

struct Known {
    std::string_view name;
    Treatment treatment;
    bool harmless_when_ignored;  // may be required, and is no reason to warn: without it the picture is the same
    std::string_view how;        // of approximations and of what is ignored
};

constexpr Known known[] = {
    {"EXT_lights_image_based", Treatment::rendered, true, ""},
    {"EXT_meshopt_compression", Treatment::rendered, true, ""},
    {"EXT_texture_webp", Treatment::rendered, true, ""},
    {"KHR_lights_punctual", Treatment::rendered, true, ""},
    {"KHR_materials_emissive_strength", Treatment::rendered, true, ""},
    {"KHR_materials_ior", Treatment::rendered, true, ""},
    {"KHR_materials_specular", Treatment::rendered, true, ""},
    {"KHR_materials_unlit", Treatment::rendered, true, ""},
    {"KHR_meshopt_compression", Treatment::rendered, true, ""},
    {"KHR_mesh_quantization", Treatment::rendered, true, ""},
    {"KHR_texture_basisu", Treatment::rendered, true, ""},
    {"KHR_texture_transform", Treatment::rendered, true, ""},
    {"KHR_animation_pointer", Treatment::rendered, true, ""},
    {"KHR_draco_mesh_compression", Treatment::rendered, true, ""},
    {"KHR_materials_anisotropy", Treatment::rendered, true, ""},
    {"KHR_materials_clearcoat", Treatment::rendered, true, ""},
    {"KHR_materials_diffuse_transmission", Treatment::rendered, true, ""},
    {"KHR_materials_dispersion", Treatment::rendered, true, ""},
    {"KHR_materials_iridescence", Treatment::approximated, true,
     "interference is computed for the view's angle to the surface, not to each facet"},
    {"KHR_materials_pbrSpecularGlossiness", Treatment::rendered, true, ""},
    {"KHR_materials_sheen", Treatment::rendered, true, ""},
    {"KHR_materials_transmission", Treatment::rendered, true, ""},
    {"KHR_materials_variants", Treatment::rendered, true, ""},
    {"KHR_materials_volume", Treatment::rendered, true, ""},
    {"KHR_node_visibility", Treatment::rendered, true, ""},
    {"EXT_mesh_gpu_instancing", Treatment::rendered, true, ""},
    {"EXT_instance_features", Treatment::ignored, true, "identities for applications; nothing to see"},
    {"EXT_mesh_features", Treatment::ignored, true, "identities for applications; nothing to see"},
    {"EXT_mesh_manifold", Treatment::ignored, true, "says that meshes are closed; nothing to see"},
    {"EXT_structural_metadata", Treatment::ignored, true, "data for applications; nothing to see"},
    {"KHR_node_hoverability", Treatment::ignored, true, "interaction; nothing to see"},
    {"KHR_node_selectability", Treatment::ignored, true, "interaction; nothing to see"},
    {"KHR_xmp", Treatment::ignored, true, "metadata: candela info shows it"},
    {"KHR_xmp_json_ld", Treatment::ignored, true, "metadata: candela info shows it"},
};

const Known* find_known(std::string_view name) {
    for (const Known& candidate : known) {
        if (candidate.name == name) return &candidate;
    }
    return nullptr;
}

std::vector<std::string> names_in(const Json& document, const char* list) {
    const auto found = document.find(list);
    return found == document.end() ? std::vector<std::string>{} : found->get<std::vector<std::string>>();
}

}  // namespace

std::vector<ExtensionUse> treat_extensions(LoadContext& context, const Json& document) {
    std::vector<ExtensionUse> uses;
    const auto use_of = [&](const std::string& name) -> ExtensionUse* {
        const auto found =
            std::find_if(uses.begin(), uses.end(), [&](const ExtensionUse& u) { return u.name == name; });
        return found == uses.end() ? nullptr : &*found;
    };
    const auto add = [&](const std::string& name) -> ExtensionUse& {
        const Known* entry = find_known(name);
        ExtensionUse use{name, false, Treatment::ignored, "unknown to candela"};
        if (entry != nullptr) {
            use.treatment = entry->treatment;
            use.how = entry->how;
        }
        return uses.emplace_back(std::move(use));
    };

    const std::vector<std::string> required = names_in(document, "extensionsRequired");
    for (size_t i = 0; i < required.size(); ++i) {
        if (use_of(required[i]) != nullptr) continue;
        ExtensionUse& use = add(required[i]);
        use.required = true;
        const Known* entry = find_known(use.name);
        if (entry != nullptr && entry->harmless_when_ignored) continue;
        if (context.options().list_refused) {
            use.treatment = Treatment::refused;
            use.how = "required, but not supported";
        } else {
            context.fail(pointer_to("/extensionsRequired", i),
                         "the required extension " + use.name + " is not supported; export the scene without it");
        }
    }
    const std::vector<std::string> used = names_in(document, "extensionsUsed");
    for (size_t i = 0; i < used.size(); ++i) {
        const bool listed = use_of(used[i]) != nullptr;
        const ExtensionUse& use = listed ? *use_of(used[i]) : add(used[i]);
        const Known* entry = find_known(use.name);
        if (use.treatment == Treatment::ignored && entry != nullptr && entry->harmless_when_ignored) continue;
        if (use.treatment == Treatment::ignored) {
            context.warn(pointer_to("/extensionsUsed", i), use.name + " is ignored: " + use.how);
        } else if (use.treatment == Treatment::approximated) {
            context.warn(pointer_to("/extensionsUsed", i), use.name + " is approximated: " + use.how);
        }
    }
    return uses;
}

}  // namespace candela
