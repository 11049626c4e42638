// SPDX-License-Identifier: MIT
// What a viewer asks of the window that it is in. The answer comes as an input event, so that a recorded session has
// it.
#pragma once

#include <optional>
#include <string>

#include "app/viewer/file_dialog.h"

namespace candela {

struct ViewerRequests {
    std::optional<std::string> copied;    // goes to the clipboard
    std::optional<DialogPurpose> dialog;  // asks for a file, which is then dropped
    std::optional<std::string> open;      // a file that is to be dropped
};

}  // namespace candela
