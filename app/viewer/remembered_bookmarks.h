// SPDX-License-Identifier: MIT
// Bookmarks of the scenes that were open, from one session to the next: a JSON file beside the settings. Only the
// window reads and writes it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/viewer/bookmarks.h"

namespace candela {

// Views of one scene as text (view_text.h), by the digit of their key.
struct SceneBookmarks {
    std::string scene;  // whole path
    std::map<size_t, std::string> views;
};
// The scene whose bookmarks were stored last comes first.
using RememberedBookmarks = std::vector<SceneBookmarks>;

inline constexpr size_t most_bookmarked_scenes = 200;

std::filesystem::path bookmarks_path();

// None where there is no file, and where there is one that is not what it should be: then warning is a line that says
// why.
RememberedBookmarks read_bookmarks(const std::filesystem::path& path, std::string& warning);
// Written beside and renamed; makes the folder. Throws CommandError.
void write_bookmarks(const std::filesystem::path& path, const RememberedBookmarks& bookmarks);

// Under which a scene's bookmarks are found; empty: under none, for the file is text.
std::string bookmark_key(const std::string& scene);
// base: what the views leave open.
Bookmarks bookmarks_of(const RememberedBookmarks& all, const std::string& key, const Bookmark& base);
// Takes those that differ from before, and puts the scene first; scenes that were changed longest ago make room.
void add_changes(RememberedBookmarks& all, const std::string& key, const Bookmarks& before, const Bookmarks& now);

}  // namespace candela
