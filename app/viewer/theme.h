// SPDX-License-Identifier: MIT
// How panels look, as the command line, the settings and the panels themselves choose it.
#pragma once

#include <array>
#include <cstdint>

namespace candela {

enum class Theme : uint8_t { dark, light };

inline const char* name_of(Theme theme) {
    return theme == Theme::dark ? "dark" : "light";
}

inline constexpr float smallest_ui_scale = 0.5f, largest_ui_scale = 4.0f;
// What the panel offers.
inline constexpr std::array<float, 8> ui_scales = {0.75f, 1.0f, 1.25f, 1.5f, 1.75f, 2.0f, 2.5f, 3.0f};

struct UiStyle {
    Theme theme = Theme::dark;
    float scale = 1;  // on top of the screen's own

    bool operator==(const UiStyle&) const = default;
};

}  // namespace candela
