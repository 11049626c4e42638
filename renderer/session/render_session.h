// SPDX-License-Identifier: MIT
// A running render: workers that trace slices of what was last submitted, and the newest frame of it.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "renderer/film/film.h"
#include "renderer/film/frame.h"
#include "renderer/integrator/light_groups.h"

namespace candela {

// Immutable once submitted.
struct RenderRequest {
    std::shared_ptr<const World> world;
    View view;
    IntegratorSettings settings;
    // Of the world: samples are kept apart by them; null: they are not.
    std::shared_ptr<const LightGroups> light_groups = nullptr;
    uint32_t max_spp = std::numeric_limits<uint32_t>::max();       // the session idles when every pixel has this many
    double max_seconds = std::numeric_limits<double>::infinity();  // of rendering
    double until_relative_error = 0;  // 0: off; looked at after 2, 4, 6, 8, 12, … 32, 48, … samples
    bool resumes = true;              // with the samples that were kept of it; false: from the beginning
    bool bookmarked = false;          // other kept views are given up before this one
};

struct SessionStatus {
    uint64_t epoch = 0;  // of the newest submit
    uint32_t spp = 0;    // complete passes of the current epoch
    double render_seconds = 0;
    RayCounts rays;
    double rays_per_second = 0;  // recent
    bool done = false;           // the stop condition was met
    bool paused = false;
    std::string error;  // why an epoch could not be rendered (the film does not fit in memory); done is set then
    // Measured from the raising of the epoch to the moment when all workers had let go of the old one, and to the
    // publication of the first frame.
    double last_cancel_seconds = 0;
    double last_first_frame_seconds = 0;
    double last_reproject_seconds = 0;  // of which leading the view before over took that long
    uint32_t resumed_samples = 0;       // complete passes that this view had when it was submitted
    uint32_t kept_views = 0;            // others, whose samples wait
    uint64_t kept_bytes = 0;
};

using TraceFunction = decltype(&trace_batch);

struct SessionOptions {
    unsigned threads = 0;  // workers; 0: one per core
    // The longest a young picture goes without a new frame, in seconds; grows as the picture settles. The first one
    // comes in as fine a lattice as can be traced in a part of it.
    double frame_seconds = 1.0 / 30.0;
    // For the samples of views that were left: a request that decides the same samples goes on with them. 0: none.
    uint64_t kept_bytes = 0;
    double keep_after_seconds = 0.25;    // of rendering; what was left sooner is only kept where it is bookmarked
    bool reproject = false;              // frames of a moved camera are led over from the view before
    bool publish_frames = true;          // false: only the last frame is resolved (headless)
    TraceFunction trace = &trace_batch;  // tests put their own here
};

class RenderSession {
  public:
    explicit RenderSession(const SessionOptions& options = {});
    ~RenderSession();  // stops and joins
    RenderSession(const RenderSession&) = delete;
    RenderSession& operator=(const RenderSession&) = delete;

    // Replaces what is rendered; returns its epoch. Never blocks on the workers. Throws std::invalid_argument without a
    // world or for an extent outside 1..65535. Old worlds are released on the caller's or the control thread.
    uint64_t submit(RenderRequest request);
    // The newest complete frame, or null before the first. Never blocks; the pointer stays valid until the next call.
    // One reader thread.
    const Frame* latest();
    // What was submitted last counts as bookmarked.
    void bookmark_view();
    void set_frame_seconds(double seconds);
    // How bright each light group is shown, without tracing anything anew: frames and snapshots are of these lights,
    // their statistics of the lights as they are. Empty, or of another number than there are groups: as they are.
    // Returns the number that frames of these lights carry.
    uint64_t weigh_lights(std::vector<Vec3> weights);
    // Whether frames come with maps; the newest one is published again with them.
    void show_maps(bool wanted);
    void pause();
    void resume();
    // How many of its workers trace from now on (at least one; more than there are: all), so that another session has
    // cores too.
    void use_workers(unsigned count);
    SessionStatus status() const;
    // Blocks until the current epoch is done (or timeout_s passed); true when done.
    bool wait_until_done(double timeout_s = std::numeric_limits<double>::infinity());
    // A copy of the film at a quiescent point between slices (blocks for at most a slice). epoch, if not null: gets the
    // submit that it belongs to.
    Film snapshot_film(uint64_t* epoch = nullptr);
    // Ends the current epoch as it is: workers finish their batches, a last frame is published, done becomes true.
    void stop();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace candela
