// SPDX-License-Identifier: MIT
#include "app/viewer/fields.h"

#include <imgui.h>

#include <algorithm>
#include <limits>
#include <string_view>

namespace candela {

namespace {

constexpr const char* ellipsis = "\u2026";

// Where a letter of UTF-8 begins.
bool begins_letter(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0u) != 0x80u;
}

}  // namespace

std::string shortened(const std::string& text, float width, const std::function<float(const std::string&)>& width_of) {
    if (width_of(text) <= width) return text;
    for (size_t length = text.size(); length > 0;) {
        do {
            --length;
        } while (length > 0 && !begins_letter(text[length]));
        std::string out = text.substr(0, length) + ellipsis;
        if (width_of(out) <= width) return out;
    }
    return "";
}

bool begin_combo(const char* label, const std::string& preview) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float room = ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - 2 * style.FramePadding.x;
    const std::string seen =
        shortened(preview, room, [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; });
    const bool open = ImGui::BeginCombo(label, seen.c_str());
    if (!open && seen != preview && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", preview.c_str());
    return open;
}

bool color_field(const char* label, Vec3& color, float most) {
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = std::floor((ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - 3 * gap) / 3);
    const float last_width = ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - 3 * gap - 2 * width;
    const float limit = most > 0 ? most : std::numeric_limits<float>::max();
    bool changed = false;
    ImGui::BeginGroup();
    ImGui::PushID(label);
    for (int i = 0; i < 3; ++i) {
        ImGui::PushID(i);
        ImGui::SetNextItemWidth(i < 2 ? width : last_width);
        changed |= ImGui::DragFloat("##value", &color[i], 1.0f / 255, 0, limit, "%.2f", ImGuiSliderFlags_AlwaysClamp);
        ImGui::SameLine(0, gap);
        ImGui::PopID();
    }
    changed |= ImGui::ColorEdit3("##square", &color.x,
                                 ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs |
                                     (most > 0 ? 0 : static_cast<ImGuiColorEditFlags>(ImGuiColorEditFlags_HDR)));
    ImGui::PopID();
    ImGui::SameLine(0, gap);
    // What is behind ## only tells fields of one name apart.
    const std::string_view words(label);
    ImGui::TextUnformatted(label, label + std::min(words.find("##"), words.size()));
    ImGui::EndGroup();
    return changed;
}

}  // namespace candela
