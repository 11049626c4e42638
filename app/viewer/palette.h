// SPDX-License-Identifier: MIT
// The colours of each theme: one accent, one alarm, and greys. What is drawn over the picture itself does not change
// with the theme.
#pragma once

#include <imgui.h>

#include "app/viewer/theme.h"

namespace candela {

struct Palette {
    ImVec4 accent;              // the one colour that says: here, now, chosen
    ImVec4 alarm;               // failed, biased, not to be trusted
    ImVec4 text, dim;           // dim: labels, and what is not so important
    ImVec4 panel, field;        // the ground of windows, and of what can be edited on it
    ImVec4 field_active, grab;  // grab: of sliders, whose number is read on it
    ImVec4 grid, faint_grid;    // of plots
    ImVec4 second, bound;       // other curves of a plot
};

const Palette& palette_of(Theme theme);

inline ImU32 packed(const ImVec4& color) {
    return ImGui::ColorConvertFloat4ToU32(color);
}

// Colours of ImGui's widgets, and sizes on a grid of four points, in pixels of the interface's scale.
void apply_theme(Theme theme, float scale);

}  // namespace candela
