// SPDX-License-Identifier: MIT
#include "app/viewer/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include "app/clock_text.h"
#include "app/viewer/palette.h"

namespace candela {

namespace {

constexpr ImGuiWindowFlags overlay_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                           ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                           ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize;

float unit() {
    return ImGui::GetFontSize();
}

// A window of fixed place: anchor and pivot are fractions of the display and of the window.
void place(const ImVec2& anchor, const ImVec2& offset) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({anchor.x * display.x + offset.x, anchor.y * display.y + offset.y}, ImGuiCond_Always,
                            anchor);
}

void text(const std::string& line) {
    ImGui::TextUnformatted(line.c_str(), line.c_str() + line.size());
}

// Items of the status line, each behind a gap.
class Line {
  public:
    explicit Line(float right_end) : right_end_(right_end) {}
    // Left out where it would not fit, or would leave less than that much room; returns whether it is there.
    bool item(const std::string& words, const ImVec4* color = nullptr, float room = 0) {
        const float width = ImGui::CalcTextSize(words.c_str()).x;
        if (x_ + width + room > right_end_) return false;
        ImGui::SameLine(x_);
        if (color != nullptr) ImGui::PushStyleColor(ImGuiCol_Text, *color);
        text(words);
        if (color != nullptr) ImGui::PopStyleColor();
        x_ += width + 1.6f * unit();
        return true;
    }
    void start(float x) { x_ = x; }

  private:
    float x_ = 0, right_end_;
};

const char* state_words(const ViewerModel& model) {
    if (model.status.paused) return "paused";
    return model.status.done ? "done" : nullptr;
}

}  // namespace

float line_scale() {
    return ImGui::GetFontSize() / 15;
}

bool is_tiny() {
    return ImGui::GetIO().DisplaySize.y <= 32 * unit();
}

bool has_room_beside_panels(const ViewerModel& model) {
    return !model.show_panels || !is_tiny();
}

void bound_next_window() {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float height = is_tiny() ? 0.55f * display.y : display.y - 4.4f * unit();
    ImGui::SetNextWindowSizeConstraints({0, 0}, {std::max(display.x - 2 * unit(), 1.0f), std::max(height, 1.0f)});
}

PanelArea current_panel_area() {
    const ImVec2 low = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    return {{low.x, low.y}, {low.x + size.x, low.y + size.y}};
}

std::optional<double> asked_error(const ViewerModel& model) {
    if (!model.options.until_error_percent) return std::nullopt;
    return *model.options.until_error_percent / 100;
}

ErrorWords words_of(const ViewerModel& model) {
    return error_words(model.film, model.history, asked_error(model), !model.status.done);
}

