// SPDX-License-Identifier: MIT
// What the scene is made of: its tree, and the materials and lights that can be edited.
#include <fmt/format.h>
#include <imgui.h>

#include "app/viewer/panels.h"

namespace candela {

namespace {

std::string name_or(const std::string& name, const char* kind, uint32_t index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

// A slider whose edits begin where its dragging does.
class Editor {
  public:
    explicit Editor(bool continues) : continues_(continues) {}

    void slider(const char* label, float& value, float low, float high, const char* format = "%.2f",
                ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp) {
        changed_ |= ImGui::SliderFloat(label, &value, low, high, format, flags);
    }
    void color(const char* label, float* value, ImGuiColorEditFlags flags = 0) {
        changed_ |= ImGui::ColorEdit3(label, value, ImGuiColorEditFlags_Float | flags);
    }
    void check(const char* label, bool& value) { changed_ |= ImGui::Checkbox(label, &value); }
    bool changed() const { return changed_; }
    bool begins() const { return changed_ && !continues_; }

  private:
    bool continues_, changed_ = false;
};

void edit_material(Material& material, Editor& editor) {
    editor.color("base colour", &material.base_color_factor.x);
    editor.slider("metallic", material.metallic_factor, 0, 1);
    editor.slider("roughness", material.roughness_factor, 0, 1);
    editor.slider("ior", material.ior, 1, 3);
    editor.slider("transmission", material.transmission.factor, 0, 1);
    editor.slider("clearcoat", material.clearcoat.factor, 0, 1);
    editor.color("emission", &material.emissive_factor.x);
    editor.slider("strength", material.emissive_strength, 0, 1000, "%.2f", ImGuiSliderFlags_Logarithmic);
    editor.check("both faces emit", material.double_sided);
}

void edit_light(PunctualLight& light, Editor& editor) {
    editor.color("colour", &light.color.x);
    editor.slider("intensity", light.intensity, 0, 1e5f, "%.3g", ImGuiSliderFlags_Logarithmic);
}

// A click chooses what the node is made of, or its light, for editing.
void draw_node(const Scene& scene, uint32_t index, ViewerModel& model) {
    const Node& node = scene.nodes[index];
    const bool leaf = node.children.empty();
    ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_SpanAvailWidth;
    if (leaf) flags |= ImGuiTreeNodeFlags_Leaf;
    std::string words = name_or(node.name, "node", index);
    if (node.light.valid()) words += "  light";
    if (node.camera.valid()) words += "  camera";
    if (node.mesh.valid()) {
        const Mesh& mesh = scene.mesh(node.mesh);
        if (!mesh.primitives.empty()) {
            const MaterialId material = material_of(scene, mesh.primitives.front());
            if (material.valid())
                words += "  (" + name_or(scene.materials[material.value].name, "material", material.value) + ")";
        }
    }
    ImGui::PushID(static_cast<int>(index));
    const bool open = ImGui::TreeNodeEx("node", flags, "%s", words.c_str());
    if (ImGui::IsItemClicked()) {
        if (node.light.valid()) model.edited_light = node.light.value;
        if (node.mesh.valid() && !scene.mesh(node.mesh).primitives.empty()) {
            const MaterialId material = material_of(scene, scene.mesh(node.mesh).primitives.front());
            if (material.valid()) model.edited_material = material.value;
        }
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
    const Editable before{model.materials, model.punctual_lights, model.view};
    Editor editor(model.edit_continues);
    // What was clicked at is at hand.
    if (model.inspection) ImGui::SetNextItemOpen(true, ImGuiCond_Once);
    if (!model.materials.empty() && ImGui::CollapsingHeader("Material")) {
        model.edited_material = std::min(model.edited_material, static_cast<uint32_t>(model.materials.size() - 1));
        const auto title = [&](uint32_t i) { return name_or(model.materials[i].name, "material", i); };
        if (ImGui::BeginCombo("material", title(model.edited_material).c_str())) {
            for (uint32_t i = 0; i < model.materials.size(); ++i) {
                ImGui::PushID(static_cast<int>(i));
                if (ImGui::Selectable(title(i).c_str())) model.edited_material = i;
                ImGui::PopID();
            }
            ImGui::EndCombo();
        }
        edit_material(model.materials[model.edited_material], editor);
    }
    if (!model.punctual_lights.empty() && ImGui::CollapsingHeader("Light")) {
        model.edited_light = std::min(model.edited_light, static_cast<uint32_t>(model.punctual_lights.size() - 1));
        const auto title = [&](uint32_t i) { return name_or(model.punctual_lights[i].name, "light", i); };
        if (ImGui::BeginCombo("light", title(model.edited_light).c_str())) {
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
    if (editor.begins()) edits.before_edit = before;
    const Scene& scene = *model.job.world->scene;
    if (!scene.roots.empty() && ImGui::CollapsingHeader("Scene tree")) {
        for (const NodeId root : scene.roots)
            draw_node(scene, root.value, model);
    }
}

}  // namespace candela
