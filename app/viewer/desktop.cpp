// SPDX-License-Identifier: MIT
#include "app/viewer/desktop.h"

#include <utility>

#include "app/viewer/configuration_file.h"

namespace candela {

namespace {

RememberedSettings settings_of(const Viewer& viewer, Vec2u window_extent) {
    const ViewerModel& model = viewer.model();
    RememberedSettings out;
    out.tone = model.display.tone;
    out.style = model.style;
    out.panels = model.show_panels;
    out.statistics = model.show_statistics;
    if (window_extent.x > 0 && window_extent.y > 0) out.window = window_extent;
    return out;
}

// Those that ship with candela are found without being remembered.
bool is_own_asset(const std::string& scene) {
    try {
        std::error_code error;
        const std::filesystem::path assets = std::filesystem::weakly_canonical(assets_folder(), error),
                                    path = std::filesystem::weakly_canonical(scene, error);
        return std::mismatch(assets.begin(), assets.end(), path.begin(), path.end()).first == assets.end();
    } catch (const CommandError&) {
        return false;
    }
}

// All that the picture was read from.
std::vector<std::string> files_of(const Viewer& viewer) {
    const ViewerModel& model = viewer.model();
    std::vector<std::string> out;
    const auto add = [&](const std::string& path) {
        if (!path.empty() && std::find(out.begin(), out.end(), path) == out.end()) out.push_back(path);
    };
    add(model.has_scene() ? model.job.scene_path : model.options.scene);
    add(model.options.hdri);
    if (model.job.rest != nullptr) {
        for (const std::string& file : model.job.rest->files)
            add(file);
    }
    return out;
}

}  // namespace

Desktop::Desktop(Options options, Viewer& viewer, Vec2u window_extent)
    : options_(std::move(options)), before_(settings_of(viewer, window_extent)) {
    viewer.offer_recent(options_.remembered.recent);
    watch_files(viewer);
}

void Desktop::watch_files(const Viewer& viewer) {
    if (!options_.watch || viewer.model().loading) return;
    std::vector<std::string> files = files_of(viewer);
    if (files == watched_) return;
    files_.watch(files);
    watched_ = std::move(files);
}

void Desktop::add_events(const Viewer& viewer, double now_s, std::vector<InputEvent>& events) {
    if (const std::optional<std::string> chosen = dialog_.take())
        answered_ = FilesDropped{{*chosen}, {.shift = dialog_.purpose() == DialogPurpose::reference}};
    if (answered_) events.push_back(*std::exchange(answered_, std::nullopt));
    // What is being read now is compared when it has been read.
    if (options_.watch && !viewer.loads() && files_.changed(now_s)) events.emplace_back(SceneFileChanged{});
}

void Desktop::serve(Viewer& viewer, Vec2u window_extent) {
    const ViewerRequests requests = viewer.take_requests();
    if (requests.copied) options_.set_clipboard(*requests.copied);
    if (requests.open) answered_ = FilesDropped{{*requests.open}, {}};
    if (requests.dialog) {
        const std::string& scene = viewer.model().options.scene;
        std::error_code error;
        const std::filesystem::path folder = std::filesystem::absolute(scene, error).parent_path();
        if (!dialog_.open(*requests.dialog, folder.string()))
            viewer.tell("there is no open dialog here: install zenity or kdialog, or drop the file on the window",
                        false);
    }
    remember_scene(viewer, window_extent);
    remember_bookmarks(viewer);
    watch_files(viewer);
}

// A scene gets its bookmarks when it is first seen; what is stored after that is written at once.
void Desktop::remember_bookmarks(Viewer& viewer) {
    const ViewerModel& model = viewer.model();
    if (options_.bookmarks_file.empty() || !model.has_scene()) return;
    std::string warning;
    if (model.job.scene_path != bookmarked_scene_) {
        bookmarked_scene_ = model.job.scene_path;
        const RememberedBookmarks all = read_bookmarks(options_.bookmarks_file, warning);
        if (!warning.empty()) options_.warn(warning);
        viewer.offer_bookmarks(bookmarks_of(all, bookmark_key(bookmarked_scene_), {model.view, model.display.tone}));
        bookmarks_ = model.bookmarks;
        return;
    }
    const std::string key = bookmark_key(bookmarked_scene_);
    if (model.bookmarks == bookmarks_ || key.empty()) return;
    // Another window may have written since.
    RememberedBookmarks all = read_bookmarks(options_.bookmarks_file, warning);
    if (!warning.empty()) keep_broken(options_.bookmarks_file);
    add_changes(all, key, bookmarks_, model.bookmarks);
    bookmarks_ = model.bookmarks;
    try {
        write_bookmarks(options_.bookmarks_file, all);
    } catch (const CommandError& error) {
        options_.warn(error.what());
        options_.bookmarks_file.clear();
    }
}

// As soon as it is open, so that it is remembered whatever happens next.
void Desktop::remember_scene(Viewer& viewer, Vec2u window_extent) {
    const ViewerModel& model = viewer.model();
    if (!model.has_scene() || model.loading || model.job.scene_path == shown_scene_) return;
    shown_scene_ = model.job.scene_path;
    if (is_own_asset(shown_scene_)) return;
    opened_.push_back(shown_scene_);
    add_recent(options_.remembered.recent, shown_scene_);
    viewer.offer_recent(options_.remembered.recent);
    remember(viewer, window_extent);
}

void Desktop::remember(const Viewer& viewer, Vec2u window_extent) {
    if (options_.settings_file.empty()) return;
    const RememberedSettings now = settings_of(viewer, window_extent);
    // Another window may have written since. What is wrong with the file was said when it was read first.
    std::string warning;
    RememberedSettings out = with_changes(read_settings(options_.settings_file, warning), before_, now);
    if (!warning.empty()) keep_broken(options_.settings_file);
    for (const std::string& scene : opened_)
        add_recent(out.recent, scene);
    try {
        write_settings(options_.settings_file, out);
    } catch (const CommandError& error) {
        options_.warn(error.what());
        options_.settings_file.clear();
    }
    opened_.clear();
    before_ = now;
}

double Desktop::longest_sleep_s() const {
    if (answered_) return 0;
    return dialog_.is_open() ? 0.05 : 1;
}

}  // namespace candela
