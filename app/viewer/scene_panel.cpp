// SPDX-License-Identifier: MIT
// What the scene is made of: its tree, and the materials and lights that can be edited.
#include <fmt/format.h>
#include <imgui.h>

#include "app/viewer/fields.h"
#include "app/viewer/panels.h"

namespace candela {

namespace {

std::string name_or(const std::string& name, const char* kind, uint32_t index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

// Sliders, and whether one was moved.
class Editor {
  public:
    bool slider(const char* label, float& value, float low, float high, const char* format = "%.2f",
                ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp) {
        const bool changed = ImGui::SliderFloat(label, &value, low, high, format, flags);
        changed_ |= changed;
        return changed;
    }
    void color(const char* label, Vec3& value) { changed_ |= color_field(label, value); }
    void check(const char* label, bool& value) { changed_ |= ImGui::Checkbox(label, &value); }
    bool changed() const { return changed_; }

  private:
    bool changed_ = false;
};

// Layers whose compilation needs more than factors (tangents, bodies) only where the material has them, and these not
// down to nothing: they could not be brought back.
void edit_layers(const Material& own, Material& material, Editor& editor) {
    editor.color("sheen", material.sheen.color_factor);
    editor.slider("its roughness##sheen", material.sheen.roughness_factor, 0, 1);
    editor.slider("specular", material.specular.factor, 0, 1);
    editor.color("its colour##specular", material.specular.color_factor);
    editor.slider("iridescence", material.iridescence.factor, 0, 1);
    editor.slider("its ior", material.iridescence.ior, 1, 3);
    editor.slider("its film", material.iridescence.thickness_maximum_nm, 0, 1200, "%.0f nm");
    if (own.anisotropy.strength > 0) {
        editor.slider("anisotropy", material.anisotropy.strength, 0.01f, 1);
        float degrees = glm::degrees(material.anisotropy.rotation_radians);
        if (editor.slider("its turn", degrees, -180, 180, "%.0f°"))
            material.anisotropy.rotation_radians = glm::radians(degrees);
    }
    if (own.diffuse_transmission.factor > 0) {
        editor.slider("translucency", material.diffuse_transmission.factor, 0.01f, 1);
        editor.color("its colour##translucency", material.diffuse_transmission.color_factor);
    }
    if (own.has_volume()) {
        editor.color("inside", material.volume.attenuation_color);
        editor.slider("reached after", material.volume.attenuation_distance_m, 1e-4f, 1e3f,
                      std::isinf(material.volume.attenuation_distance_m) ? "never" : "%.3g m",
                      ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
        editor.slider("dispersion", material.volume.dispersion, 0, 2);
    }
}

void edit_material(const Material& own, Material& material, Editor& editor) {
    Vec3 base_color(material.base_color_factor);
    editor.color("base colour", base_color);
    material.base_color_factor = Vec4(base_color, material.base_color_factor.w);
    editor.slider("metallic", material.metallic_factor, 0, 1);
    editor.slider("roughness", material.roughness_factor, 0, 1);
    editor.slider("ior", material.ior, 1, 3);
    editor.slider("transmission", material.transmission.factor, 0, 1);
    editor.slider("clearcoat", material.clearcoat.factor, 0, 1);
    editor.slider("its roughness##coat", material.clearcoat.roughness_factor, 0, 1);
    editor.color("emission", material.emissive_factor);
    editor.slider("strength", material.emissive_strength, 0, 1000, "%.2f", ImGuiSliderFlags_Logarithmic);
    editor.check("both faces emit", material.double_sided);
    if (ImGui::TreeNodeEx("more layers", ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_SpanAvailWidth |
                                             ImGuiTreeNodeFlags_FramePadding))
        edit_layers(own, material, editor);
}

void edit_light(PunctualLight& light, Editor& editor) {
    editor.color("colour", light.color);
    editor.slider("intensity", light.intensity, 0, 1e5f, "%.3g", ImGuiSliderFlags_Logarithmic);
}

// A name and, dimmed behind it, what it is; both shortened where the panel is too narrow. Whether its children show.
bool draw_row(const std::string& name, const std::string& what, ImGuiTreeNodeFlags flags) {
    const auto width_of = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
    const float indent = ImGui::GetTreeNodeToLabelSpacing(), gap = ImGui::GetStyle().ItemSpacing.x;
    const float room = ImGui::GetContentRegionAvail().x - indent;
    const std::string seen = shortened(name, room, width_of);
    const std::string seen_what = shortened(what, room - width_of(seen) - gap, width_of);
    const bool open = ImGui::TreeNodeEx("node", flags, "%s", seen.c_str());
    const ImVec2 low = ImGui::GetItemRectMin();
    ImGui::GetWindowDrawList()->AddText({low.x + indent + width_of(seen) + gap, low.y},
                                        ImGui::GetColorU32(ImGuiCol_TextDisabled), seen_what.c_str());
    if ((seen != name || seen_what != what) && ImGui::IsItemHovered())
        ImGui::SetTooltip("%s  %s", name.c_str(), what.c_str());
    return open;
}

// A click chooses what the node is made of, or its light, for editing.
void draw_node(const Scene& scene, uint32_t index, ViewerModel& model) {
    const Node& node = scene.nodes[index];
    const bool leaf = node.children.empty();
    ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_SpanAvailWidth;
    if (leaf) flags |= ImGuiTreeNodeFlags_Leaf;
    std::string what;
    if (node.light.valid()) what = "light";
    if (node.camera.valid()) what = "camera";
    MaterialId material;
    if (node.mesh.valid() && !scene.mesh(node.mesh).primitives.empty())
        material = material_of(scene, scene.mesh(node.mesh).primitives.front());
    if (material.valid()) what = name_or(scene.materials[material.value].name, "material", material.value);
    ImGui::PushID(static_cast<int>(index));
    const bool open = draw_row(name_or(node.name, "node", index), what, flags);
    if (ImGui::IsItemClicked()) {
        if (node.light.valid()) model.edited_light = node.light.value;
        if (material.valid()) model.edited_material = material.value;
    }
    if (open) {
        for (const NodeId child : node.children)
            draw_node(scene, child.value, model);
        ImGui::TreePop();
    }
    ImGui::PopID();
}

}  // namespace

void edit_section(ViewerModel& model, PanelEdits& edits) {
    Editor editor;
    // What was clicked at is at hand.
    if (model.inspection) ImGui::SetNextItemOpen(true, ImGuiCond_Once);
    if (!model.materials.empty() && ImGui::CollapsingHeader("Material")) {
        model.edited_material = std::min(model.edited_material, static_cast<uint32_t>(model.materials.size() - 1));
        const auto title = [&](uint32_t i) { return name_or(model.materials[i].name, "material", i); };
        if (begin_combo("material", title(model.edited_material))) {
            for (uint32_t i = 0; i < model.materials.size(); ++i) {
                ImGui::PushID(static_cast<int>(i));
                if (ImGui::Selectable(title(i).c_str())) model.edited_material = i;
                ImGui::PopID();
            }
            ImGui::EndCombo();
        }
        const std::vector<Material>& own = model.job.world->scene->materials;
        if (model.edited_material < own.size())
            edit_material(own[model.edited_material], model.materials[model.edited_material], editor);
    }
    if (!model.punctual_lights.empty() && ImGui::CollapsingHeader("Light")) {
        model.edited_light = std::min(model.edited_light, static_cast<uint32_t>(model.punctual_lights.size() - 1));
        const auto title = [&](uint32_t i) { return name_or(model.punctual_lights[i].name, "light", i); };
        if (begin_combo("light", title(model.edited_light))) {
            for (uint32_t i = 0; i < model.punctual_lights.size(); ++i) {
                ImGui::PushID(static_cast<int>(i));
                if (ImGui::Selectable(title(i).c_str())) model.edited_light = i;
                ImGui::PopID();
            }
            ImGui::EndCombo();
        }
        edit_light(model.punctual_lights[model.edited_light], editor);
    }
    edits.scene_edited = editor.changed();
    const Scene& scene = *model.job.world->scene;
    if (!scene.roots.empty() && ImGui::CollapsingHeader("Scene tree")) {
        for (const NodeId root : scene.roots)
            draw_node(scene, root.value, model);
    }
}

}  // namespace candela
