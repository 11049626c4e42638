// SPDX-License-Identifier: MIT
// One function per command; each returns the exit status or throws CommandError.
#pragma once

#include "app/exit_status.h"
#include "app/options.h"
#include "app/viewer/remembered_settings.h"

namespace candela {

struct Recording;

// remembered: what options have taken in already, but for window and recent files.
ExitStatus run_view(const RenderOptions& options, const RememberedSettings& remembered);
ExitStatus run_screenshot(const RenderOptions& options, bool with_interface);
// The same of what a recorded session led to. options: the recording's and the command line's.
ExitStatus run_replay(const Recording& recording, const RenderOptions& options, bool with_interface);
ExitStatus run_render(const RenderOptions& options);
ExitStatus run_info(const InfoOptions& options);
ExitStatus run_compare(const CompareOptions& options);
ExitStatus run_validate(const ValidateOptions& options);

}  // namespace candela
