// SPDX-License-Identifier: MIT
// What the wipe and the colours of a map mean.
#include <fmt/format.h>
#include <imgui.h>

#include "app/viewer/panels.h"

namespace candela {

namespace {

ImU32 heat_u32(float t) {
    const Vec3 color = heat_color(t);
    return ImGui::ColorConvertFloat4ToU32({color.x, color.y, color.z, 1});
}

ImU32 difference_u32(float t) {
    const Vec3 color = difference_color(t);
    return ImGui::ColorConvertFloat4ToU32({color.x, color.y, color.z, 1});
}

// A word on a panel's ground beside the line.
void label(ImDrawList* draw, const char* words, float x, float y, float pivot) {
    const float unit = ImGui::GetFontSize();
    const ImVec2 size = ImGui::CalcTextSize(words);
    const ImVec2 at(x - pivot * size.x, y);
    draw->AddRectFilled({at.x - 0.4f * unit, at.y - 0.2f * unit}, {at.x + size.x + 0.4f * unit, at.y + 1.2f * unit},
                        ImGui::GetColorU32(ImGuiCol_WindowBg), 0.25f * unit);
    draw->AddText(at, ImGui::GetColorU32(ImGuiCol_Text), words);
}

// "light points, ±1.2 %"
std::string side_words(const std::string& settings, const FilmStatistics& film) {
    return std::isfinite(film.relative_error) ? settings + ", ±" + percent_text(film.relative_error) : settings;
}

// The bar's marks: decades, or quarters of a linear scale.
std::vector<float> marks_of(const HeatScale& scale) {
    std::vector<float> out;
    if (!scale.logarithmic) {
        for (int i = 0; i <= 4; ++i)
            out.push_back(scale.low + (scale.high - scale.low) * static_cast<float>(i) / 4);
        return out;
    }
    for (float mark = scale.low; mark < 1.5f * scale.high; mark *= 10)
        out.push_back(mark);
    return out;
}

}  // namespace

std::optional<float> wipe_x(const ViewerModel& model) {
    if (!model.map.shown && !model.comparison.shown) return std::nullopt;
    if (!model.has_scene() || model.frame_extent.x == 0 || (model.reference && model.reference->held))
        return std::nullopt;
    return model.picture_left + model.map.wipe * model.picture_width;
}

void draw_badge(const ViewerModel& model) {
    const bool reference = model.reference && model.reference->held;
    if ((!model.denoised_spp && !reference) || !model.has_scene()) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float unit = ImGui::GetFontSize();
    const std::string words =
        reference ? "the reference: " + file_name(model.reference->path)
                  : fmt::format("denoised, of {} sample{}", *model.denoised_spp, *model.denoised_spp == 1 ? "" : "s");
    label(ImGui::GetBackgroundDrawList(), words.c_str(), display.x - unit, display.y - 4.0f * unit, 1);
}

void draw_wipe(const ViewerModel& model) {
    const std::optional<float> line = wipe_x(model);
    if (!line) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float unit = ImGui::GetFontSize(), bottom = display.y - 1.8f * unit;
    const float x = std::round(*line);
    ImDrawList* draw = ImGui::GetBackgroundDrawList();
    draw->AddLine({x, 0}, {x, bottom}, IM_COL32(0, 0, 0, 160), 3 * line_scale());
    draw->AddLine({x, 0}, {x, bottom}, IM_COL32(255, 255, 255, 255), std::max(std::round(line_scale()), 1.0f));

    // The handle: two triangles that point both ways.
    const float y = 0.5f * bottom, r = 0.45f * unit;
    draw->AddRectFilled({x - 1.6f * r, y - 1.4f * r}, {x + 1.6f * r, y + 1.4f * r},
                        ImGui::GetColorU32(ImGuiCol_WindowBg), 0.5f * r);
    for (const float side : {-1.0f, 1.0f}) {
        draw->AddTriangleFilled({x + side * 1.2f * r, y}, {x + side * 0.35f * r, y - 0.8f * r},
                                {x + side * 0.35f * r, y + 0.8f * r}, ImGui::GetColorU32(ImGuiCol_Text));
    }

    // What is on either side, where there is room for it; in a tiny window the legend alone says it.
    if (model.map.shown && is_tiny()) return;
    const float left = model.picture_left, right = left + model.picture_width;
    const IntegratorSettings& settings = model.job.request.settings;
    const IntegratorSettings other = model.comparison.settings.in(settings);
    std::string picture = model.denoised_spp ? "denoised" : "picture", title = title_of(model.map);
    if (model.comparison.shown) {
        picture = side_words(words_of(settings, other), model.film);
        title = side_words(words_of(other, settings), model.comparison.film);
    }
    // Above the legend, where that stands below them.
    const auto top = [&](float from) {
        const bool over_legend = model.map.shown && from < std::min(20 * unit, display.x - 4 * unit) + 3.6f * unit;
        return bottom - (over_legend ? 8.2f : 2.2f) * unit;
    };
    const float picture_width = ImGui::CalcTextSize(picture.c_str()).x,
                title_width = ImGui::CalcTextSize(title.c_str()).x;
    if (x - left > picture_width + 2 * unit)
        label(draw, picture.c_str(), x - unit, top(x - picture_width - 1.4f * unit), 1);
    if (right - x > title_width + 2 * unit) label(draw, title.c_str(), x + unit, top(x + 0.6f * unit), 0);
}

PanelArea draw_legend(const ViewerModel& model, bool beside_readings) {
    if (!model.map.shown || !model.has_scene() || !has_room_beside_panels(model)) return {};
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float unit = ImGui::GetFontSize();
    if (model.reference && model.reference->held) return {};
    const std::optional<ReferenceMetric> metric = model.map.metric;
    const bool is_difference = metric == ReferenceMetric::signed_difference;
    const bool is_error = metric ? is_difference : model.map.map == PixelMap::error;
    const HeatScale& scale = model.map_scale;
    // At the left above the status line; where readings stand there, in the middle above the timeline.
    const float foot = beside_readings && timeline_is_shown(model) ? 5.4f * unit : 2.4f * unit;
    ImGui::SetNextWindowPos({beside_readings ? 0.5f * display.x : unit, display.y - foot}, ImGuiCond_Always,
                            {beside_readings ? 0.5f : 0.0f, 1});
    ImGui::Begin("legend", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoInputs);
    ImGui::TextUnformatted(title_of(model.map));
    if (metric && model.reference && model.reference->mean_samples) {
        ImGui::SameLine();
        ImGui::TextDisabled("%s", *metric == ReferenceMetric::flip
                                      ? fmt::format("mean {:.3f}", model.reference->difference.flip).c_str()
                                      : metric_words(*metric, model.reference->difference).c_str());
    } else if (!metric && is_error) {
        ImGui::SameLine();
        ImGui::TextDisabled("of its value");
    }

    // The bar, and below it numbers at their places.
    const float width = std::min(20 * unit, display.x - 4 * unit), height = 0.8f * unit, inset = 1.2f * unit;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList* draw = ImGui::GetWindowDrawList();
    constexpr int steps = 64;
    const float left = at.x + inset, span = width - 2 * inset;
    for (int i = 0; i < steps; ++i) {
        const float a = static_cast<float>(i) / steps, b = static_cast<float>(i + 1) / steps;
        const ImU32 from = is_difference ? difference_u32(2 * a - 1) : heat_u32(a);
        const ImU32 to = is_difference ? difference_u32(2 * b - 1) : heat_u32(b);
        draw->AddRectFilledMultiColor({left + a * span, at.y}, {left + b * span, at.y + height}, from, to, to, from);
    }
    draw->AddRect({left - 1, at.y - 1}, {left + span + 1, at.y + height + 1},
                  ImGui::GetColorU32(ImGuiCol_TextDisabled));
    for (const float mark : marks_of(scale)) {
        const float x = left + span * scale.position(mark);
        const std::string words =
            is_error ? fmt::format("{:.3g} %", is_difference && std::abs(mark) < 1e-4f ? 0.0f : 100 * mark)
                     : fmt::format("{:.4g}", mark);
        draw->AddLine({x, at.y + height + 1}, {x, at.y + height + 0.3f * unit},
                      ImGui::GetColorU32(ImGuiCol_TextDisabled));
        draw->AddText({x - 0.5f * ImGui::CalcTextSize(words.c_str()).x, at.y + height + 0.4f * unit},
                      ImGui::GetColorU32(ImGuiCol_Text), words.c_str());
    }
    ImGui::Dummy({width, height + 1.4f * unit});
    const PanelArea now = current_panel_area();
    ImGui::End();
    return now;
}

}  // namespace candela
