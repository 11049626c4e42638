// SPDX-License-Identifier: MIT
// All keys, and what the mouse does.
#include <imgui.h>

#include "app/viewer/panels.h"

namespace candela {

namespace {

constexpr const char* rows[][2] = {{"orbit", "left drag, Alt+left drag"},
                                   {"pan", "middle drag, Shift+left drag"},
                                   {"nearer, farther", "wheel towards the cursor, right drag"},
                                   {"re-centre", "double-click"},
                                   {"focus", "Ctrl+Shift+left click"},
                                   {"fly", "F; W A S D, Q and E, Shift, wheel"},
                                   {"look around while flying", "left drag, arrows"},
                                   {"frame all", "Home, Enter"},
                                   {"front, right, top", "1  3  7"},
                                   {"isometric, orthographic", "9  5"},
                                   {"cameras of the file", "C"},
                                   {"store, recall a view", "Ctrl+0-9, Shift+0-9"},
                                   {"view before, after", "Alt+left, Alt+right arrow"},
                                   {"copy, paste a view as text", "Ctrl+C, Ctrl+V"},
                                   {"exposure", "E, Shift+E"},
                                   {"tone curve", "T"},
                                   {"turn, hide environment", "Shift+right drag, J"},
                                   {"play, one frame back, on", "Space  [  ]"},
                                   {"error map, next map", "V, Shift+V"},
                                   {"wipe of the map", "drag its line; , and ."},
                                   {"pause rendering", "P"},
                                   {"denoised preview", "D"},
                                   {"undo, redo", "Ctrl+Z, Ctrl+Shift+Z"},
                                   {"pixel and its brightest path", "click, I: the middle; Escape"},
                                   {"compare two settings", "B"},
                                   {"reference, its measures", "hold Shift, M"},
                                   {"save picture, the denoised one", "Ctrl+S, Ctrl+Shift+S"},
                                   {"open a scene, an environment", "Ctrl+O, or drop it"},
                                   {"open a reference", "Ctrl+Shift+O, or drop it with Shift"},
                                   {"reload", "F5"},
                                   {"next, previous file", "right, left arrow"},
                                   {"statistics, panels, help", "Z  Tab  H"},
                                   {"panels by keyboard", "arrow down; Escape"},
                                   {"quit", "Ctrl+Q"}};

}  // namespace

void draw_help() {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float unit = ImGui::GetFontSize();
    const bool wide = display.x > 70 * unit;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    bound_next_window();
    // Where it is too long for the window, the wheel leads on.
    ImGui::Begin("help", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_AlwaysAutoResize);
    const size_t columns = wide ? 2 : 1, height = (std::size(rows) + columns - 1) / columns;
    // In a narrow window the keys stand below what they do.
    if (display.x < 40 * unit) {
        for (const auto& row : rows) {
            ImGui::TextDisabled("%s", row[0]);
            ImGui::Indent(unit);
            ImGui::TextUnformatted(row[1]);
            ImGui::Unindent(unit);
        }
        ImGui::End();
        return;
    }
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(0.5f * unit, 0.13f * unit));
    if (ImGui::BeginTable("keys", static_cast<int>(2 * columns), ImGuiTableFlags_SizingFixedFit)) {
        for (size_t y = 0; y < height; ++y) {
            for (size_t x = 0; x < columns; ++x) {
                const size_t i = x * height + y;
                ImGui::TableNextColumn();
                if (x > 0) ImGui::Indent(1.6f * unit);
                if (i < std::size(rows)) ImGui::TextDisabled("%s", rows[i][0]);
                if (x > 0) ImGui::Unindent(1.6f * unit);
                ImGui::TableNextColumn();
                if (i < std::size(rows)) ImGui::TextUnformatted(rows[i][1]);
            }
        }
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::End();
}

}  // namespace candela
