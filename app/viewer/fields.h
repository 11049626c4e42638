// SPDX-License-Identifier: MIT
// Fields of the side panel that ImGui has not, or not so that what they say fits into them.
#pragma once

#include <functional>
#include <string>

#include "renderer/math/math.h"

namespace candela {

// The text where it fits, else its beginning and an ellipsis; width_of(text) in the unit of width.
std::string shortened(const std::string& text, float width, const std::function<float(const std::string&)>& width_of);

// ImGui::BeginCombo whose preview is shortened rather than cut through a letter; hovered, it says all of it.
bool begin_combo(const char* label, const std::string& preview);

// Three numbers and the square that opens the picker, as wide as other fields; linear values from 0 to most (0: any).
bool color_field(const char* label, Vec3& color, float most = 1);

}  // namespace candela
