// SPDX-License-Identifier: MIT
#include "app/viewer/viewer.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "app/picture_file.h"
#include "app/viewer/panels.h"
#include "app/viewer/steady_figures.h"
#include "renderer/integrator/aov.h"

namespace candela {

namespace {

constexpr double notice_seconds = 4;
constexpr double progress_seconds = 0.05;
// The first picture of an edit is expected within so many frames' times; to draw the old one again before it would only
// delay it.
constexpr double first_frame_times = 1.5;
// Of a picture that nobody wants more of, in its mean.
constexpr double invisible_error = 0.001;
// How near to the line of the wipe the pointer grips it.
constexpr float wipe_grip_points = 8;

}  // namespace

Viewer::Viewer(const RenderOptions& options, const GlContext& context, const ViewerOptions& viewer_options)
    : context_(context), viewer_options_(viewer_options), display_(context) {
    model_.options = options;
    model_.display.tone = options.tone;
    model_.style = options.style;
    model_.show_interface = viewer_options.interface;
    model_.map = {options.map || options.metric, options.map.value_or(PixelMap::error), options.wipe, options.metric};
    for (const std::string& name : options.open) {
        if (name == "panels") model_.show_panels = true;
        if (name == "statistics") model_.show_statistics = true;
        if (name == "help") model_.show_help = true;
    }
    size_.pixels = context.framebuffer_extent();
    size_.points = Vec2(size_.pixels);
    if (viewer_options.interface) ui_ = std::make_unique<Ui>(context, model_.style);
    SessionOptions session_options;
    session_options.threads = options.threads;
    session_options.frame_seconds = 1e-3 * options.frame_time_ms;
    session_options.kept_bytes = options.limit_views_bytes;
    session_options.reproject = true;
    // How long a view was rendered is chance.
    if (viewer_options.steady_figures) session_options.keep_after_seconds = std::numeric_limits<double>::infinity();
    session_ = std::make_unique<RenderSession>(session_options);
    session_->show_maps(model_.map.shown);
    denoised_ = std::make_unique<DenoisedPreview>(*session_);
    model_.denoises = options.denoise;
    wanted_inspection_ = options.inspect;
    if (!options.reference.empty()) load_reference(options.reference);
    if (!options.compared.empty()) {
        std::string unknown;
        model_.comparison.settings = compared_settings(options.integrator, options.compared, &unknown);
        show_comparison(true);
    }
    model_.lights.on = options.light_groups;
    if (!options.scene.empty()) start_load(options, false);
}

Viewer::~Viewer() = default;

double Viewer::now_s() const {
    if (viewer_options_.now_s) return viewer_options_.now_s();
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void Viewer::notify(std::string line, bool is_error) {
    model_.notice = std::move(line);
    model_.notice_is_error = is_error;
    model_.notice_until_s = is_error ? std::numeric_limits<double>::infinity() : now_s() + notice_seconds;
    redraws_ = 2;
}

float Viewer::aspect() const {
    return static_cast<float>(size_.pixels.x) / static_cast<float>(std::max(size_.pixels.y, 1u));
}

// What the command line said of one file says nothing of another.
RenderOptions Viewer::options_for(const std::string& path) const {
    RenderOptions options = model_.options;
    options.scene = path;
    options.camera.clear();
    options.eye = options.target = options.up = std::nullopt;
    options.projection.reset();
    options.scene_index.reset();
    options.variant.clear();
    options.animation.clear();
    options.at_seconds.reset();
    return options;
}

void Viewer::open(const std::string& path) {
    start_load(options_for(path), false);
}

void Viewer::open_validation_scene(size_t index) {
    const ValidationScene& scene = validation_scenes()[index];
    RenderOptions options = options_for((assets_folder() / "validation" / scene.name).string());
    options.hdri.clear();
    options.hdri_intensity = 1;
    options.sky = Vec3(scene.sky.value_or(0.0f));
    start_load(options, false);
}

void Viewer::start_load(RenderOptions options, bool keep_view, bool is_step, std::optional<Editable> restored) {
    options.resolution = size_.pixels;
    restored_ = std::move(restored);
    load_is_step_ = is_step;
    wanted_variant_.reset();
    load_keeps_view_ = keep_view;
    load_is_ = LoadKind::scene;
    environment_dirty_ = false;
    load_error_.clear();
    model_.loading = true;
    model_.loading_name = file_name(options.scene);
    load_is_previewed_ = false;
    // A scene that is read again looks better as it is than without its pictures.
    const bool previews = viewer_options_.previews && !keep_view && !restored_;
    loader_.start([options, previews, prepare = viewer_options_.prepare](const SceneLoader::Progress& progress,
                                                                         const SceneLoader::ShowPreview& show,
                                                                         const std::atomic<bool>* cancel) {
        std::function<void(RenderJob)> preview;
        if (previews) preview = [&](RenderJob job) { show({options, std::move(job)}); };
        return LoadedScene{options, prepare(options, progress, cancel, preview)};
    });
}

// A dropped environment is read first, one that is turned or scaled only placed anew.
void Viewer::start_environment_change() {
    const std::string read_from = std::exchange(dropped_environment_, {});
    RenderOptions options = model_.options;
    if (!read_from.empty()) {
        options.hdri = read_from;
        options.sky.reset();
        model_.loading = true;
        model_.loading_name = file_name(read_from);
    }
    environment_dirty_ = false;
    load_is_ = LoadKind::environment;
    load_is_step_ = !read_from.empty();
    loader_.start([options, job = model_.job, read = !read_from.empty()](const SceneLoader::Progress& progress,
                                                                         const SceneLoader::ShowPreview&,
                                                                         const std::atomic<bool>*) {
        LoadedScene out{options, job};
        progress("environment", 0);
        if (read) out.job.environment = read_environment(options);
        out.job.world = with_environment(job.world, out.job.environment, options);
        return out;
    });
}

// The scene stays in memory: only which material each primitive has changes.
void Viewer::start_variant_change(std::optional<uint32_t> variant, bool is_step) {
    RenderOptions options = model_.options;
    const Scene& scene = *model_.job.world->scene;
    options.variant = variant ? scene.variant_names[*variant] : std::string();
    // Of a scene that is not all there nothing could be kept.
    if (before_preview_) {
        start_load(options, true, is_step);
        return;
    }
    load_is_step_ = is_step;
    load_keeps_view_ = true;
    load_is_ = LoadKind::variant;
    environment_dirty_ = false;
    model_.loading = true;
    model_.loading_name = variant ? options.variant : "the file's own materials";
    loader_.start([options, variant, job = model_.job](const SceneLoader::Progress& progress,
                                                       const SceneLoader::ShowPreview&,
                                                       const std::atomic<bool>* cancel) {
        LoadedScene out{options, job};
        progress("variant", 0);
        show_variant(out.job, variant, cancel);
        return out;
    });
}

// A scene whose pictures are still to come is shown as the scene; what was before waits.
void Viewer::take_preview() {
    if (load_is_ != LoadKind::scene) return;
    std::optional<LoadedScene> preview = loader_.take_preview();
    if (!preview) return;
    if (!before_preview_) {
        before_preview_ = Shown{model_.options, model_.job,       model_.view,  model_.playback,
                                shown_pose_,    followed_camera_, next_camera_, model_.bookmarks};
    }
    show_scene(std::move(*preview));
    load_is_previewed_ = true;
}

void Viewer::bring_back() {
    if (load_is_step_) history_.forget_last();
    Shown shown = std::move(*before_preview_);
    before_preview_.reset();
    load_is_previewed_ = false;
    model_.options = std::move(shown.options);
    model_.job = std::move(shown.job);
    model_.view = shown.view;
    model_.playback = shown.playback;
    shown_pose_ = shown.pose;
    followed_camera_ = shown.followed_camera;
    next_camera_ = shown.next_camera;
    model_.bookmarks = shown.bookmarks;
    pose_epoch_ = 0;
    dirty_ = true;
    if (model_.has_scene()) {
        adopt_scene();
        return;
    }
    // There was nothing.
    session_->stop();
    frame_ = nullptr;
    model_.status = {};
    display_.clear();
}

void Viewer::take_loaded() {
    // A pose waits until the one before has been seen.
    if (loads_taken_ >= loads_allowed_ || (load_is_ == LoadKind::pose && !pose_was_seen())) return;
    std::optional<SceneLoader::Result> result = loader_.take();
    if (!result) return;
    ++loads_taken_;
    model_.loading = false;
    if (!result->scene) {
        load_error_ = result->error;
        load_status_ = result->status;
        notify(result->error, true);
        if (load_is_ == LoadKind::pose) {
            model_.playback.playing = false;
            shown_pose_ = making_pose_;
        }
        if (before_preview_ && load_is_ == LoadKind::scene) bring_back();
        restored_.reset();
        return;
    }
    RenderJob& job = result->scene->job;
    if (load_is_ == LoadKind::pose) {
        take_pose(job);
        return;
    }
    redraws_ = 2;
    if (load_is_ == LoadKind::edit) {
        take_edit(job);
        return;
    }
    if (load_is_ == LoadKind::environment) {
        take_environment(*result->scene);
        return;
    }

    if (load_is_previewed_) {
        // What the person has done since the preview stays.
        model_.job = std::move(job);
        adopt_scene();
        dirty_ = true;
    } else {
        show_scene(std::move(*result->scene));
    }
    before_preview_.reset();
    load_is_previewed_ = false;
}

// A new scene: its camera unless the person's view is to stay. The pivot is what the middle of the picture shows.
void Viewer::show_scene(LoadedScene loaded) {
    redraws_ = 2;
    const bool keeps_history = load_keeps_view_ || load_is_step_ || restored_;
    if (load_is_step_) add_step(editable_with(model_.view));
    const bool is_other_file = loaded.job.scene_path != model_.job.scene_path;
    model_.options = std::move(loaded.options);
    model_.job = std::move(loaded.job);
    if (!load_keeps_view_) {
        const Camera& camera = model_.job.request.view.camera;
        const World& world = *model_.job.world;
        model_.view = view_of(camera, world.bounds);
        const bool framed = !model_.options.eye && model_.options.camera.empty() && world.scene->cameras.empty();
        if (framed) {
            model_.view.pivot = world.bounds.center();
        } else if (model_.options.target) {
            model_.view.pivot = *model_.options.target;
        } else if (const std::optional<Vec3> middle = pick(Vec2(0.5f))) {
            model_.view.pivot = *middle;
        }
        forget_views(is_other_file);
        next_camera_ = world.scene->cameras.empty() ? 0 : 1;
        followed_camera_.reset();
        for (uint32_t i = 0; i < world.scene->cameras.size(); ++i) {
            if (world.scene->cameras[i].camera.world_from_camera == camera.world_from_camera) followed_camera_ = i;
        }
    }
    if (keeps_history) {
        adopt_scene();
    } else {
        forget_edits();
    }
    if (restored_) {
        Editable there = std::move(*std::exchange(restored_, std::nullopt));
        there.scene = true;
        restore(std::move(there));
    }
    if (load_is_ == LoadKind::scene) start_playback();
    if (model_.notice_is_error) model_.notice.clear();
    dirty_ = true;
}

void Viewer::take_environment(const LoadedScene& loaded) {
    if (load_is_step_) add_step(editable_with(model_.view));
    model_.job.world = loaded.job.world;
    model_.job.environment = loaded.job.environment;
    model_.options.hdri = loaded.options.hdri;
    model_.options.sky = loaded.options.sky;
    dirty_ = true;
}

// The picture has to be rendered anew, since someone changed it.
void Viewer::edit() {
    dirty_ = true;
    if (!edited_s_) edited_s_ = now_s();
}

void Viewer::submit() {
    dirty_ = false;
    if (!model_.has_scene() || size_.pixels.x == 0 || size_.pixels.y == 0) return;
    RenderRequest& request = model_.job.request;
    request.world = model_.job.world;
    request.view.camera = model_.view.camera;
    request.view.extent = glm::min(size_.pixels, Vec2u(65535));
    request.settings = model_.options.integrator;
    // A window goes on until the person has seen enough.
    const RenderOptions& options = model_.options;
    if (!options.spp && viewer_options_.interface) request.max_spp = std::numeric_limits<uint32_t>::max();
    // No screen shows a smaller error than this.
    if (!options.spp && !options.seconds && !options.until_error_percent && viewer_options_.interface)
        request.until_relative_error = invisible_error;
    request.bookmarked = is_bookmarked(model_.view);
    // A preview leaves the cores to the pictures that it waits for.
    if (before_preview_) request.max_spp = 1;
    // Two settings that are compared have had the same time.
    request.resumes = !model_.comparison.shown;
    weigh_lights();
    request.light_groups = model_.lights.on ? model_.lights.groups : nullptr;
    remember_view();
    const uint64_t epoch = session_->submit(request);
    if (edited_s_) latency_.submitted(epoch, *std::exchange(edited_s_, std::nullopt));
    submit_other();
    renew_inspection();
    if (pose_epoch_ == 0) pose_epoch_ = epoch;
    if (hold_until_s_ < now_s()) hold_until_s_ = now_s() + first_frame_times * 1e-3 * options.frame_time_ms;
}

void Viewer::take_frame() {
    if (!model_.has_scene()) return;
    const bool was_done = model_.status.done;
    model_.status = session_->status();
    if (viewer_options_.steady_figures) make_steady(model_.status);
    if (model_.status.done && !was_done) redraws_ = std::max(redraws_, 1);
    if (!model_.status.error.empty() && model_.notice != model_.status.error) notify(model_.status.error, true);
    frame_ = session_->latest();
    if (frame_ == nullptr) return;
    update_denoised();
    const DenoisedPicture* denoised = shown_denoised();
    model_.denoised_spp.reset();
    if (denoised != nullptr) model_.denoised_spp = denoised->spp;
    if (!display_.upload(*frame_, {denoised != nullptr ? &denoised->image : nullptr, denoised_serial_})) return;
    model_.frame_epoch = frame_->epoch;
    model_.frame_serial = frame_->serial;
    model_.is_reprojected = frame_->is_reprojected;
    model_.film = frame_->statistics;
    model_.history = viewer_options_.steady_figures ? steady(frame_->history) : frame_->history;
    model_.frame_extent = {frame_->image.width(), frame_->image.height()};
    hold_until_s_ = 0;
    redraws_ = std::max(redraws_, 1);
    update_map();
}

void Viewer::show_map(const MapView& view) {
    model_.map = view;
    session_->show_maps(view.shown || model_.inspection);
    if (view.shown && model_.comparison.shown) show_comparison(false);
    update_map();
}

// What the display and the panels need to know of the map that is shown.
void Viewer::update_map() {
    redraws_ = std::max(redraws_, 1);
    model_.display.map.reset();
    if (model_.map.shown && frame_ != nullptr) {
        model_.map_scale = model_.map.metric ? scale_of(*model_.map.metric) : scale_of(model_.map.map, frame_->maps);
        model_.display.map = DisplayedMap{model_.map.map, model_.map_scale, model_.map.wipe, model_.map.metric};
    }
    place_other_picture();
}

bool Viewer::map_is_missing() const {
    return model_.map.shown && frame_ != nullptr && frame_->maps.empty() && model_.status.error.empty();
}

// Where the frame that is shown stands in the window.
void Viewer::place_picture() {
    const FitRectangle fit = fit_rectangle(model_.frame_extent, size_.pixels);
    const float points_per_pixel = size_.points.x / static_cast<float>(std::max(size_.pixels.x, 1u));
    model_.picture_left = static_cast<float>(fit.x) * points_per_pixel;
    model_.picture_width = static_cast<float>(fit.width) * points_per_pixel;
}

bool Viewer::wipe_is_at_cursor() const {
    const std::optional<float> x = wipe_x(model_);
    return x && ui_ != nullptr && std::abs(cursor_.x - *x) <= wipe_grip_points;
}

bool Viewer::update() {
    tick();
    take_preview();
    take_loaded();
    if (environment_dirty_ && !loader_.busy() && model_.has_scene()) start_environment_change();
    if (wanted_variant_ && !loader_.busy() && !scene_dirty_ && model_.has_scene())
        start_variant_change(*std::exchange(wanted_variant_, std::nullopt), false);
    if (!loader_.busy() && pose_is_wanted()) start_pose();
    if (scene_dirty_ && !loader_.busy() && !before_preview_ && model_.has_scene()) start_scene_edit();
    if (dirty_) submit();
    take_frame();
    take_other_frame();
    update_reference();
    update_inspection();
    update_sequence();

    // Progress moves and notices go away by themselves.
    const double now = now_s();
    if (model_.loading && now - last_progress_s_ > progress_seconds) {
        model_.loading_state = loader_.state();
        last_progress_s_ = now;
        redraws_ = std::max(redraws_, 1);
    }
    if (!model_.notice.empty() && now > model_.notice_until_s) {
        model_.notice.clear();
        redraws_ = 1;
    }
    return redraws_ > 0 && now >= hold_until_s_;
}

void Viewer::draw() {
    redraws_ = std::max(redraws_ - 1, 0);
    display_.draw(model_.display);
    if (ui_ == nullptr) return;
    ui_->begin_frame(now_s());
    PanelEdits edits;
    if (model_.show_interface) {
        draw_status_line(model_);
        if (model_.loading) draw_loading_bar(model_);
        if (!model_.has_scene() && !model_.loading) draw_welcome(model_);
        const PanelArea statistics = model_.show_statistics ? draw_statistics(model_) : PanelArea{};
        place_picture();
        draw_wipe(model_);
        draw_badge(model_);
        draw_path(model_);
        TakenAreas taken{statistics};
        if (model_.has_scene()) {
            const std::vector<ValidationReading> readings =
                read_validation(model_.job.scene_path, *model_.job.world, model_.job.request.view, frame_);
            taken[1] = draw_validation(model_, readings);
            taken[2] = draw_legend(model_, !readings.empty());
        }
        const PanelArea before = std::exchange(pixel_panel_, draw_pixel_panel(model_, taken, pixel_panel_));
        // Of another size it may belong elsewhere.
        if (before != pixel_panel_) redraws_ = std::max(redraws_, 1);
        if (model_.show_panels) edits = draw_side_panel(model_);
        if (timeline_is_shown(model_)) draw_timeline(model_, edits);
        if (model_.show_help) draw_help();
        if (!model_.notice.empty() && draw_notice(model_, statistics)) {
            model_.notice.clear();
            redraws_ = 2;
        }
    }
    ui_->end_frame_and_draw();
    if (std::optional<std::string> copied = ui_->take_copied()) requests_.copied = std::move(copied);
    apply(edits);
}

void Viewer::apply(const PanelEdits& edits) {
    if (edits.view || edits.settings) edit();
    if (edits.light_groups) {
        model_.lights.on = true;
        edit();
    }
    if (edits.light_weights) {
        model_.lights.weights = *edits.light_weights;
        weigh_lights();
    }
    if (edits.style && ui_ != nullptr) ui_->set_style(model_.style);
    if (edits.frame_time) session_->set_frame_seconds(1e-3 * model_.options.frame_time_ms);
    if (edits.store_bookmark) store_bookmark(*edits.store_bookmark);
    if (edits.recall_bookmark) recall_bookmark(*edits.recall_bookmark);
    if (edits.step_view != 0) step_view(edits.step_view);
    if (edits.before_edit) {
        Editable before = *edits.before_edit;
        if (!environment_is_made()) before.world = nullptr;
        add_step(std::move(before));
    }
    if (edits.scene_edited) scene_dirty_ = true;
    if (edits.environment_file) dropped_environment_ = *edits.environment_file;
    if (edits.environment || edits.environment_file) environment_dirty_ = true;
    if (edits.toggle_pause) toggle_pause();
    if (edits.toggle_play) toggle_play();
    if (edits.animation) choose_animation_shown(*edits.animation);
    if (edits.seek_s) {
        model_.playback.playing = false;
        if (!model_.playback.animation) model_.playback.animation = 0;
        seek(*edits.seek_s);
    }
    if (edits.map) show_map(model_.map);
    if (edits.denoise) toggle_denoise();
    if (edits.compare) toggle_comparison();
    if (edits.compared) dirty_ = true;
    if (edits.metric) show_map(model_.map);
    if (edits.open_dialog) ask_for_file(DialogPurpose::scene);
    if (edits.reference_dialog) ask_for_file(DialogPurpose::reference);
    if (edits.open_recent && viewer_options_.touches_files) requests_.open = edits.open_recent;
    if (edits.copy_view) copy_view();
    if (edits.write_sequence) write_sequence(*edits.write_sequence);
    if (edits.stop_sequence) writer_.stop();
    if (edits.frame_all) frame_everything();
    if (edits.camera) {
        add_step(editable_with(model_.view));
        show_file_camera(*edits.camera);
    }
    if (edits.scene) {
        RenderOptions options = model_.options;
        options.scene = model_.job.scene_path;
        options.scene_index = edits.scene;
        start_load(options, false, true);
    }
    if (edits.variant) start_variant_change(*edits.variant, true);
    if (edits.validation_scene) open_validation_scene(*edits.validation_scene);
    if (edits.view || edits.settings || edits.environment || edits.tone || edits.style || edits.map ||
        edits.toggle_pause)
        redraws_ = 2;
}

bool Viewer::finished() const {
    if (loader_.busy() || dirty_ || scene_dirty_ || environment_dirty_ || wanted_variant_ || pose_is_wanted())
        return false;
    if (map_is_missing() || weighing_is_missing()) return false;
    if (model_.denoises && model_.has_scene() && !denoised_->is_last(model_.status)) return false;
    if (reference_is_missing() || inspection_is_missing()) return false;
    if (model_.comparison.shown && model_.has_scene() && !model_.comparison.status.done) return false;
    return !model_.has_scene() || model_.status.done;
}

bool Viewer::finished_rendering() const {
    return !dirty_ && (!model_.has_scene() || model_.status.done || model_.status.paused);
}

uint32_t Viewer::shown_samples() const {
    if (dirty_ || !model_.has_scene() || model_.frame_epoch != model_.status.epoch) return 0;
    return model_.film.min_samples;
}

bool Viewer::clock_matters() const {
    return model_.playback.playing || flight_.moves();
}

void Viewer::show_interface(bool shown) {
    model_.show_interface = shown && ui_ != nullptr;
}

double Viewer::seconds_until_update() const {
    if (redraws_ > 0 || dirty_) return now_s() < hold_until_s_ ? 0.001 : 0;
    if (flight_.moves() || model_.playback.playing || (loader_.busy() && load_is_ == LoadKind::pose)) return 0.004;
    if (loader_.busy()) return 0.02;
    if (map_is_missing() || weighing_is_missing() || denoised_->busy() || reference_.busy() || inspection_is_missing())
        return 0.008;
    if (model_.comparison.shown && !model_.comparison.status.done && !model_.status.paused) return 0.008;
    // The picture that someone waits for is taken when it comes.
    if (latency_.waits(model_.frame_epoch)) return 0.001;
    if (model_.has_scene() && !model_.status.done && !model_.status.paused) return 0.008;
    return writer_.busy() ? 0.1 : 0.25;
}

std::string Viewer::title() const {
    return model_.has_scene() ? "candela - " + file_name(model_.job.scene_path) : "candela";
}

}  // namespace candela
