// SPDX-License-Identifier: MIT
// A resolved picture, as handed from the session to whoever shows or saves it.
#pragma once

#include <vector>

#include "renderer/film/convergence.h"
#include "renderer/image/image.h"

namespace candela {

// The relative error of a pixel is |value − truth| / (truth + 0.1 · mean of the picture), of luminances: dark pixels
// count against a tenth of the picture's mean. "mean error ±0.8 %, 95 % of pixels within ±2 %" states the first two
// estimates below; --until-error and --stats mean the first.
struct FilmStatistics {
    double mean_samples = 0;  // samples per pixel
    uint32_t min_samples = 0;
    uint64_t total_samples = 0;
    uint64_t non_finite = 0;
    // Estimates of the mean over pixels of the relative error, and of the bound that 95 % of the pixels keep; NaN while
    // unknown. How they are made, and how far they hold: statistics.cpp.
    double relative_error = 0;
    double relative_error_95 = 0;
    double mean_luminance = 0;
};

// The channels of Frame::maps.
enum class PixelMap : uint8_t {
    error,    // expected relative error, pooled over 5 × 5 pixels, so that its mean is the picture's; < 0: unknown
    samples,  // finite samples
    rays,     // of all kinds, per sample
    bounces   // surfaces met, or the last miss, per sample: camera and bounce rays
};

struct Frame {
    ImageRgba32f image;  // linear radiance premultiplied by alpha
    // The same led over from the view before while samples are few: to look at, never to save or to measure.
    ImageRgba32f reprojected;
    bool is_reprojected = false;
    ImageRgba32f maps;  // one PixelMap in each channel; empty unless the session was asked for it
    const ImageRgba32f& shown() const { return is_reprojected ? reprojected : image; }
    uint64_t epoch = 0;     // which submit this belongs to
    uint64_t weighing = 0;  // which RenderSession::weigh_lights its lights are of; 0: as they are
    uint64_t serial = 0;    // counts the frames of a session from 1: two frames with one serial are the same picture
    uint32_t stride = 1;    // 1 once every pixel has a sample of its own
    FilmStatistics statistics;
    ErrorHistory history;  // of this epoch
    double render_seconds = 0;
    uint64_t rays = 0;  // all rays traced since the submit
};

}  // namespace candela
