// SPDX-License-Identifier: MIT
#include "app/viewer/environment_files.h"

#include <algorithm>
#include <filesystem>

#include "app/picture_file.h"
#include "app/render_job.h"

namespace candela {

std::vector<std::string> environment_files(const std::string& scene_path, const std::string& hdri) {
    constexpr size_t most = 200;
    std::vector<std::filesystem::path> folders;
    for (const std::string& path : {hdri, scene_path}) {
        if (path.empty()) continue;
        const std::filesystem::path folder = std::filesystem::path(path).parent_path();
        folders.push_back(folder.empty() ? std::filesystem::path(".") : folder);
    }
    try {
        folders.push_back(assets_folder());
    } catch (const CommandError&) {
        // Then there are those of the scene alone.
    }
    std::vector<std::string> out;
    for (const std::filesystem::path& folder : folders) {
        std::vector<std::string> here;
        std::error_code error;
        for (auto entry = std::filesystem::directory_iterator(folder, error);
             !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
            const std::string path = entry->path().string(), extension = extension_of(path);
            if (extension == ".hdr" || extension == ".exr") here.push_back(path);
        }
        std::sort(here.begin(), here.end());
        for (const std::string& path : here) {
            if (out.size() < most && std::find(out.begin(), out.end(), path) == out.end()) out.push_back(path);
        }
    }
    return out;
}

}  // namespace candela
