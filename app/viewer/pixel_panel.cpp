// SPDX-License-Identifier: MIT
// The pixel under the glass, and the path of its brightest sample: as a table, and drawn in the scene.
#include <fmt/format.h>
#include <imgui.h>

#include "app/viewer/panels.h"

namespace candela {

namespace {

const ImU32 path_color = IM_COL32(232, 163, 61, 255), light_color = IM_COL32(110, 185, 235, 255),
            shadow_color = IM_COL32(0, 0, 0, 150);

// Of a path; and fewer say too little.
constexpr size_t most_path_rows = 18, least_path_rows = 3;
// Of the panel, in sizes of the font: as wide as names want it, and where that leaves room for fewer rows.
constexpr float most_width = 58, usual_width = 46;
constexpr size_t rows_over_path = 12;

std::string color_text(const Vec3& c) {
    return fmt::format("{:.3g}  {:.3g}  {:.3g}", c.r, c.g, c.b);
}

void row(const char* name, const std::string& value) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value.c_str());
}

// What there is room for: a small window has only the first rows; a large one two beside each other, over the table of
// the path.
void pixel_rows(const ViewerModel& model, const Inspection& inspection, bool brief) {
    const Scene& scene = *model.job.world->scene;
    if (!ImGui::BeginTable("pixel", brief ? 2 : 4, ImGuiTableFlags_SizingFixedFit)) return;
    row("pixel", fmt::format("{}, {}", inspection.pixel.x, inspection.pixel.y));
    row("value", color_text(Vec3(inspection.value)));
    if (inspection.error >= 0) {
        const std::string error = "±" + percent_text(static_cast<double>(inspection.error));
        row("error",
            brief ? error : fmt::format("{}, {:.0f} samples, {:.1f} rays", error, inspection.samples, inspection.rays));
    }
    const FirstHit& hit = inspection.hit;
    row("object", hit.hit ? object_name(scene, hit.instance) : "the background");
    if (hit.hit && !brief) {
        row("material", material_name(scene, hit.material));
        row("position", color_text(hit.position) + " m");
        row("albedo", color_text(hit.albedo));
        row("distance, uv", fmt::format("{:.4g} m, {:.3f} {:.3f}", hit.depth, hit.uv.x, hit.uv.y));
        // The side panel has the factors for editing.
        if (hit.material < scene.materials.size() && !model.show_panels) {
            const Material& material = scene.materials[hit.material];
            row("base colour", color_text(Vec3(material.base_color_factor)));
            row("metallic, roughness",
                fmt::format("{:.2f}, {:.2f}", material.metallic_factor, material.roughness_factor));
            if (material.emits()) row("emission", color_text(material.emissive_factor * material.emissive_strength));
            if (material.transmits())
                row("transmission, ior", fmt::format("{:.2f}, {:.3g}", material.transmission.factor, material.ior));
        }
    }
    ImGui::EndTable();
}

// Segments of a path in points of the window.
class Overlay {
  public:
    explicit Overlay(const View& view) : view_(view) {}

    void line(const Vec3& a, const Vec3& b, ImU32 color, float width) {
        std::optional<ImVec2> from = point(a), to = point(b);
        // What begins or ends behind the eye is cut where it comes into sight.
        if (!from && !to) return;
        Vec3 seen = from ? a : b, hidden = from ? b : a;
        if (!from || !to) {
            for (int i = 0; i < 24; ++i) {
                const Vec3 middle = 0.5f * (seen + hidden);
                (point(middle) ? seen : hidden) = middle;
            }
            (from ? to : from) = point(seen);
        }
        if (!from || !to) return;
        draw_->AddLine(*from, *to, shadow_color, scale_ * (width + 2));
        draw_->AddLine(*from, *to, color, scale_ * width);
    }
    void dot(const Vec3& at, ImU32 color, const std::string& words) {
        const std::optional<ImVec2> center = point(at);
        if (!center) return;
        draw_->AddCircleFilled(*center, 5 * scale_, shadow_color);
        draw_->AddCircleFilled(*center, 3.5f * scale_, color);
        if (words.empty()) return;
        draw_->AddText({center->x + 7 * scale_, center->y - 5 * scale_}, shadow_color, words.c_str());
        draw_->AddText({center->x + 6 * scale_, center->y - 6 * scale_}, color, words.c_str());
    }

  private:
    std::optional<ImVec2> point(const Vec3& world) const {
        const float aspect = static_cast<float>(view_.extent.x) / static_cast<float>(view_.extent.y);
        const Vec3 seen = project(view_.camera, aspect, world);
        if (!(seen.z > 1e-6f) || !is_finite(seen)) return std::nullopt;
        const ImVec2 display = ImGui::GetIO().DisplaySize;
        const Vec2 at = Vec2(seen) * Vec2(display.x, display.y);
        if (std::abs(at.x) > 1e5f || std::abs(at.y) > 1e5f) return std::nullopt;
        return ImVec2(at.x, at.y);
    }

