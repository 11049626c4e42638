// SPDX-License-Identifier: MIT
// Files that are dropped, chosen, read again, or lie beside the one that is open.
#include <algorithm>

#include "app/picture_file.h"
#include "app/viewer/viewer.h"

namespace candela {

namespace {

bool is_scene_file(const std::string& path) {
    const std::string extension = extension_of(path);
    return extension == ".gltf" || extension == ".glb";
}

bool is_picture_file(const std::string& path) {
    const std::string extension = extension_of(path);
    return extension == ".hdr" || extension == ".exr" || extension == ".png";
}

bool is_environment_file(const std::string& path) {
    const std::string extension = extension_of(path);
    return extension == ".hdr" || extension == ".exr";
}

}  // namespace

void Viewer::handle_drop(const FilesDropped& event) {
    if (event.paths.empty()) return;
    const std::string& path = event.paths.front();
    if (is_scene_file(path)) {
        open(path);
    } else if (event.modifiers.shift && is_picture_file(path)) {
        load_reference(path);
    } else if (is_environment_file(path)) {
        if (!model_.has_scene()) {
            model_.options.hdri = path;
            notify(file_name(path) + " will light the next scene");
            return;
        }
        dropped_environment_ = path;
        environment_dirty_ = true;
    } else {
        notify(path + ": is none of .gltf, .glb, .hdr, .exr", true);
    }
}

void Viewer::ask_for_file(DialogPurpose purpose) {
    if (!viewer_options_.touches_files) return;
    requests_.dialog = purpose;
}

// What the person set stays, and so does the view.
void Viewer::reload() {
    if (animation() != nullptr) seek(model_.playback.time_s);
    if (!model_.options.scene.empty()) start_load(model_.options, model_.has_scene());
}

void Viewer::open_neighbour(int step) {
    if (!model_.has_scene()) return;
    const std::filesystem::path now = model_.job.scene_path;
    const std::filesystem::path folder = now.parent_path().empty() ? std::filesystem::path(".") : now.parent_path();
    std::vector<std::filesystem::path> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        if (is_scene_file(entry.path().string())) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    const auto found =
        std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.filename() == now.filename(); });
    if (found == files.end() || files.size() < 2) {
        notify("there is no other scene in this folder");
        return;
    }
    const auto count = static_cast<std::ptrdiff_t>(files.size());
    open(files[static_cast<size_t>(((found - files.begin()) + step + count) % count)].string());
}

}  // namespace candela
