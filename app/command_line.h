// SPDX-License-Identifier: MIT
// Parses the command line and runs the command.
#pragma once

namespace candela {

// Returns the process's exit status; every failure has printed its one line on standard error.
int run_command_line(int argc, char** argv);

// "candela 0.1.0"
const char* version_line();

}  // namespace candela
