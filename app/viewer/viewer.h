// SPDX-License-Identifier: MIT
// The viewer without a window: input events in, a drawn framebuffer out. The window's loop and the off-screen commands
// and tests drive the same object.
#pragma once

#include "app/viewer/denoised_preview.h"
#include "app/viewer/flight.h"
#include "app/viewer/input.h"
#include "app/viewer/reference_picture.h"
#include "app/viewer/ui.h"
#include "app/viewer/viewer_model.h"
#include "app/viewer/viewer_requests.h"

namespace candela {

struct ViewerOptions {
    bool interface = true;          // false: nothing but the picture is ever drawn
    std::function<double()> now_s;  // a clock; empty: the steady one
    bool previews = true;           // a scene is shown without its pictures until they are decoded
    bool steady_figures = false;    // steady_figures.h
    bool touches_files = true;      // false: what would save a picture only says so
    std::function<decltype(prepare_render)> prepare = prepare_render;  // tests put their own here
};

class Viewer {
  public:
    // Starts to load options.scene (empty: nothing). The OpenGL context must be current, here and in every call, and
    // outlive the viewer. Throws GlError.
    Viewer(const RenderOptions& options, const GlContext& context, const ViewerOptions& viewer_options = {});
    ~Viewer();  // stops and joins everything
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    void handle(const InputEvent& event);
    // Takes in what loader and session have done, and submits what was edited; true where the picture should be drawn
    // again.
    bool update();
    void draw();
    // What draw drew last is before the person's eyes: ends the measuring of latencies.
    void presented();
    // What a panel has changed; draw calls it for its own.
    void apply(const PanelEdits& edits);

    // How long nothing will change without input.
    double seconds_until_update() const;
    bool wants_to_close() const { return close_; }
    // Nothing loads, and the render has met its limits or cannot.
    bool finished() const;
    // Without loading: neither goes it on by itself.
    bool finished_rendering() const;
    std::string title() const;

    // For recordings. Of each pixel of the view as it is now, in the picture that is shown.
    uint32_t shown_samples() const;
    // What the clock says changes the scene or the view.
    bool clock_matters() const;
    // How many loads of any kind have ended and were taken in; no more than allowed are.
    uint32_t loads_taken() const { return loads_taken_; }
    void allow_loads(uint32_t count) { loads_allowed_ = count; }
    bool loads() const { return loader_.busy(); }
    void show_interface(bool shown);

    // What was asked of the window since the last call.
    ViewerRequests take_requests();
    // Scenes that were open before, the last first: what the panel offers.
    void offer_recent(std::vector<std::string> scenes) { model_.recent = std::move(scenes); }
    // Of the scene that is shown, from before; those that it has stay.
    void offer_bookmarks(const Bookmarks& bookmarks);
    // Where there is nothing to show by itself: a line over the picture.
    void tell(std::string line, bool is_error) { notify(std::move(line), is_error); }

    // Opens a scene in the background; what is shown stays until there is something of it to show, and comes back after
    // a failure.
    void open(const std::string& path);
    // The same for one of validation_scenes(), under the sky that it wants.
    void open_validation_scene(size_t index);
    // Writes the true picture to the path: .png with the tone curve that is shown; throws CommandError.
    void save(const std::string& path) const;
    // The same of the denoised picture that is shown.
    void save_denoised(const std::string& path) const;

    const ViewerModel& model() const { return model_; }
    // What is shown; null before the first picture.
    const Frame* frame() const { return frame_; }
    // Why the last scene could not be opened; empty: it could, or it is not known yet.
    const std::string& load_error() const { return load_error_; }
    ExitStatus load_status() const { return load_status_; }

  private:
    enum class LoadKind : uint8_t { scene, environment, variant, pose, edit };
    // What a scene that cannot be read leaves as it was.
    struct Shown {
        RenderOptions options;
        RenderJob job;
        OrbitView view;
        Playback playback, pose;
        std::optional<uint32_t> followed_camera;
        uint32_t next_camera = 0;
        Bookmarks bookmarks;
    };
    enum class DragMode : uint8_t { none, orbit, look, pan, dolly, environment, wipe };

