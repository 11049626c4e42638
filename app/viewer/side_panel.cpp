// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <imgui.h>

#include <utility>

#include "app/viewer/environment_files.h"
#include "app/viewer/fields.h"
#include "app/viewer/panels.h"

namespace candela {

namespace {

// A combo of fixed words; true when another one was chosen.
template <typename E, size_t N>
bool choose(const char* label, E& value, const char* const (&words)[N]) {
    int index = static_cast<int>(value);
    if (!ImGui::Combo(label, &index, words, static_cast<int>(N))) return false;
    value = static_cast<E>(index);
    return true;
}

// A combo over strings that the file names; returns the chosen index.
std::optional<uint32_t> choose_named(const char* label, const std::string& preview,
                                     const std::vector<std::string>& names) {
    std::optional<uint32_t> chosen;
    if (!begin_combo(label, preview)) return chosen;
    for (uint32_t i = 0; i < names.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Selectable(names[i].empty() ? fmt::format("number {}", i).c_str() : names[i].c_str())) chosen = i;
        ImGui::PopID();
    }
    ImGui::EndCombo();
    return chosen;
}

void camera_section(ViewerModel& model, PanelEdits& edits) {
    if (!ImGui::CollapsingHeader("Camera", ImGuiTreeNodeFlags_DefaultOpen)) return;
    Camera& camera = model.view.camera;
    const Scene& scene = *model.job.world->scene;
    if (!scene.cameras.empty()) {
        std::vector<std::string> names;
        for (const CameraInstance& each : scene.cameras)
            names.push_back(each.name);
        edits.camera = choose_named("of the file", "choose", names);
    }
    if (camera.projection == Projection::perspective) {
        float degrees = glm::degrees(camera.yfov_radians);
        if (ImGui::SliderFloat("field of view", &degrees, 1, 150, "%.1f°", ImGuiSliderFlags_AlwaysClamp)) {
            camera.yfov_radians = glm::radians(degrees);
            edits.view = true;
        }
        edits.view |= ImGui::DragFloat("aperture", &camera.aperture_diameter_m, 0.001f, 0, 1000, "%.3f m",
                                       ImGuiSliderFlags_AlwaysClamp);
        if (camera.aperture_diameter_m > 0) {
            edits.view |= ImGui::DragFloat("focus", &camera.focus_distance_m, 0.01f * camera.focus_distance_m, 1e-4f,
                                           1e6f, "%.3f m", ImGuiSliderFlags_AlwaysClamp);
        }
    }
    edits.frame_all = ImGui::Button("Frame all");
}

void light_section(ViewerModel& model, PanelEdits& edits) {
    if (!ImGui::CollapsingHeader("Environment", ImGuiTreeNodeFlags_DefaultOpen)) return;
    if (model.job.environment == nullptr) {
        ImGui::TextDisabled("none: choose or drop one");
    } else {
        edits.environment |= ImGui::SliderFloat("turn", &model.options.hdri_rotation_degrees, -180, 180, "%.0f°");
        edits.environment |=
            ImGui::SliderFloat("intensity", &model.options.hdri_intensity, 0, 10, "%.2f", ImGuiSliderFlags_Logarithmic);
    }
    const std::string now = model.options.hdri.empty() ? "choose" : file_name(model.options.hdri);
    if (begin_combo("file", now)) {
        // Looked for when the list opens.
        if (ImGui::IsWindowAppearing())
            model.environment_files = environment_files(model.job.scene_path, model.options.hdri);
        for (const std::string& path : model.environment_files) {
            ImGui::PushID(path.c_str());
            if (ImGui::Selectable(file_name(path).c_str(), path == model.options.hdri)) edits.environment_file = path;
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
    constexpr const char* backgrounds[] = {"environment", "colour", "transparent"};
    IntegratorSettings& settings = model.options.integrator;
    edits.settings |= choose("background", settings.background, backgrounds);
    if (settings.background == BackgroundKind::color)
        edits.settings |= color_field("colour", settings.background_color, 0);
}

void render_section(ViewerModel& model, PanelEdits& edits) {
    if (!ImGui::CollapsingHeader("Rendering", ImGuiTreeNodeFlags_DefaultOpen)) return;
    IntegratorSettings& settings = model.options.integrator;
    constexpr const char* estimators[] = {"MIS", "light", "BSDF"};
    constexpr const char* samplers[] = {"Sobol", "independent"};
    constexpr const char* filters[] = {"Blackman-Harris", "box"};
    edits.settings |= choose("estimator", settings.estimator, estimators);
    edits.settings |= choose("sampler", settings.sampler, samplers);
    edits.settings |= choose("filter", settings.filter, filters);
    bool reuse_paths = settings.reuse_paths;
    if (ImGui::Checkbox("share paths between pixels", &reuse_paths)) {
        settings.reuse_paths = reuse_paths;
        edits.settings = true;
    }
    int depth = static_cast<int>(settings.max_depth);
    if (ImGui::SliderInt("depth", &depth, 0, 16, depth == 0 ? "no limit" : "%d (biased)",
                         ImGuiSliderFlags_AlwaysClamp)) {
        settings.max_depth = static_cast<uint32_t>(depth);
        edits.settings = true;
    }
    edits.settings |=
        ImGui::DragFloat("clamp", &settings.clamp_indirect, 0.1f, 0, 1000,
                         settings.clamp_indirect > 0 ? "%.1f (biased)" : "off", ImGuiSliderFlags_AlwaysClamp);
    auto frame_time_ms = static_cast<float>(model.options.frame_time_ms);
    if (ImGui::SliderFloat("frame time", &frame_time_ms, 5, 200, "%.0f ms",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
        model.options.frame_time_ms = static_cast<double>(frame_time_ms);
        edits.frame_time = true;
    }
    edits.toggle_pause = ImGui::Button(model.status.paused ? "Go on" : "Pause");
}

void display_section(ViewerModel& model, PanelEdits& edits) {
    if (!ImGui::CollapsingHeader("Display", ImGuiTreeNodeFlags_DefaultOpen)) return;
    constexpr const char* curves[] = {"linear", "neutral", "ACES", "AgX"};
    edits.tone |= ImGui::SliderFloat("exposure", &model.display.tone.exposure_ev, -10, 10, "%+.2f EV");
    edits.tone |= choose("tone curve", model.display.tone.curve, curves);
    constexpr const char* maps[] = {"none", "error", "samples", "rays", "bounces"};
    int map = model.map.shown && !model.map.metric ? 1 + static_cast<int>(model.map.map) : 0;
    if (choose("map", map, maps)) {
        model.map.shown = map > 0;
        model.map.metric.reset();
        if (map > 0) model.map.map = static_cast<PixelMap>(map - 1);
        edits.map = true;
    }
    bool denoises = model.denoises;
    edits.denoise = ImGui::Checkbox("denoised preview", &denoises);
    if (model.map.shown) edits.map |= ImGui::SliderFloat("wipe", &model.map.wipe, 0, 1, "%.2f");
}

void scene_section(const ViewerModel& model, PanelEdits& edits) {
    if (!ImGui::CollapsingHeader("File")) return;
    const Scene& scene = *model.job.world->scene;
    ImGui::TextWrapped("%s", model.job.scene_path.c_str());
    if (scene.scene_names.size() > 1) {
        const std::string& now = scene.scene_names[scene.active_scene];
        edits.scene =
            choose_named("scene", now.empty() ? fmt::format("number {}", scene.active_scene) : now, scene.scene_names);
    }
    if (!scene.variant_names.empty()) {
        constexpr const char* own = "the file's own";
        std::vector<std::string> names{own};
        names.insert(names.end(), scene.variant_names.begin(), scene.variant_names.end());
        const std::string& now = scene.active_variant ? scene.variant_names[*scene.active_variant] : names[0];
        if (const std::optional<uint32_t> chosen = choose_named("variant", now, names)) {
            edits.variant = *chosen == 0 ? std::optional<uint32_t>() : std::optional<uint32_t>(*chosen - 1);
        }
    }
    constexpr const char* treatments[] = {"rendered", "approximated", "ignored", "refused"};
    for (const ExtensionUse& use : scene.extensions) {
        ImGui::TextWrapped("%s", use.name.c_str());
        ImGui::Indent();
        ImGui::TextDisabled("%s%s%s", treatments[static_cast<size_t>(use.treatment)], use.how.empty() ? "" : ": ",
                            use.how.c_str());
        ImGui::Unindent();
    }
}

void validation_section(PanelEdits& edits) {
    if (!ImGui::CollapsingHeader("Validate")) return;
    ImGui::TextWrapped(
        "Scenes whose answers are known. Each shows the exact value beside what the picture has so far.");
    std::vector<std::string> names;
    for (const ValidationScene& scene : validation_scenes())
        names.push_back(std::filesystem::path(scene.name).stem().string());
    edits.validation_scene = choose_named("scene##validation", "choose", names);
}

}  // namespace

float side_panel_width() {
    return std::min(20 * ImGui::GetFontSize(), ImGui::GetIO().DisplaySize.x - 2 * ImGui::GetFontSize());
}

PanelEdits draw_side_panel(ViewerModel& model) {
    PanelEdits edits;
    if (!model.has_scene()) return edits;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float unit = ImGui::GetFontSize();
    const float width = side_panel_width();
    ImGui::SetNextWindowPos({display.x - width - unit, unit});
    const float height = !is_tiny() ? display.y - 4 * unit : (timeline_is_shown(model) ? 0.35f : 0.55f) * display.y;
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, height});
    if (std::exchange(model.focuses_panels, false)) ImGui::SetNextWindowFocus();
    ImGui::Begin("panels", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushItemWidth(0.55f * width);
    Editable before = editable_of(model);
    open_section(model, edits);
    camera_section(model, edits);
    views_section(model, edits);
    light_section(model, edits);
    lights_section(model, edits);
    render_section(model, edits);
    display_section(model, edits);
    edit_section(model, edits);
    compare_section(model, edits);
    sequence_section(model, edits);
    scene_section(model, edits);
    validation_section(edits);
    window_section(model, edits);
    // A step of the history is what there was before the first change of a drag, which may come after its beginning.
    const bool changed = edits.scene_edited || edits.view || edits.environment || edits.settings || edits.tone ||
                         edits.light_weights.has_value();
    if (changed && !model.edit_continues) {
        before.scene = edits.scene_edited;
        edits.before_edit = std::move(before);
    }
    model.edit_continues = ImGui::IsAnyItemActive() && (model.edit_continues || changed);
    ImGui::PopItemWidth();
    ImGui::End();
    return edits;
}

}  // namespace candela
