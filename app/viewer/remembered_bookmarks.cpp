// SPDX-License-Identifier: MIT
#include "app/viewer/remembered_bookmarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/viewer/configuration_file.h"
#include "app/viewer/view_text.h"

namespace candela {

namespace {

using nlohmann::json;

constexpr size_t largest_file = 1 << 20;

SceneBookmarks scene_from(const json& entry) {
    if (!entry.is_object() || !entry.contains("scene") || !entry["scene"].is_string() || !entry.contains("views") ||
        !entry["views"].is_object())
        throw BrokenFile{"an entry has no scene with views"};
    SceneBookmarks out;
    out.scene = entry["scene"].get<std::string>();
    for (const auto& [digit, view] : entry["views"].items()) {
        if (digit.size() != 1 || digit[0] < '0' || digit[0] > '9') throw BrokenFile{"a view is under no digit"};
        std::string problem;
        if (!view.is_string() || !view_from_text(view.get_ref<const std::string&>(), {}, problem))
            throw BrokenFile{"what stands under " + digit + " is no view"};
        out.views[static_cast<size_t>(digit[0] - '0')] = view.get<std::string>();
    }
    return out;
}

}  // namespace

std::filesystem::path bookmarks_path() {
    return configuration_path("bookmarks.json");
}

RememberedBookmarks read_bookmarks(const std::filesystem::path& path, std::string& warning) {
    warning.clear();
    try {
        const std::optional<std::string> text = read_configuration(path, largest_file);
        if (!text) return {};
        const json document = json::parse(*text, nullptr, false);
        if (document.is_discarded()) throw BrokenFile{"it is no JSON"};
        if (!document.is_object() || !document.contains("scenes") || !document["scenes"].is_array())
            throw BrokenFile{"it lists no scenes"};
        RememberedBookmarks out;
        for (const json& entry : document["scenes"]) {
            SceneBookmarks scene = scene_from(entry);
            if (out.size() < most_bookmarked_scenes) out.push_back(std::move(scene));
        }
        return out;
    } catch (const BrokenFile& broken) {
        warning = words_of(path, broken);
        return {};
    }
}

void write_bookmarks(const std::filesystem::path& path, const RememberedBookmarks& bookmarks) {
    json scenes = json::array();
    for (const SceneBookmarks& each : bookmarks) {
        json views = json::object();
        for (const auto& [digit, view] : each.views)
            views[std::to_string(digit)] = view;
        scenes.push_back({{"scene", each.scene}, {"views", views}});
    }
    write_configuration(path, json{{"scenes", scenes}}.dump(2) + "\n", "the bookmarks");
}

std::string bookmark_key(const std::string& scene) {
    std::error_code error;
    const std::string path = std::filesystem::absolute(scene, error).lexically_normal().string();
    return error || !is_utf8(path) ? std::string() : path;
}

Bookmarks bookmarks_of(const RememberedBookmarks& all, const std::string& key, const Bookmark& base) {
    Bookmarks out;
    for (const SceneBookmarks& each : all) {
        if (each.scene != key) continue;
        for (const auto& [digit, view] : each.views) {
            std::string problem;
            out[digit] = view_from_text(view, base, problem);
        }
        break;
    }
    return out;
}

void add_changes(RememberedBookmarks& all, const std::string& key, const Bookmarks& before, const Bookmarks& now) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const SceneBookmarks& each) { return each.scene == key; });
    SceneBookmarks scene = found != all.end() ? std::move(*found) : SceneBookmarks{key, {}};
    if (found != all.end()) all.erase(found);
    for (size_t digit = 0; digit < now.size(); ++digit) {
        if (now[digit] && now[digit] != before[digit]) scene.views[digit] = text_of(*now[digit]);
    }
    all.insert(all.begin(), std::move(scene));
    if (all.size() > most_bookmarked_scenes) all.resize(most_bookmarked_scenes);
}

}  // namespace candela