    RenderOptions options_for(const std::string& path) const;
    // is_step: it can be undone; restored: what is edited then.
    void start_load(RenderOptions options, bool keep_view, bool is_step = false,
                    std::optional<Editable> restored = std::nullopt);
    void start_environment_change();
    void start_variant_change(std::optional<uint32_t> variant, bool is_step);
    void take_preview();
    void take_loaded();
    void show_scene(LoadedScene loaded);
    void bring_back();
    void take_environment(const LoadedScene& loaded);
    void edit();
    void submit();
    void take_frame();
    void notify(std::string line, bool is_error = false);

    void handle_mouse_press(const MousePressed& event);
    void handle_mouse_move(const Vec2& point);
    void handle_scroll(float steps);
    void handle_key(const KeyPressed& event);
    void handle_drop(const FilesDropped& event);
    void handle_resize(const WindowResized& event);
    void handle_view_key(Key key);

    void give_keyboard(bool to_panels);
    bool is_for_panels(const KeyPressed& event);
    void toggle_flight();
    bool fly_by(const KeyPressed& event);
    void fly_for(double dt_s);
    void remember_flight();
    void end_flight();
    void copy_view();
    void paste_view(const std::string& text);
    void ask_for_file(DialogPurpose purpose);
    void reload();
    void write_sequence(const SequenceSettings& settings);
    void update_sequence();

    bool is_bookmarked(const OrbitView& view) const;
    void store_bookmark(size_t digit);
    void recall_bookmark(size_t digit);
    void step_view(int by);
    void remember_view();
    void forget_views(bool bookmarks_too);

    void set_view(const OrbitView& view);
    void show_file_camera(uint32_t index);
    void frame_everything();
    void change_exposure(float ev);
    void open_neighbour(int step);
    void save_next(bool denoised);
    void toggle_denoise();
    void update_denoised();
    const DenoisedPicture* shown_denoised() const;  // null: the true picture is shown
    void save_image(const std::string& path, const Frame& frame, bool denoised) const;
    void toggle_background();
    void toggle_pause();
    Editable editable_with(const OrbitView& view) const;
    bool environment_is_made() const;  // it is that of the options
    enum class StepKind : uint8_t { single, exposure };
    void add_step(Editable before, StepKind kind = StepKind::single);
    void restore(Editable there);
    void restore_environment(const Editable& there);
    void adopt_scene();
    void forget_edits();
    void undo_edit(bool redo);
    void start_scene_edit();
    void take_edit(const RenderJob& edited);
    void inspect_at(const Vec2& point);
    void begin_inspection(Vec2u pixel);
    void end_inspection();
    void renew_inspection();
    void update_inspection();
    bool inspection_is_missing() const;  // something of the pixel under the glass is not known yet
    void show_comparison(bool shown);
    void toggle_comparison();
    void submit_other();
    void take_other_frame();
    void load_reference(const std::string& path);
    void step_metric();
    void update_reference();
    bool reference_is_missing() const;  // its reading is of another picture than the one that is shown
    void place_other_picture();
    void hold_reference(bool held);
    void show_map(const MapView& view);
    void update_map();
    void weigh_lights();
    bool weighing_is_missing() const;  // the lights of the frame that is shown are not those asked for
    bool map_is_missing() const;       // asked for, and not in the frame that is shown
    void place_picture();
    bool wipe_is_at_cursor() const;
    void set_focus_at_cursor();

    // The animation that is shown; null: none is.
    const Animation* animation() const;
    bool has_animation();  // says so where there is none
    double wanted_pose_s() const;
    bool pose_is_wanted() const;
    bool pose_was_seen() const;
    void tick();
    void start_playback();
    void start_pose();
    void take_pose(const RenderJob& posed);
    void follow_file_camera();
    void toggle_play();
    void step_animation(int frames);
    void choose_animation_shown(uint32_t index);
    void seek(double time_s);