void draw_status_line(const ViewerModel& model) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const ImVec4 &accent = palette_of(model.style.theme).accent, &alarm = palette_of(model.style.theme).alarm;
    const float height = 1.8f * unit(), margin = 0.8f * unit();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(margin, (height - unit()) / 2));
    ImGui::SetNextWindowPos({0, display.y - height});
    ImGui::SetNextWindowSize({display.x, height});
    ImGui::Begin("status", nullptr, (overlay_flags & ~ImGuiWindowFlags_AlwaysAutoResize) | ImGuiWindowFlags_NoInputs);

    // What the picture is shown with stands at the right, how far it is at the left.
    const bool wide = display.x > 50 * unit();
    const std::string right =
        wide ? fmt::format("{} {:+.2f} EV    H help", name_of(model.display.tone.curve), model.display.tone.exposure_ev)
             : "H help";
    const float right_begin = display.x - margin - ImGui::CalcTextSize(right.c_str()).x;
    Line line(right_begin - unit());
    line.start(margin);
    if (model.has_scene()) {
        line.item(file_name(model.job.scene_path));
        line.item(fmt::format("{} spp", model.status.spp));
        line.item(clock_text(model.status.render_seconds));
        if (!model.lights.words().empty()) line.item("lights re-weighted", &accent);
        if (model.is_reprojected) line.item("reprojected", &accent);
        if (model.writing)
            line.item(fmt::format("picture {} of {}", std::min(model.writing->first + 1, model.writing->second),
                                  model.writing->second),
                      &accent);
        if (model.flying) line.item("flying", &accent);
        if (const char* state = state_words(model)) line.item(state, &accent);
        // The speed stays, and what matters more than it.
        const std::string speed = fmt::format("{:.2f} Mrays/s", model.status.rays_per_second * 1e-6);
        const float room = ImGui::CalcTextSize(speed.c_str()).x + 3 * unit();
        const ErrorWords words = words_of(model);
        if (!words.brief.empty() && !line.item(words.sentence, nullptr, room) && !line.item(words.brief, nullptr, room))
            line.item("±" + percent_text(model.film.relative_error));
        line.item(speed);
        if (model.denoised_spp) line.item("denoised", &accent);
        if (model.reference && model.reference->mean_samples) {
            line.item(
                metric_words(model.map.metric.value_or(ReferenceMetric::relative_square), model.reference->difference));
        }
        if (model.job.request.settings.biased()) line.item("biased", &alarm);
        if (model.film.non_finite > 0) line.item(fmt::format("{} samples not finite", model.film.non_finite), &alarm);
        if (!model.job.warnings.empty()) {
            line.item(
                fmt::format("{} warning{} (Z)", model.job.warnings.size(), model.job.warnings.size() > 1 ? "s" : ""),
                &accent);
        }
    }
    if (right_begin > margin) {
        ImGui::SameLine(right_begin);
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
        text(right);
        ImGui::PopStyleColor();
    }
    ImGui::End();
    ImGui::PopStyleVar(4);
}

void draw_loading_bar(const ViewerModel& model) {
    place({0.5f, 1.0f}, {0, (timeline_is_shown(model) ? -5.6f : -3.2f) * unit()});
    ImGui::Begin("loading", nullptr, overlay_flags | ImGuiWindowFlags_NoInputs);
    text("opening " + model.loading_name);
    const float width = std::min(20 * unit(), 0.7f * ImGui::GetIO().DisplaySize.x);
    ImGui::ProgressBar(static_cast<float>(model.loading_state.fraction), {width, 0.4f * unit()}, "");
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    text(model.loading_state.step.empty() ? "waiting" : model.loading_state.step);
    ImGui::PopStyleColor();
    ImGui::End();
}

void draw_welcome(const ViewerModel&) {
    place({0.5f, 0.5f}, {0, 0});
    ImGui::Begin("welcome", nullptr, overlay_flags | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoBackground);
    text("Drop a .gltf or .glb file here, or press Ctrl+O");
    ImGui::End();
}

PanelArea notice_room(const Vec2& window, float unit, const PanelArea& statistics, float side_panel) {
    const float least = 18 * unit;
    PanelArea room{Vec2(unit), window - unit};
    if (side_panel > 0 && window.x - side_panel - 3 * unit >= least) room.high.x -= side_panel + unit;
    if (statistics == PanelArea{}) return room;
    const float beside = statistics.high.x + unit;
    if (room.high.x - beside >= least) {
        room.low.x = beside;
    } else {
        room.low.y = statistics.high.y + unit;
    }
    return room;
}

bool draw_notice(const ViewerModel& model, const PanelArea& statistics) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const PanelArea room = notice_room({display.x, display.y}, unit(), statistics,
                                       model.show_panels && model.has_scene() ? side_panel_width() : 0);
    const float width = room.high.x - room.low.x;
    const float wrap = std::min(44 * unit(), width - ImGui::GetStyle().WindowPadding.x);
    ImGui::SetNextWindowPos({room.low.x + 0.5f * width, room.low.y}, ImGuiCond_Always, {0.5f, 0});
    bound_next_window();
    ImGui::Begin("notice", nullptr, overlay_flags | (model.notice_is_error ? 0 : ImGuiWindowFlags_NoInputs));
    ImGui::PushTextWrapPos(wrap);
    if (model.notice_is_error)
        ImGui::TextColored(palette_of(model.style.theme).alarm, "%s",
                           model.has_scene() ? "That did not work; what was open stays" : "That did not work");
    text(model.notice);
    ImGui::PopTextWrapPos();
    const bool dismissed = model.notice_is_error && ImGui::Button("Close");
    ImGui::End();
    return dismissed;
}

