// SPDX-License-Identifier: MIT
// A resolved picture, as handed from the session to whoever shows or saves it.
#pragma once

#include "renderer/image/image.h"

namespace candela {

struct FilmStatistics {
    double mean_samples = 0;  // samples per pixel
    uint32_t min_samples = 0;
    uint64_t total_samples = 0;
    uint64_t non_finite = 0;
    // Estimated mean over pixels of standard error / (pixel mean + 0.1·picture mean); NaN while unknown.
    double relative_error = 0;
    double mean_luminance = 0;
};

struct Frame {
    ImageRgba32f image;   // linear radiance premultiplied by alpha
    uint64_t epoch = 0;   // which submit this belongs to
    uint64_t serial = 0;  // counts the frames of a session from 1: two frames with one serial are the same picture
    uint32_t stride = 1;  // 1 once every pixel has a sample of its own
    FilmStatistics statistics;
    double render_seconds = 0;
    uint64_t rays = 0;  // all rays traced since the submit
};

}  // namespace candela
