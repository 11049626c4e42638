// SPDX-License-Identifier: MIT
// Files in the person's configuration folder: read with care, written whole or not at all.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace candela {

// What is wrong with such a file.
struct BrokenFile {
    std::string why;
};

// $XDG_CONFIG_HOME/candela/NAME, without the variable ~/.config/…; empty: there is no such place.
std::filesystem::path configuration_path(const char* name);

// None where there is no file. Throws BrokenFile where it is none, cannot be read, or is larger than that.
std::optional<std::string> read_configuration(const std::filesystem::path& path, size_t most_bytes);
// Written beside and renamed; makes the folder. what: "the settings". Throws CommandError.
void write_configuration(const std::filesystem::path& path, const std::string& text, const char* what);

// Before another is written over a file that is broken: it goes on as NAME.broken, for there may be work in it.
void keep_broken(const std::filesystem::path& path);
// A line that says of the file what is wrong with it.
std::string words_of(const std::filesystem::path& path, const BrokenFile& broken);

// JSON holds nothing else.
bool is_utf8(const std::string& text);

}  // namespace candela
