// SPDX-License-Identifier: MIT
// What a RenderSession is inside: the control thread walks through epochs (epoch.cpp), resolves frames (frames.cpp) and
// takes what was asked for between slices (render_session.cpp). Only these three include this.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "renderer/session/kept_views.h"
#include "renderer/session/render_session.h"
#include "renderer/session/reprojection.h"
#include "renderer/session/triple_buffer.h"
#include "renderer/session/worker_pool.h"

namespace candela {

using Clock = std::chrono::steady_clock;

inline double seconds_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

// A worker's own tally, on cache lines of its own.
struct alignas(64) WorkerTally {
    RayCounts rays;
    uint64_t paths = 0;
    std::vector<PixelSample> samples;
    std::array<RadianceSample, max_batch> radiance;
    std::vector<Vec3> by_light;
};

// A view that later ones may be reprojected from.
struct Anchor {
    std::shared_ptr<const ViewSamples> samples;
    std::weak_ptr<const World> world;
    View view;
    IntegratorSettings settings;
    std::shared_ptr<const LightGroups> light_groups;
    GuideLattice guides;  // of every pixel
    uint32_t guided_rows = 0;

    bool serves(const RenderRequest& request) const {
        View moved = request.view;
        moved.camera = view.camera;
        return samples != nullptr && world.lock() == request.world && settings == request.settings &&
               light_groups == request.light_groups && moved == view && guided_rows == view.extent.y;
    }
};

struct RenderSession::Impl {
    explicit Impl(const SessionOptions& session_options);
    ~Impl();

    void control_loop();
    void begin_epoch(RenderRequest next, uint64_t epoch, Clock::time_point submitted);
    void leave_view();
    bool worth_keeping();
    void prepare_spare();
    void start_anew();
    void trace_slice();
    bool trace_tile(WorkerTally& tally, const std::atomic<uint64_t>* cancel);
    void trace_guides();
    void reproject(uint32_t step);
    uint32_t affordable_reprojection_step() const;
    bool finished_by_limits();
    void finish_epoch();
    void measure_film();
    void publish();
    void update_status();
    void run_rows(const RowWork& rows);
    uint32_t slice_tiles() const;

    SessionOptions options;
    KeptViews kept;  // the control thread's

    // Handed over under the mutex, looked at by the control thread between slices.
    std::mutex mutex;
    std::condition_variable wake;      // for the control thread
    std::condition_variable reported;  // for those who wait for it
    std::optional<RenderRequest> mailbox;
    Clock::time_point submitted_at;
    uint64_t newest_epoch = 0;
    bool paused = false, stop_asked = false, quit = false;
    bool republish_asked = false;
    std::vector<Vec3> weights_asked;
    uint64_t weighings_asked = 0;
    bool bookmarked = false;  // what is rendered now
    uint32_t snapshots_asked = 0, snapshots_made = 0;
    Film snapshot;
    uint64_t snapshot_epoch = 0;
    uint32_t max_spp = 0;
    double max_seconds = 0;
    SessionStatus status;

    // Workers compare this with the value they began with; a change makes them let go.
    std::atomic<uint64_t> work_token{0};
    // Whether a submit may interrupt: not before the epoch's first frame.
    std::atomic<bool> interruptible{true};
    // How many workers trace.
    std::atomic<unsigned> workers_used{std::numeric_limits<unsigned>::max()};
    // Whether frames come with maps.
    std::atomic<bool> maps_wanted{false};
    std::atomic<double> frame_seconds;

    // Owned by the control thread.
    RenderRequest request;
    uint64_t epoch = 0;
    std::vector<Vec3> weights;  // of light groups
    uint64_t weighing = 0;
    std::shared_ptr<ViewSamples> now = std::make_shared<ViewSamples>();
    Anchor anchor, own_anchor;  // the view before, and what is rendered now as one
    ImageRgba32f reprojected;   // of the anchor, for this epoch
    bool is_reprojected = false;
    uint32_t reprojected_step = 1;
    double reproject_seconds_per_point = 0;
    double reproject_seconds = 0;        // what it took last
    std::shared_ptr<ViewSamples> spare;  // for the next view, once this one is worth keeping
    bool active = false;
    double seconds_per_path = 0;  // of all workers together; the first lattice's, which jumps about, apart
    double first_seconds_per_path = 0;
    double rays_per_second = 0;
    Clock::time_point epoch_submitted, last_publish;
    uint64_t frames_published = 0;
    bool first_frame_out = false;
    bool left_bookmarked = false;  // the view that is left now
    uint32_t resumed_samples = 0;  // that were there when this epoch began
    uint64_t slice_token = 0;
    double last_cancel_seconds = 0, last_first_frame_seconds = 0, last_reproject_seconds = 0;
    std::string error;

    TripleBuffer<Frame> frames;
    WorkerPool pool;
    std::vector<WorkerTally> tallies;
    std::thread control;
};

}  // namespace candela
