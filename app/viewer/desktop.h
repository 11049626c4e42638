// SPDX-License-Identifier: MIT
// What stands between a viewer and the desktop around its window: settings that are remembered, the clipboard, the open
// dialog, files that change. What comes from there becomes input events; the viewer itself knows of none of it.
#pragma once

#include <functional>

#include "app/viewer/file_watch.h"
#include "app/viewer/remembered_bookmarks.h"
#include "app/viewer/remembered_settings.h"
#include "app/viewer/viewer.h"

namespace candela {

class Desktop {
  public:
    struct Options {
        std::filesystem::path settings_file;  // empty: nothing is remembered
        RememberedSettings remembered;        // as read from it at the start
        bool watch = false;                   // the scene's files
        std::function<void(const std::string&)> set_clipboard;
        std::function<void(const std::string&)> warn;  // a line for the person at the terminal
        std::filesystem::path bookmarks_file = {};     // empty: they end with the window
    };
    // The viewer must be as the options left it.
    Desktop(Options options, Viewer& viewer, Vec2u window_extent);

    // Appends what happened outside the window.
    void add_events(const Viewer& viewer, double now_s, std::vector<InputEvent>& events);
    // Does what the viewer asked for, and remembers what it opened.
    void serve(Viewer& viewer, Vec2u window_extent);
    // At the end: what is to be as it is now when the next window opens.
    void remember(const Viewer& viewer, Vec2u window_extent);
    // How long the loop may sleep at most.
    double longest_sleep_s() const;

  private:
    void remember_scene(Viewer& viewer, Vec2u window_extent);
    void remember_bookmarks(Viewer& viewer);
    void watch_files(const Viewer& viewer);

    Options options_;
    RememberedSettings before_;  // as the window was when it was last remembered
    std::vector<std::string> opened_;
    std::string shown_scene_;
    std::string bookmarked_scene_;  // whose bookmarks have been read
    Bookmarks bookmarks_;           // as they are in the file
    FileDialog dialog_;
    std::optional<InputEvent> answered_;
    FileWatch files_;
    std::vector<std::string> watched_;
};

}  // namespace candela
