// SPDX-License-Identifier: MIT
// The JSON record of a run that --stats writes.
#pragma once

#include "app/options.h"
#include "app/render_job.h"

namespace candela {

struct RunRecord {
    const RenderOptions* options = nullptr;
    const RenderJob* job = nullptr;
    SessionStatus status;
    const Frame* frame = nullptr;
    double write_seconds = 0;
    double first_frame_seconds = 0;  // from the start of the program to the first frame
    // Of several pictures: how many there are, and the samples of all but the last, to which frame belongs.
    std::optional<uint32_t> pictures = std::nullopt;
    uint64_t earlier_samples = 0;
};

// Every key of the contract, one object, indented.
std::string statistics_json(const RunRecord& record);
// Where --stats asks for it; nothing without. Throws CommandError.
void write_statistics(const RunRecord& record);

}  // namespace candela
