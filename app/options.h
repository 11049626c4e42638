// SPDX-License-Identifier: MIT
// What the command line asked for, as plain values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/viewer/theme.h"
#include "renderer/film/frame.h"
#include "renderer/image/compare.h"
#include "renderer/image/tone.h"
#include "renderer/integrator/settings.h"
#include "renderer/io/load_gltf.h"
#include "renderer/scene/camera.h"

namespace candela {

// First and last, both rendered.
struct FrameRange {
    uint32_t first = 0, last = 0;
};

// Options that view, render and screenshot share.
struct RenderOptions {
    std::string scene;    // empty: the Cornell box
    std::string command;  // the whole command line, for the records
    std::optional<Vec2u> resolution;
    std::string camera;  // name or index
    std::optional<Vec3> eye, target, up;
    std::optional<float> fov_degrees;
    std::optional<float> aperture_m, focus_m;
    uint32_t blades = 0;  // of the aperture; 0: round
    std::optional<Projection> projection;
    std::optional<uint32_t> spp;
    std::optional<double> seconds;
    std::optional<double> until_error_percent;
    IntegratorSettings integrator;
    unsigned threads = 0;
    std::string hdri;
    float hdri_rotation_degrees = 0;
    float hdri_intensity = 1;
    std::optional<Vec3> sky;
    ToneSettings tone;
    UiStyle style;  // of the panels
    LoadLimits limits;
    std::optional<uint32_t> scene_index;
    std::string variant;                // empty: each primitive's own material
    std::string animation;              // name or index; empty: the first where a time is given
    std::optional<double> at_seconds;   // of the animation
    std::optional<FrameRange> frames;   // pictures of the animation, numbered
    std::optional<uint32_t> turntable;  // pictures of a turn around the scene, numbered
    double fps = 30;                    // picture k shows the time k / fps
    std::vector<std::string> aovs;
    std::optional<PixelMap> map;            // beside the picture, in the window
    std::vector<std::string> compared;      // words of compared_settings; empty: no comparison
    std::string reference;                  // a picture that is taken for the truth
    std::optional<ReferenceMetric> metric;  // shown in place of a map
    std::optional<Vec2u> inspect;           // a pixel of a screenshot
    bool denoise = false;                   // shows the denoised preview
    float wipe = 0.5f;                      // where it begins: 0 at the left edge, 1 at the right
    std::vector<std::string> open;          // panels of a screenshot
    double frame_time_ms = 1000.0 / 30;     // how often a young picture is shown anew, and how fine it begins
    bool light_groups = false;              // samples are kept apart by their lights
    uint64_t limit_views_bytes = uint64_t{512} << 20;  // for the samples of views that were left
    bool watch = false;                                // the window reads the scene anew when its files change
    std::string record;                                // file of the session; empty: it is not recorded
    std::vector<std::string> arguments;                // the command line's, as far as a recording needs them
    std::string stats_file;                            // "-": standard output
    std::string output;
    bool quiet = false;
    bool verbose = false;
};

struct InfoOptions {
    std::string scene;
    std::optional<uint32_t> scene_index;
    std::string variant;
    LoadLimits limits;
    bool json = false;
    bool verbose = false;
};

struct CompareOptions {
    std::string a, b;
    bool json = false;
    std::string output;  // the difference picture
    std::optional<double> max_rmse, max_rel_mse, max_mae, max_flip;
};

struct ValidateOptions {
    bool json = false;
    bool quiet = false;
    std::string output;  // folder of the plots
    unsigned threads = 0;
    uint32_t seed = 0;
};

}  // namespace candela
