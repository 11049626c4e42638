// SPDX-License-Identifier: MIT
// What is opened, and how the panels themselves look.
#include <fmt/format.h>
#include <imgui.h>

#include "app/viewer/panels.h"

namespace candela {

void open_section(const ViewerModel& model, PanelEdits& edits) {
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    edits.open_dialog = ImGui::Button("Open (Ctrl+O)", {width, 0});
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width);
    if (!ImGui::BeginCombo("##recent", "recent")) return;
    if (model.recent.empty()) ImGui::TextDisabled("nothing was open before");
    for (const std::string& scene : model.recent) {
        ImGui::PushID(scene.c_str());
        if (ImGui::Selectable(file_name(scene).c_str(), scene == model.job.scene_path)) edits.open_recent = scene;
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", scene.c_str());
        ImGui::PopID();
    }
    ImGui::EndCombo();
}

void window_section(ViewerModel& model, PanelEdits& edits) {
    if (!ImGui::CollapsingHeader("Window")) return;
    constexpr const char* themes[] = {"dark", "light"};
    int theme = static_cast<int>(model.style.theme);
    if (ImGui::Combo("theme", &theme, themes, 2)) {
        model.style.theme = static_cast<Theme>(theme);
        edits.style = true;
    }
    if (!ImGui::BeginCombo("size", fmt::format("{:.0f} %", 100 * model.style.scale).c_str())) return;
    for (const float scale : ui_scales) {
        if (ImGui::Selectable(fmt::format("{:.0f} %", 100 * scale).c_str(), scale == model.style.scale)) {
            model.style.scale = scale;
            edits.style = true;
        }
    }
    ImGui::EndCombo();
}

}  // namespace candela
