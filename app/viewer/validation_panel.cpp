// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <imgui.h>

#include "app/viewer/panels.h"

namespace candela {

namespace {

PanelArea draw_table(const std::vector<ValidationReading>& readings) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float unit = ImGui::GetFontSize();
    // Above the status line, where nothing else opens.
    ImGui::SetNextWindowPos({unit, display.y - 3 * unit}, ImGuiCond_Always, {0, 1});
    bound_next_window();
    ImGui::Begin("validation", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
    ImGui::Text("%s: %s", readings.front().of->group.c_str(), readings.front().of->formula.c_str());
    if (ImGui::BeginTable("readings", 4, ImGuiTableFlags_SizingFixedFit)) {
        for (const char* name : {"", "exact", "picture", "difference"})
            ImGui::TableSetupColumn(name);
        ImGui::TableHeadersRow();
        for (const ValidationReading& r : readings) {
            const auto cell = [](const std::string& text) {
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(text.c_str());
            };
            cell(r.of->name);
            cell(fmt::format("{:>9.6g}", r.of->exact));
            cell(r.shown ? fmt::format("{:>9.6g}", *r.shown) : r.visible ? "..." : "out of view");
            cell(r.shown && r.of->exact > 0 ? fmt::format("{:+8.2f} %", 100 * (*r.shown / r.of->exact - 1)) : "");
        }
        ImGui::EndTable();
    }
    const PanelArea now = current_panel_area();
    ImGui::End();
    return now;
}

}  // namespace

PanelArea draw_validation(const ViewerModel& model, const std::vector<ValidationReading>& readings) {
    if (readings.empty()) return {};
    const PanelArea table = has_room_beside_panels(model) ? draw_table(readings) : PanelArea{};
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float unit = ImGui::GetFontSize();
    // A ring around each point, in dark and light so that it shows on any ground.
    ImDrawList* draw = ImGui::GetBackgroundDrawList();
    for (const ValidationReading& r : readings) {
        if (!r.visible) continue;
        const ImVec2 at(r.film_uv.x * display.x, r.film_uv.y * display.y);
        draw->AddCircle(at, 0.5f * unit, IM_COL32(0, 0, 0, 200), 0, 3.0f * line_scale());
        draw->AddCircle(at, 0.5f * unit, IM_COL32(255, 255, 255, 255), 0, 1.2f * line_scale());
        draw->AddText({at.x + 0.7f * unit, at.y - 1.4f * unit}, IM_COL32(0, 0, 0, 255), r.of->name.c_str());
        draw->AddText({at.x + 0.7f * unit - 1, at.y - 1.4f * unit - 1}, IM_COL32(255, 255, 255, 255),
                      r.of->name.c_str());
    }
    return table;
}

}  // namespace candela
