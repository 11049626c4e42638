// SPDX-License-Identifier: MIT
// Everything that the panels show and edit, as plain data.
#pragma once

#include "app/gl/display.h"
#include "app/render_job.h"
#include "app/viewer/bookmarks.h"
#include "app/viewer/compared_settings.h"
#include "app/viewer/edit_history.h"
#include "app/viewer/error_words.h"
#include "app/viewer/frame_writer.h"
#include "app/viewer/inspection.h"
#include "app/viewer/latency.h"
#include "app/viewer/light_mixer.h"
#include "app/viewer/map_view.h"
#include "app/viewer/playback.h"
#include "app/viewer/scene_loader.h"
#include "app/viewer/theme.h"
#include "app/viewer/view_control.h"

namespace candela {

// Where a panel stands, in points of the window; empty: nowhere.
struct PanelArea {
    Vec2 low{0}, high{0};

    bool operator==(const PanelArea&) const = default;
    bool overlaps(const PanelArea& other) const {
        return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
    }
};

// The same view with other settings, to the right of the wipe; both have half of the cores.
struct Comparison {
    bool shown = false;
    ComparedSettings settings;
    // As of the last update.
    SessionStatus status;
    FilmStatistics film;
    ErrorHistory history;
    uint64_t serial = 0;  // of its frame
};

// A picture that is taken for the truth.
struct ReferenceView {
    std::string path;
    Vec2u extent{0};
    ImageDifference difference;          // of the picture from it
    std::optional<double> mean_samples;  // of the picture when it was compared; none: not yet
    bool held = false;                   // it is shown in place of the picture
};

struct ViewerModel {
    RenderOptions options;  // of the scene shown
    RenderJob job;          // its world is null before the first scene
    OrbitView view;
    DisplaySettings display;
    UiStyle style;
    Bookmarks bookmarks;
    LightMixer lights;
    Playback playback;
    MapView map;
    HeatScale map_scale;                        // of the map that is shown
    float picture_left = 0, picture_width = 0;  // where the picture stands in the window, in points

    bool denoises = false;                 // the picture's noise is filtered away where that is ready
    std::optional<uint32_t> denoised_spp;  // of the denoised picture that is shown; none: the true one is

    Comparison comparison;
    std::optional<ReferenceView> reference;
    // What the panels edit: of the scene, once it is compiled.
    std::vector<Material> materials;
    std::vector<PunctualLight> punctual_lights;
    uint32_t edited_material = 0, edited_light = 0;  // that the panel shows
    std::vector<std::string> environment_files;      // that the panel offers
    bool edit_continues = false;                     // what is being dragged has its step of the history
    std::optional<Inspection> inspection;            // of the pixel that was clicked at

    SequenceSettings sequence;
    std::optional<std::pair<uint32_t, uint32_t>> writing;  // pictures of a sequence that are there, of how many
    bool flying = false;
    bool panels_have_keyboard = false, focuses_panels = false;  // focuses: with the next frame
    std::vector<std::string> recent;                            // scenes that were open before, the last first

    bool show_interface = true;  // false: only the picture
    bool show_panels = false;
    bool show_help = false;
    bool show_statistics = false;

    // What the session and the loader say, as of the last update.
    SessionStatus status;
    FilmStatistics film;
    ErrorHistory history;
    LatencyMeter::Summary latency;  // from an input to its picture
    Vec2u frame_extent{0};
    uint64_t frame_epoch = 0;  // the submit that the frame shown belongs to
    uint64_t frame_serial = 0;
    bool is_reprojected = false;  // the picture is led over from the view before
    bool loading = false;
    std::string loading_name;
    SceneLoader::State loading_state;

    // A line over the picture, until a time or, for an error, until it is dismissed.
    std::string notice;
    bool notice_is_error = false;
    double notice_until_s = 0;

    bool has_scene() const { return job.world != nullptr; }
};

// What there is to be edited, as it is now.
Editable editable_of(const ViewerModel& model);

// What a panel has changed.
struct PanelEdits {
    bool view = false;         // the camera
    bool settings = false;     // how it is rendered: restarts
    bool environment = false;  // a new world off-thread
    std::optional<std::string> environment_file;
    bool tone = false;                    // only drawn anew
    bool style = false;                   // of the panels
    bool map = false;                     // another map, or none
    bool denoise = false;                 // on or off
    bool scene_edited = false;            // materials or lights: a new world off-thread
    std::optional<Editable> before_edit;  // where an edit begins: what there was
    bool compare = false;                 // on or off
    bool compared = false;                // with other settings
    bool metric = false;                  // another measure of the distance to the reference
    bool toggle_pause = false;
    bool light_groups = false;                              // samples are to be kept apart by their lights: restarts
    bool frame_time = false;                                // when young pictures are shown
    std::optional<std::vector<LightWeight>> light_weights;  // only weighed anew
    std::optional<size_t> store_bookmark, recall_bookmark;
    int step_view = 0;         // -1: back, 1: on
    bool open_dialog = false;  // for a scene or an environment
    bool reference_dialog = false;
    std::optional<std::string> open_recent;  // scene
    bool copy_view = false;
    std::optional<SequenceSettings> write_sequence;
    bool stop_sequence = false;
    bool frame_all = false;
    bool toggle_play = false;
    std::optional<double> seek_s;                    // on the timeline
    std::optional<uint32_t> animation;               // of the file
    std::optional<uint32_t> camera;                  // of the file
    std::optional<uint32_t> scene;                   // of the file
    std::optional<std::optional<uint32_t>> variant;  // of the file; none inside: each primitive's own material
    std::optional<size_t> validation_scene;          // in validation_scenes()
};

// "HotelRoom.glb"; with its folder where the name alone says nothing, as in "HotelRoom/scene.glb".
inline std::string file_name(const std::string& path) {
    const std::filesystem::path file(path);
    const std::string folder = file.parent_path().filename().string();
    return file.stem() == "scene" && !folder.empty() ? folder + "/" + file.filename().string()
                                                     : file.filename().string();
}

}  // namespace candela
