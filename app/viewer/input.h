// SPDX-License-Identifier: MIT
// What a person does to the window, free of any window library: tests play the same events to an off-screen viewer.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "renderer/math/math.h"

namespace candela {

// Letters and digits are their upper-case ASCII codes, keypad digits too.
// clang-format off
enum class Key : uint16_t {
    none = 0, space = ' ', comma = ',', period = '.', left_bracket = '[', right_bracket = ']',
    digit_0 = '0', digit_1, digit_2, digit_3, digit_4, digit_5, digit_6, digit_7, digit_8, digit_9,
    a = 'A', b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z,
    escape = 256, enter, tab, backspace, delete_key, left, right, up, down, home, end, f5, f12, shift
};
// clang-format on

struct Modifiers {
    bool shift = false, ctrl = false, alt = false;
};

enum class MouseButton : uint8_t { left, right, middle };

// Positions are in points from the top left of the window; a point is a pixel unless the screen is HiDPI.
struct MouseMoved {
    Vec2 point{0};
};
struct MousePressed {
    MouseButton button = MouseButton::left;
    bool pressed = true;  // false: released
    Modifiers modifiers;
};
struct Scrolled {
    Vec2 steps{0};  // y > 0: away from the person
};
struct KeyPressed {
    Key key = Key::none;
    bool pressed = true;  // false: released; holding repeats presses
    Modifiers modifiers;
};
struct TextTyped {
    uint32_t code_point = 0;
};
// The clipboard, where the person asked for it; comes before the key that did.
struct TextPasted {
    std::string text;
};
struct FilesDropped {
    std::vector<std::string> paths;
    Modifiers modifiers;
};
struct WindowResized {
    Vec2 points{0};
    Vec2u pixels{0};
    float content_scale = 1;  // how much larger than at 96 dots per inch the person wants text, in pixels
};
// The window must be drawn again, as after another one covered it.
struct WindowExposed {};
// The scene's file, or one that it names, is another now.
struct SceneFileChanged {};
struct CloseRequested {};

using InputEvent = std::variant<MouseMoved, MousePressed, Scrolled, KeyPressed, TextTyped, TextPasted, FilesDropped,
                                WindowResized, WindowExposed, SceneFileChanged, CloseRequested>;

}  // namespace candela
