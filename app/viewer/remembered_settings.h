// SPDX-License-Identifier: MIT
// What the window remembers from one session to the next: a JSON file in the person's configuration folder. Only the
// window reads and writes it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/theme.h"
#include "renderer/image/tone.h"
#include "renderer/math/math.h"

namespace candela {

struct RememberedSettings {
    ToneSettings tone;
    UiStyle style;
    bool panels = false, statistics = false;  // shown
    std::optional<Vec2u> window;              // its size, in the units of the screen
    std::vector<std::string> recent;          // scenes, whole paths, the last opened first
};

// $XDG_CONFIG_HOME/candela/settings.json, without the variable ~/.config/…; empty: there is no such place.
std::filesystem::path settings_path();

// The defaults where there is no file, and where there is one that is not what it should be: then warning is a line
// that says why.
RememberedSettings read_settings(const std::filesystem::path& path, std::string& warning);
// Written beside and renamed; makes the folder. Throws CommandError.
void write_settings(const std::filesystem::path& path, const RememberedSettings& settings);

// What was stored, but for what is no longer as it was at the beginning: so that neither an option of the command line
// nor another window's change is taken for the person's wish. Recent files are those of stored.
RememberedSettings with_changes(const RememberedSettings& stored, const RememberedSettings& at_start,
                                const RememberedSettings& now);
// Puts the scene first.
void add_recent(std::vector<std::string>& recent, const std::string& scene);

// As options of the command line, without what is at its default, the window's size and recent files.
std::vector<std::string> words_of(const RememberedSettings& settings);

}  // namespace candela
