// SPDX-License-Identifier: MIT
// Numbered pictures: a turn around the scene, or its animation.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "app/viewer/panels.h"

namespace candela {

void sequence_section(ViewerModel& model, PanelEdits& edits) {
    if (!ImGui::CollapsingHeader("Pictures")) return;
    SequenceSettings& sequence = model.sequence;
    const bool animated = !model.job.rest->animations.empty();
    if (!animated) sequence.kind = SequenceKind::turntable;
    constexpr const char* kinds[] = {"a turn around it", "its animation"};
    int kind = static_cast<int>(sequence.kind);
    if (ImGui::Combo("of", &kind, kinds, animated ? 2 : 1)) sequence.kind = static_cast<SequenceKind>(kind);
    double duration_s = 0;
    if (sequence.kind == SequenceKind::turntable) {
        int pictures = static_cast<int>(sequence.pictures);
        if (ImGui::SliderInt("pictures", &pictures, 2, 360, "%d", ImGuiSliderFlags_AlwaysClamp))
            sequence.pictures = static_cast<uint32_t>(pictures);
    } else {
        auto fps = static_cast<float>(sequence.fps);
        if (ImGui::SliderFloat("a second", &fps, 1, 120, "%.0f", ImGuiSliderFlags_AlwaysClamp))
            sequence.fps = static_cast<double>(std::round(fps));
        duration_s = static_cast<double>(model.job.rest->animations[model.playback.animation.value_or(0)]->duration_s);
    }
    int spp = static_cast<int>(sequence.spp);
    if (ImGui::SliderInt("samples", &spp, 1, 4096, "%d", ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
        sequence.spp = static_cast<uint32_t>(spp);
    if (model.writing) {
        edits.stop_sequence = ImGui::Button("Stop");
        ImGui::SameLine();
        ImGui::ProgressBar(static_cast<float>(model.writing->first) / static_cast<float>(model.writing->second),
                           {-1, 0}, fmt::format("{} of {}", model.writing->first, model.writing->second).c_str());
    } else {
        const uint32_t count = picture_count(sequence, duration_s);
        if (ImGui::Button(fmt::format("Write {} picture{}", count, count == 1 ? "" : "s").c_str()))
            edits.write_sequence = sequence;
    }
}

}  // namespace candela
