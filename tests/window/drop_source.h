// SPDX-License-Identifier: MIT
// The giving side of drag and drop.
#pragma once

#include <string>

namespace candela::test {

// Drops the file in the middle of the window by the XDND protocol, version 5; returns whether it was taken.
bool drop_file(const std::string& display_name, unsigned long window, const std::string& path);

}  // namespace candela::test
