// SPDX-License-Identifier: MIT
// Bookmarks and the views that were left.
#include <fmt/format.h>
#include <imgui.h>

#include "app/viewer/panels.h"

namespace candela {

void views_section(ViewerModel& model, PanelEdits& edits) {
    if (!ImGui::CollapsingHeader("Views", ImGuiTreeNodeFlags_DefaultOpen)) return;
    const float unit = ImGui::GetFontSize(), gap = 0.25f * unit;
    const float width = (ImGui::GetContentRegionAvail().x - 9 * gap) / 10;

    // One button for each digit: in the accent where a view is stored.
    for (size_t i = 0; i < model.bookmarks.size(); ++i) {
        const size_t digit = (i + 1) % 10;
        const bool stored = model.bookmarks[digit].has_value();
        if (i > 0) ImGui::SameLine(0, gap);
        ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0, 0.25f * unit));
        ImGui::PushStyleColor(ImGuiCol_Text,
                              ImGui::GetStyleColorVec4(stored ? ImGuiCol_CheckMark : ImGuiCol_TextDisabled));
        ImGui::PushID(static_cast<int>(digit));
        if (ImGui::Button(fmt::format("{}", digit).c_str(), ImVec2(width, 0))) {
            (stored && !ImGui::GetIO().KeyCtrl ? edits.recall_bookmark : edits.store_bookmark) = digit;
        }
        if (ImGui::IsItemHovered()) {
            ImGui::SetTooltip("%s", stored ? fmt::format("Shift+{0} comes back, Ctrl+{0} stores anew", digit).c_str()
                                           : fmt::format("Ctrl+{0} stores the view", digit).c_str());
        }
        ImGui::PopID();
        ImGui::PopStyleColor();
        ImGui::PopStyleVar();
    }
    if (ImGui::Button("Back")) edits.step_view = -1;
    ImGui::SameLine();
    if (ImGui::Button("On")) edits.step_view = 1;
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", fmt::format("{} kept, {} of {} MiB", model.status.kept_views,
                                          model.status.kept_bytes >> 20, model.options.limit_views_bytes >> 20)
                                  .c_str());
    edits.copy_view = ImGui::Button("Copy as text (Ctrl+C)");
}

}  // namespace candela
