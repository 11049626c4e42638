// SPDX-License-Identifier: MIT
// Lights made brighter, dimmer or of another colour without tracing anything anew.
#include <fmt/format.h>
#include <imgui.h>

#include "app/viewer/panels.h"

namespace candela {

void lights_section(const ViewerModel& model, PanelEdits& edits) {
    const LightMixer& lights = model.lights;
    if (!ImGui::CollapsingHeader("Lights", lights.on ? ImGuiTreeNodeFlags_DefaultOpen : 0)) return;
    if (!lights.on) {
        edits.light_groups = true;
        return;
    }
    if (lights.groups == nullptr) return;
    std::vector<LightWeight> weights = lights.weights;
    bool changed = false;
    for (size_t i = 0; i < weights.size(); ++i) {
        LightWeight& weight = weights[i];
        ImGui::PushID(static_cast<int>(i));
        changed |=
            ImGui::ColorEdit3("##colour", &weight.color.x, ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_Float);
        ImGui::SameLine();
        ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - ImGui::GetStyle().ItemSpacing.x);
        changed |= ImGui::SliderFloat(lights.groups->names[i].c_str(), &weight.intensity, 0, 10,
                                      weight.intensity == 1 ? "as it is" : "× %.3g", ImGuiSliderFlags_Logarithmic);
        ImGui::PopID();
    }
    if (ImGui::Button("As they are")) {
        weights.assign(weights.size(), {});
        changed = true;
    }
    if (changed) edits.light_weights = std::move(weights);
    ImGui::PushTextWrapPos(0);
    ImGui::TextDisabled("Nothing is traced anew. The stated error is that of the lights as they are.");
    ImGui::PopTextWrapPos();
}

}  // namespace candela
