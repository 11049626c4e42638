// SPDX-License-Identifier: MIT
// A view as text, for clipboards and notes: options of the command line, which takes the same text.
//
//     --eye 278,273,-800 --target 278,273,-799 --up 0,1,0 --fov 39.3 --exposure 0.5 --tonemap neutral
#pragma once

#include <optional>
#include <string>

#include "app/viewer/bookmarks.h"

namespace candela {

std::string text_of(const Bookmark& bookmark);

// The view that the text names; lens and display are base's where it says nothing of them. None where it is no such
// text: then problem is a line that says why.
std::optional<Bookmark> view_from_text(const std::string& text, const Bookmark& base, std::string& problem);

}  // namespace candela