    float aspect() const;
    Vec2 film_uv_of(const Vec2& point) const;
    std::optional<Vec3> pick(const Vec2& film_uv) const;
    double now_s() const;

    const GlContext& context_;
    ViewerOptions viewer_options_;
    ViewerModel model_;
    Display display_;
    std::unique_ptr<Ui> ui_;
    std::unique_ptr<RenderSession> session_;
    std::unique_ptr<RenderSession> other_session_;  // of the comparison
    const Frame* other_frame_ = nullptr;
    EditHistory history_;
    bool scene_dirty_ = false;  // materials or lights have to be compiled
    OrbitView view_before_drag_, view_before_flight_;
    std::optional<Editable> before_turn_;  // of the environment, which is being dragged
    StepKind last_step_ = StepKind::single;
    double last_step_s_ = 0;
    bool load_is_step_ = false;         // of the history, once it is there
    std::optional<Editable> restored_;  // once its scene is there
    std::optional<std::optional<uint32_t>> wanted_variant_;
    OrbitView scrolled_view_;  // by the wheel, at last_scroll_s_
    double last_scroll_s_ = 0;
    Flight flight_;
    FrameWriter writer_;
    ViewerRequests requests_;
    ReferencePicture reference_;
    BackgroundTask<PixelLedger> search_;
    uint32_t searched_samples_ = 0;
    PanelArea pixel_panel_;                   // in the frame before
    std::optional<Vec2u> wanted_inspection_;  // once there is a scene
    uint64_t search_epoch_ = 0;
    Vec2 press_{0};                       // where the last button went down
    bool reference_is_uploaded_ = false;  // in place of other_frame_
    std::unique_ptr<DenoisedPreview> denoised_;
    uint64_t denoised_serial_ = 0;
    SceneLoader loader_;
    LoadKind load_is_ = LoadKind::scene;
    bool load_keeps_view_ = false, environment_dirty_ = false;
    uint32_t loads_taken_ = 0, loads_allowed_ = std::numeric_limits<uint32_t>::max();
    // While a preview is shown: what was before it, without a world where nothing was; and whether it is of the load
    // that runs.
    std::optional<Shown> before_preview_;
    bool load_is_previewed_ = false;
    std::string dropped_environment_;
    std::string load_error_;
    ExitStatus load_status_ = ExitStatus::done;

    WindowResized size_;
    Vec2 cursor_{0};
    DragMode drag_ = DragMode::none;
    bool is_pressed_ = false;  // a button, over the picture
    MouseButton drag_button_ = MouseButton::left;
    Vec3 drag_anchor_{0};
    double last_click_s_ = -1;
    Vec2 last_click_{0};
    uint32_t next_camera_ = 0;
    std::optional<uint32_t> followed_camera_;  // of the file, until the person moves the view

    // The pose that is shown, and the one that the loader makes.
    Playback shown_pose_, making_pose_;
    double last_tick_s_ = 0;
    uint64_t pose_epoch_ = 0;  // of the first picture of the pose that is shown; 0: not submitted yet

    uint64_t weighing_ = 0;                       // of the lights, as the session counts
    std::shared_ptr<const World> grouped_world_;  // whose lights model_.lights has
    LatencyMeter latency_;
    std::optional<double> edited_s_;  // the first input that has not been submitted
    ViewHistory view_history_;
    OrbitView submitted_view_;
    double viewed_since_s_ = 0;   // that view
    bool steps_history_ = false;  // the view that is submitted next comes from the history

    const Frame* frame_ = nullptr;
    bool dirty_ = false;  // the request has to be submitted
    int redraws_ = 2;     // panels need two frames to settle
    double hold_until_s_ = 0;
    double last_progress_s_ = 0;
    bool close_ = false;
};

}  // namespace candela
