// SPDX-License-Identifier: MIT
// A session as text: what was opened and every input since, line by line, so that a person can read and write it.
//
//     candela recording 1
//     arguments assets/cornell_box.glb --spp 16     as behind "candela view"; words with spaces in "quotes"
//     window 96 72                                  pixels at the beginning
//     frame 3 at 1.25 samples 16 loads 1 drawn      one round of the window's loop: its number, the clock in seconds,
//       move 40 40                                  samples of each pixel that were shown before its events, loads that
//       press left shift                            had ended after them, and whether the panels were drawn then
//
// Blank lines and lines that begin with # say nothing. Rounds in which nothing happened are left out.
#pragma once

#include <iosfwd>

#include "app/viewer/input.h"

namespace candela {

struct RecordedFrame {
    uint64_t number = 0;
    double time_s = 0;
    uint32_t samples = 0;
    uint32_t loads = 0;
    bool drawn = false;
    std::vector<InputEvent> events;
    size_t line = 0;  // in the file
};

struct Recording {
    std::string path;
    std::vector<std::string> arguments;
    size_t arguments_line = 0;
    Vec2u window{0};
    std::vector<RecordedFrame> frames;
};

// Throws CommandError (unreadable scene) with the file, the line and what is wrong with it.
Recording read_recording(const std::string& path);
// The same from a stream; path is for messages.
Recording parse_recording(std::istream& text, const std::string& path);

// The lines before the first frame, and those of a frame.
std::string header_text(const std::vector<std::string>& arguments, Vec2u window);
std::string frame_text(const RecordedFrame& frame);

}  // namespace candela
