// SPDX-License-Identifier: MIT
// The desktop's own dialog that asks for a file: zenity's or kdialog's, whichever there is, beside the window.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/viewer/background_task.h"

namespace candela {

enum class DialogPurpose : uint8_t { scene, reference };

// The program and its words; empty: there is neither zenity nor kdialog in that PATH. The desktop's own comes first.
std::vector<std::string> dialog_command(DialogPurpose purpose, const std::string& folder, const char* path,
                                        const char* desktop);

class FileDialog {
  public:
    // Returns false where there is no program for it. While one is open nothing happens.
    bool open(DialogPurpose purpose, const std::string& folder);
    bool is_open() const { return task_.busy(); }
    DialogPurpose purpose() const { return purpose_; }
    // The file that was chosen, once; nothing while the person chooses, or where they chose none.
    std::optional<std::string> take() { return task_.take(); }

  private:
    DialogPurpose purpose_ = DialogPurpose::scene;
    BackgroundTask<std::string> task_;
};

}  // namespace candela
