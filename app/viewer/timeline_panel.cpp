// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <imgui.h>

#include "app/pose_choice.h"
#include "app/viewer/panels.h"

namespace candela {

bool timeline_is_shown(const ViewerModel& model) {
    if (!model.has_scene() || model.job.rest->animations.empty()) return false;
    return model.show_panels || model.playback.animation.has_value();
}

void draw_timeline(const ViewerModel& model, PanelEdits& edits) {
    const Scene& rest = *model.job.rest;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float unit = ImGui::GetFontSize();
    // Above the status line, beside the side panel where there is room.
    const float beside = display.x - (model.show_panels ? 21 * unit : 0);
    const float room = beside > 24 * unit ? beside : display.x, width = std::min(44 * unit, room - 2 * unit);
    ImGui::SetNextWindowPos({0.5f * room, display.y - 2.4f * unit}, ImGuiCond_Always, {0.5f, 1});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::Begin("timeline", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);

    const uint32_t shown = model.playback.animation.value_or(0);
    edits.toggle_play = ImGui::Button(model.playback.playing ? "Stop" : "Play", {4 * unit, 0});
    ImGui::SameLine();
    const std::string name = animation_title(rest, shown);
    if (rest.animations.size() > 1) {
        ImGui::SetNextItemWidth(0.3f * width);
        if (ImGui::BeginCombo("##animation", name.c_str())) {
            for (uint32_t i = 0; i < rest.animations.size(); ++i) {
                ImGui::PushID(static_cast<int>(i));
                if (ImGui::Selectable(animation_title(rest, i).c_str(), i == shown)) edits.animation = i;
                ImGui::PopID();
            }
            ImGui::EndCombo();
        }
    } else {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(name.c_str());
    }

    // The slider takes what is left.
    ImGui::SameLine();
    const float duration_s = rest.animations[shown]->duration_s;
    auto time_s = static_cast<float>(model.playback.time_s);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##time", &time_s, 0, duration_s, fmt::format("%.2f s of {:.2f} s", duration_s).c_str(),
                           ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput))
        edits.seek_s = static_cast<double>(time_s);
    ImGui::End();
}

}  // namespace candela
