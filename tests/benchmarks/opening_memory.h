// SPDX-License-Identifier: MIT
// How much memory it takes to open a scene. Each opening is measured in a process of its own, since a process that has
// opened others before keeps what they have given back, and so seems to need less.
#pragma once

#include <filesystem>

namespace candela {
struct World;
}

namespace candela::bench {

struct OpeningMemory {
    double peak_bytes = 0;    // on top of what the program takes before; 0: it could not be measured
    double needed_bytes = 0;  // what the scene cannot do without
};

// film: of 1280×720, up to the first picture; otherwise until the scene is open.
OpeningMemory opening_memory(const std::filesystem::path& scene, bool film);

// The process for it: prints three numbers, the peak until it is open, that until the first picture, and what it needs.
// The exit status of the program.
int print_opening_memory(const std::filesystem::path& scene);

}  // namespace candela::bench