PanelArea draw_statistics(const ViewerModel& model) {
    if (!model.has_scene() || !has_room_beside_panels(model)) return {};
    place({0.0f, 0.0f}, {unit(), unit()});
    bound_next_window();
    ImGui::Begin("statistics", nullptr, overlay_flags | ImGuiWindowFlags_NoInputs);
    const auto row = [](const char* name, const std::string& value) {
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", name);
        ImGui::TableNextColumn();
        text(value);
    };
    const SessionStatus& status = model.status;
    const World& world = *model.job.world;
    // What tells figures apart is in one column, in whichever table.
    const auto begin_figures = [](const char* name) {
        if (!ImGui::BeginTable(name, 2)) return false;
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed,
                                ImGui::CalcTextSize("of which reprojecting").x);
        ImGui::TableSetupColumn("figure");
        return true;
    };
    if (begin_figures("figures")) {
        row("picture", fmt::format("{} x {}", model.frame_extent.x, model.frame_extent.y));
        row("triangles", fmt::format("{} in {} instances", world.triangle_count, world.scene->instances.size()));
        row("light sources", fmt::format("{} punctual, {} triangles{}", world.lights.punctual.size(),
                                         world.lights.cells.size(), world.lights.environment ? ", environment" : ""));
        row("loaded, built in",
            fmt::format("{:.0f} ms, {:.0f} ms", 1e3 * model.job.load_seconds, 1e3 * model.job.build_seconds));
        row("camera rays", fmt::format("{:.2f} M", static_cast<double>(status.rays.camera) * 1e-6));
        row("bounce rays", fmt::format("{:.2f} M", static_cast<double>(status.rays.bounce) * 1e-6));
        row("shadow rays", fmt::format("{:.2f} M", static_cast<double>(status.rays.shadow) * 1e-6));
        if (model.latency.count > 0) {
            row("input to picture",
                fmt::format("{:.1f} ms (median {:.1f}, worst {:.1f} of {})", 1e3 * model.latency.last_s,
                            1e3 * model.latency.median_s, 1e3 * model.latency.worst_s, model.latency.count));
        }
        row(model.latency.count > 0 ? "of which tracing" : "edit to picture",
            fmt::format("{:.1f} ms", 1e3 * status.last_first_frame_seconds));
        if (status.last_reproject_seconds > 0)
            row("of which reprojecting", fmt::format("{:.1f} ms", 1e3 * status.last_reproject_seconds));
        row("of which letting go", fmt::format("{:.1f} ms", 1e3 * status.last_cancel_seconds));
        ImGui::EndTable();
    }
    if (model.reference) {
        ImGui::Separator();
        if (begin_figures("reference")) {
            row("reference", file_name(model.reference->path));
            if (model.reference->mean_samples) {
                const ImageDifference& d = model.reference->difference;
                row("picture compared", fmt::format("at {:.4g} samples", *model.reference->mean_samples));
                row("signed mean", fmt::format("{:+.3g}", d.signed_mean));
                row("RMSE, relMSE", fmt::format("{:.3g}, {:.3g}", d.rmse, d.rel_mse));
                row("FLIP", fmt::format("{:.4f}", d.flip));
            } else {
                const Vec2u size = model.reference->extent;
                if (size == model.frame_extent) {
                    row("its size", fmt::format("{} x {}", size.x, size.y));
                } else {
                    row("not compared", fmt::format("it has {} x {} pixels", size.x, size.y));
                }
            }
            ImGui::EndTable();
        }
    }
    ImGui::Separator();
    draw_convergence(model);
    ImGui::PushTextWrapPos(30 * unit());
    for (const std::string& warning : model.job.warnings) {
        ImGui::PushStyleColor(ImGuiCol_Text, palette_of(model.style.theme).accent);
        text(warning);
        ImGui::PopStyleColor();
    }
    ImGui::PopTextWrapPos();
    const PanelArea now = current_panel_area();
    ImGui::End();
    return now;
}

}  // namespace candela