    const View& view_;
    float scale_ = line_scale();
    ImDrawList* draw_ = ImGui::GetBackgroundDrawList();
};

}  // namespace

void draw_path(const ViewerModel& model) {
    if (!model.inspection || !model.inspection->ledger) return;
    const std::vector<LedgerVertex>& vertices = model.inspection->ledger->path.vertices;
    Overlay overlay(model.inspection->view);
    for (size_t i = 0; i < vertices.size(); ++i) {
        if (i > 0) overlay.line(vertices[i - 1].position, vertices[i].position, path_color, 1.6f);
        if (luminance(vertices[i].connected) > 0)
            overlay.line(vertices[i].position, vertices[i].connection_end, light_color, 1.2f);
    }
    for (size_t i = 0; i < vertices.size(); ++i) {
        if (vertices[i].shading.end != PathEnd::missed)
            overlay.dot(vertices[i].position, path_color, fmt::format("{}", i + 1));
    }
}

FreeCorner free_corner(const PanelArea& room, const Vec2& size, const PanelArea& pixel, const TakenAreas& taken) {
    FreeCorner out;
    int least_hidden = std::numeric_limits<int>::max();
    for (const Vec2& each : {Vec2(1, 1), Vec2(1, 0), Vec2(0, 1), Vec2(0, 0)}) {
        const Vec2 low = room.low + each * (room.high - room.low - size);
        const PanelArea area{low, low + size};
        int hidden = area.overlaps(pixel) ? 1 + static_cast<int>(taken.size()) : 0;
        for (const PanelArea& panel : taken)
            hidden += area.overlaps(panel) ? 1 : 0;
        if (hidden >= least_hidden) continue;
        least_hidden = hidden;
        out = {each, hidden > 0};
    }
    return out;
}

float free_height(const PanelArea& room, float width, const PanelArea& pixel) {
    const bool beside = pixel.low.x - room.low.x >= width || room.high.x - pixel.high.x >= width;
    return beside ? room.high.y - room.low.y : std::max(pixel.low.y - room.low.y, room.high.y - pixel.high.y);
}

PanelArea draw_pixel_panel(const ViewerModel& model, const TakenAreas& taken, const PanelArea& before) {
    if (!model.inspection || !model.has_scene()) return {};
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float unit = ImGui::GetFontSize();
    const Vec2 low(unit, unit);
    const Vec2 high(display.x - unit - (model.show_panels ? side_panel_width() + unit : 0), display.y - 4.6f * unit);
    // Beside the side panel a small window has only the path.
    if (!has_room_beside_panels(model) || high.x - low.x < 12 * unit) return {};

    const Vec2 pixel =
        (Vec2(model.inspection->pixel) + 0.5f) / Vec2(model.inspection->view.extent) * Vec2(display.x, display.y);
    const PanelArea room{low, high}, marked{pixel - unit, pixel + unit};
    const float row_height = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
    const size_t rows = rows_over_path + (model.inspection->ledger ? model.inspection->ledger->rows.size() : 0);
    float width = std::min(most_width * unit, high.x - low.x), height = free_height(room, width, marked);
    const float narrow = std::min(usual_width * unit, width);
    if (height < std::min(row_height * static_cast<float>(rows), free_height(room, narrow, marked))) {
        width = narrow;
        height = free_height(room, width, marked);
    }
    // Where the path's table would stand over another panel, it waits until that is put away.
    const Vec2 all(width, std::min(height, row_height * static_cast<float>(rows)));
    const bool small = high.x - low.x < 46 * unit || is_tiny();
    const bool brief = small || free_corner(room, all, marked, taken).hides;
    const Vec2 pivot = free_corner(room, before.high - before.low, marked, taken).pivot;
    const Vec2 place = low + pivot * (high - low);
    ImGui::SetNextWindowPos({place.x, place.y}, ImGuiCond_Always, {pivot.x, pivot.y});
    ImGui::Begin("Pixel", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoInputs);

    // Of the path as much as there is room for, without hiding the pixel.
    pixel_rows(model, *model.inspection, brief);
    if (brief && !small) ImGui::TextDisabled("its path: when there is room");
    const float rows_left = (height - ImGui::GetCursorPosY()) / row_height - 5;
    const size_t most_rows = std::min(static_cast<size_t>(std::max(rows_left, 0.0f)), most_path_rows);
    if (!brief && most_rows >= least_path_rows) {
        ImGui::Separator();
        if (model.inspection->ledger) {
            draw_ledger(*model.inspection->ledger, most_rows, width - 2 * ImGui::GetStyle().WindowPadding.x);
        } else {
            ImGui::TextDisabled("looking for its brightest sample");
        }
    }
    const PanelArea now = current_panel_area();
    ImGui::End();
    return now;
}

}  // namespace candela
