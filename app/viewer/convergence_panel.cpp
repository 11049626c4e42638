// SPDX-License-Identifier: MIT
// The stated error over time, both logarithmic, with the line through its last points.
#include <fmt/format.h>
#include <imgui.h>

#include "app/viewer/error_words.h"
#include "app/viewer/palette.h"
#include "app/viewer/panels.h"

namespace candela {

namespace {

// One logarithmic axis, from a value to a place on the screen.
struct Axis {
    double low = 1, high = 10;
    float from = 0, to = 1;

    float at(double value) const {
        const double t = std::log(value / low) / std::log(high / low);
        return from + static_cast<float>(t) * (to - from);
    }
    bool holds(double value) const { return value >= low * 0.999999 && value <= high * 1.000001; }
};

// Calls mark(value, labelled) for 1 … 9 times each power of ten on the axis. Labelled: the powers; where there are
// fewer than three of them also 2 and 5 times them.
template <typename Mark>
void for_marks(const Axis& axis, Mark&& mark) {
    const int first = static_cast<int>(std::floor(std::log10(axis.low)));
    const int last = static_cast<int>(std::ceil(std::log10(axis.high)));
    int powers = 0;
    for (int e = first; e <= last; ++e)
        powers += axis.holds(std::pow(10, e)) ? 1 : 0;
    for (int e = first; e <= last; ++e) {
        for (int m = 1; m <= 9; ++m) {
            const double value = m * std::pow(10, e);
            if (axis.holds(value)) mark(value, m == 1 || (powers < 3 && (m == 2 || m == 5)));
        }
    }
}

// A polyline of history points within the axes.
template <typename Value>
void draw_curve(ImDrawList* draw, const Axis& x, const Axis& y, const std::vector<ErrorPoint>& points, ImU32 color,
                Value&& value) {
    std::vector<ImVec2> line;
    for (const ErrorPoint& point : points) {
        if (x.holds(point.seconds) && value(point) > 0) line.push_back({x.at(point.seconds), y.at(value(point))});
    }
    draw->AddPolyline(line.data(), static_cast<int>(line.size()), color, 0, 1.6f * line_scale());
    if (!line.empty()) draw->AddCircleFilled(line.back(), 2.6f * line_scale(), color);
}

void draw_dashes(ImDrawList* draw, const ImVec2& a, const ImVec2& b, ImU32 color) {
    const float length = std::hypot(b.x - a.x, b.y - a.y), dash = 5 * line_scale();
    for (float t = 0; t < length; t += 2 * dash) {
        const float t0 = t / length, t1 = std::min(t + dash, length) / length;
        draw->AddLine({a.x + t0 * (b.x - a.x), a.y + t0 * (b.y - a.y)},
                      {a.x + t1 * (b.x - a.x), a.y + t1 * (b.y - a.y)}, color, 1.2f * line_scale());
    }
}

}  // namespace

void draw_convergence(const ViewerModel& model) {
    const float unit = ImGui::GetFontSize();
    const Palette& palette = palette_of(model.style.theme);
    const ImU32 mean_color = packed(palette.accent), bound_color = packed(palette.bound),
                other_color = packed(palette.second), grid_color = packed(palette.grid),
                faint_grid_color = packed(palette.faint_grid);
    const ErrorWords words = words_of(model);
    const std::vector<ErrorPoint>& points = model.history.points();
    if (words.brief.empty() || points.size() < 2) {
        ImGui::TextDisabled(words.brief.empty() ? "the error is known after some samples"
                                                : "how the error falls is known after more samples");
        return;
    }
    const float width = std::min(31 * unit, ImGui::GetIO().DisplaySize.x - 4 * unit), height = 9 * unit;
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    ImGui::TextUnformatted(words.sentence.c_str());
    if (const std::string compared = comparison_words(model); !compared.empty())
        ImGui::TextUnformatted(compared.c_str());
    ImGui::PopTextWrapPos();

    // The axes hold the curves, and the target with the time to it where that is not far off.
    const std::vector<ErrorPoint>& others =
        model.comparison.shown ? model.comparison.history.points() : std::vector<ErrorPoint>{};
    const std::optional<ErrorTrend> trend = fit_trend(model.history);
    const double target = next_target(model.film.relative_error, asked_error(model));
    std::optional<double> seconds;
    if (trend && !model.status.done) seconds = seconds_until(*trend, target);
    Axis x, y;
    x.low = points.front().seconds;
    x.high = points.back().seconds;
    y.low = y.high = points.front().relative_error;
    for (const ErrorPoint& point : points) {
        y.low = std::min(y.low, point.relative_error);
        y.high = std::max(y.high, std::max(point.relative_error, point.relative_error_95));
    }
    for (const ErrorPoint& point : others) {
        x.low = std::min(x.low, point.seconds);
        x.high = std::max(x.high, point.seconds);
        y.low = std::min(y.low, point.relative_error);
        y.high = std::max(y.high, point.relative_error);
    }
    const double target_seconds = points.back().seconds + seconds.value_or(0);
    const bool shows_target = seconds && target_seconds < 30 * x.high;
    if (shows_target) {
        x.high = std::max(x.high, target_seconds);
        y.low = std::min(y.low, target);
    }
    x.low = std::max(x.low, 1e-4) * 0.85;
    x.high = std::max(x.high * 1.3, 4 * x.low);
    y.low /= 1.3;
    y.high *= 1.2;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    x.from = at.x + 3.6f * unit;
    x.to = at.x + width;
    y.from = at.y + height - 1.5f * unit;
    y.to = at.y + 0.4f * unit;

    // The grid and its numbers; a number that would touch the one before is left out.
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImU32 dim = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    float free_from = at.x;
    for_marks(x, [&](double value, bool labelled) {
        draw->AddLine({x.at(value), y.from}, {x.at(value), y.to}, labelled ? grid_color : faint_grid_color);
        const std::string number = fmt::format("{:g} s", value);
        const float half = 0.5f * ImGui::CalcTextSize(number.c_str()).x;
        if (!labelled || x.at(value) - half < free_from || x.at(value) + half > x.to) return;
        draw->AddText({x.at(value) - half, y.from + 0.3f * unit}, dim, number.c_str());
        free_from = x.at(value) + half + 0.5f * unit;
    });
    float free_below = y.from + unit;
    for_marks(y, [&](double value, bool labelled) {
        draw->AddLine({x.from, y.at(value)}, {x.to, y.at(value)}, labelled ? grid_color : faint_grid_color);
        const std::string number = fmt::format("{:.3g} %", 100 * value);
        const float half = 0.5f * unit;
        if (!labelled || y.at(value) + half > free_below || y.at(value) - half < at.y) return;
        draw->AddText({x.from - 0.4f * unit - ImGui::CalcTextSize(number.c_str()).x, y.at(value) - half}, dim,
                      number.c_str());
        free_below = y.at(value) - half;
    });
    draw->AddRect({x.from, y.to}, {x.to, y.from}, grid_color);

    const auto mean = [](const ErrorPoint& p) { return p.relative_error; };
    if (model.comparison.shown) {
        draw_curve(draw, x, y, others, other_color, mean);
    } else {
        draw_curve(draw, x, y, points, bound_color, [](const ErrorPoint& p) { return p.relative_error_95; });
    }
    draw_curve(draw, x, y, points, mean_color, mean);

    // Where it goes: the fitted line on to the target.
    if (shows_target && *seconds > 0) {
        const ImVec2 end(x.at(target_seconds), y.at(target));
        draw_dashes(draw, {x.at(points.back().seconds), y.at(trend->error_now)}, end, mean_color);
        draw->AddCircle(end, 3.5f * line_scale(), mean_color, 0, 1.4f * line_scale());
    }

    // What the curves are, at the top right, where they never are.
    float right = x.to - 0.5f * unit;
    const auto key = [&](const std::string& name, ImU32 color) {
        right -= ImGui::CalcTextSize(name.c_str()).x;
        draw->AddText({right, y.to + 0.3f * unit}, color, name.c_str());
        right -= unit;
    };
    if (trend)
        key(fmt::format("slope {}{:.2f}", trend->slope > 0 ? "−" : "", std::abs(trend->slope)),
            ImGui::GetColorU32(ImGuiCol_Text));
    if (model.comparison.shown) {
        const IntegratorSettings& settings = model.job.request.settings;
        const IntegratorSettings other = model.comparison.settings.in(settings);
        key(words_of(other, settings), other_color);
        key(words_of(settings, other), mean_color);
    } else {
        key("95 %", bound_color);
        key("mean", mean_color);
    }
    ImGui::Dummy({width, height});
}

}  // namespace candela
