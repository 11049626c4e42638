// SPDX-License-Identifier: MIT
// What is drawn over the picture. Each function fills the current ImGui frame.
#pragma once

#include "app/viewer/validation_readings.h"

namespace candela {

// How much wider than at the usual size lines and dots are drawn.
float line_scale();
// The window of ours is so low that panels take half of it, and that next to the side panel nothing else has room.
bool is_tiny();
bool has_room_beside_panels(const ViewerModel& model);
// The next window leaves some of the picture to be seen, in however small a window of ours.
void bound_next_window();
// Of the current ImGui window.
PanelArea current_panel_area();
// The line at the foot: scene, samples, time, speed, error.
void draw_status_line(const ViewerModel& model);
// While a scene loads.
void draw_loading_bar(const ViewerModel& model);
// Before the first scene is there.
void draw_welcome(const ViewerModel& model);
// A line of news or of failure; returns true when the person dismissed it.
bool draw_notice(const ViewerModel& model, const PanelArea& statistics);
// Where notices may stand in a window of that size: at the top, beside the statistics and the side panel (its width; 0:
// none), or under the statistics where there is too little room beside.
PanelArea notice_room(const Vec2& window, float unit, const PanelArea& statistics, float side_panel);
// Over the status line, for files with animations: while the panels are open or one of them is shown.
bool timeline_is_shown(const ViewerModel& model);
void draw_timeline(const ViewerModel& model, PanelEdits& edits);
// What --until-error asked for, as a fraction.
std::optional<double> asked_error(const ViewerModel& model);
ErrorWords words_of(const ViewerModel& model);
// The sentence of the stated error and its plot over time, in the current window.
void draw_convergence(const ViewerModel& model);
// Says of a denoised picture, and of the reference, that it is one.
void draw_badge(const ViewerModel& model);
// "relMSE 0.0123": the number of that measure over all pixels.
std::string metric_words(ReferenceMetric metric, const ImageDifference& difference);
// Of statistics, readings and legend; those that are not shown are empty.
using TakenAreas = std::array<PanelArea, 3>;
// The pixel that was clicked at, beside an area that is taken; where it stood in the frame before, and stands now.
PanelArea draw_pixel_panel(const ViewerModel& model, const TakenAreas& taken, const PanelArea& before);
// The first corner of the room, (1, 1) at the bottom right, where a panel of that size hides neither the pixel nor what
// is taken; rather that than the pixel.
struct FreeCorner {
    Vec2 pivot{1, 1};
    bool hides = false;  // something all the same
};
FreeCorner free_corner(const PanelArea& room, const Vec2& size, const PanelArea& pixel, const TakenAreas& taken);
// How high a panel of that width may be in the room without hiding the pixel.
float free_height(const PanelArea& room, float width, const PanelArea& pixel);
// The path of that pixel's brightest sample in the picture.
void draw_path(const ViewerModel& model);
// The same path vertex by vertex, in the current window, where so much room is left.
void draw_ledger(const PixelLedger& ledger, size_t most_rows, float most_width);
// The scene's tree, materials and lights, in the current window.
void edit_section(ViewerModel& model, PanelEdits& edits);
// What is compared, and with what, in the current window.
void compare_section(ViewerModel& model, PanelEdits& edits);
// How the sides of a comparison stand; nothing where there is none.
std::string comparison_words(const ViewerModel& model);
// The map beside the picture: where its line stands, in points (none: no map is shown), the line with its labels, and
// the colours with their numbers.
std::optional<float> wipe_x(const ViewerModel& model);
void draw_wipe(const ViewerModel& model);
PanelArea draw_legend(const ViewerModel& model, bool beside_readings);
void draw_help();
PanelArea draw_statistics(const ViewerModel& model);
// The exact values of a validation scene, marked in the picture; nothing for other scenes.
PanelArea draw_validation(const ViewerModel& model, const std::vector<ValidationReading>& readings);
// Bookmarks and views that were left: a section of the side panel.
void views_section(ViewerModel& model, PanelEdits& edits);
// Lights that are re-weighted: a section of the side panel.
void lights_section(const ViewerModel& model, PanelEdits& edits);
// Numbered pictures: a section of the side panel.
void sequence_section(ViewerModel& model, PanelEdits& edits);
// Opening files, and how the panels look: sections of the side panel.
void open_section(const ViewerModel& model, PanelEdits& edits);
void window_section(ViewerModel& model, PanelEdits& edits);
// Camera, light, rendering, display and scene, at the right, and how wide that is in points.
PanelEdits draw_side_panel(ViewerModel& model);
float side_panel_width();

}  // namespace candela
