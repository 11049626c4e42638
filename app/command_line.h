// SPDX-License-Identifier: MIT
// Parses the command line and runs the command.
#pragma once

#include <string>
#include <vector>

#include "app/options.h"

namespace candela {

// Returns the process's exit status; every failure has printed its one line on standard error.
int run_command_line(int argc, char** argv);

// What "candela view" makes of these words; of an option that stands there twice, the last counts. Throws CommandError.
RenderOptions parse_view_options(const std::vector<std::string>& words);

// "candela 0.1.0"
const char* version_line();

}  // namespace candela
