// SPDX-License-Identifier: MIT
#include "app/viewer/palette.h"

namespace candela {

namespace {

const Palette dark = {{0.91f, 0.64f, 0.24f, 1.0f},   {0.95f, 0.45f, 0.35f, 1.0f},  {0.93f, 0.93f, 0.92f, 1.0f},
                      {0.60f, 0.60f, 0.58f, 1.0f},   {0.09f, 0.09f, 0.10f, 0.94f}, {0.22f, 0.22f, 0.24f, 1.0f},
                      {0.30f, 0.30f, 0.33f, 1.0f},   {0.64f, 0.44f, 0.15f, 1.0f},  {1.00f, 1.00f, 1.00f, 0.14f},
                      {1.00f, 1.00f, 1.00f, 0.055f}, {0.43f, 0.73f, 0.92f, 1.0f},  {0.59f, 0.67f, 0.78f, 1.0f}};

// Words in the accent stand on almost white: darker, so that they are read as well (4.5 : 1).
const Palette light = {{0.60f, 0.35f, 0.00f, 1.0f},  {0.73f, 0.14f, 0.08f, 1.0f},  {0.11f, 0.11f, 0.12f, 1.0f},
                       {0.38f, 0.38f, 0.40f, 1.0f},  {0.96f, 0.96f, 0.95f, 0.96f}, {0.86f, 0.86f, 0.85f, 1.0f},
                       {0.78f, 0.78f, 0.77f, 1.0f},  {0.82f, 0.52f, 0.10f, 1.0f},  {0.00f, 0.00f, 0.00f, 0.20f},
                       {0.00f, 0.00f, 0.00f, 0.08f}, {0.05f, 0.38f, 0.62f, 1.0f},  {0.33f, 0.42f, 0.54f, 1.0f}};

}  // namespace

const Palette& palette_of(Theme theme) {
    return theme == Theme::dark ? dark : light;
}

void apply_theme(Theme theme, float scale) {
    const Palette& palette = palette_of(theme);
    ImGuiStyle style;
    if (theme == Theme::dark) {
        ImGui::StyleColorsDark(&style);
    } else {
        ImGui::StyleColorsLight(&style);
    }
    style.WindowRounding = 6;
    style.FrameRounding = 4;
    style.GrabRounding = 4;
    style.PopupRounding = 4;
    // So that panels have an edge on a picture of their own colour.
    style.WindowBorderSize = 1;
    style.WindowPadding = {12, 12};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 8};
    style.ItemInnerSpacing = {8, 4};
    style.ScrollbarSize = 12;
    ImVec4* colors = style.Colors;
    colors[ImGuiCol_WindowBg] = colors[ImGuiCol_PopupBg] = palette.panel;
    // Lists open over words, which must not be read through them.
    colors[ImGuiCol_PopupBg].w = 1;
    colors[ImGuiCol_FrameBg] = colors[ImGuiCol_Button] = colors[ImGuiCol_Header] = palette.field;
    for (const ImGuiCol each : {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered, ImGuiCol_HeaderHovered,
                                ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive, ImGuiCol_HeaderActive})
        colors[each] = palette.field_active;
    colors[ImGuiCol_TableHeaderBg] = palette.field;
    colors[ImGuiCol_SliderGrab] = colors[ImGuiCol_SliderGrabActive] = palette.grab;
    colors[ImGuiCol_CheckMark] = colors[ImGuiCol_PlotHistogram] = colors[ImGuiCol_NavHighlight] = palette.accent;
    colors[ImGuiCol_Border] = palette.grid;
    colors[ImGuiCol_Text] = palette.text;
    colors[ImGuiCol_TextDisabled] = palette.dim;
    colors[ImGuiCol_TextSelectedBg] = palette.field_active;
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

}  // namespace candela
