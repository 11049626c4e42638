// SPDX-License-Identifier: MIT
#include "renderer/session/render_session.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include "renderer/session/schedule.h"
#include "renderer/session/triple_buffer.h"
#include "renderer/session/worker_pool.h"

namespace candela {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

unsigned worker_count(unsigned asked) {
    return asked != 0 ? asked : std::max(1u, std::thread::hardware_concurrency());
}

// A worker's own tally, on cache lines of its own.
struct alignas(64) WorkerTally {
    RayCounts rays;
    uint64_t paths = 0;
    std::vector<PixelSample> samples;
    std::array<RadianceSample, max_batch> radiance;
};

// The first coarse picture should not take longer than this.
constexpr double first_picture_seconds = 0.025;
// A slice never lasts longer than this, so that commands are heard.
constexpr double longest_slice_seconds = 0.1;
constexpr uint32_t rows_per_chunk = 16;

}  // namespace

struct RenderSession::Impl {
    explicit Impl(const SessionOptions& session_options)
        : options(session_options),
          pool(worker_count(session_options.threads)),
          tallies(pool.size()),
          control([this] { control_loop(); }) {}
    ~Impl() {
        {
            const std::lock_guard lock(mutex);
            quit = true;
            work_token.fetch_add(1);
        }
        wake.notify_all();
        control.join();
    }

    void control_loop();
    void begin_epoch(RenderRequest next, uint64_t epoch, Clock::time_point submitted);
    void trace_slice();
    bool finished_by_limits();
    void finish_epoch();
    void measure_film();
    void publish();
    void update_status();
    void run_rows(const RowWork& rows);
    uint32_t slice_tiles() const;

    SessionOptions options;

    // Handed over under the mutex, looked at by the control thread between slices.
    std::mutex mutex;
    std::condition_variable wake;      // for the control thread
    std::condition_variable reported;  // for those who wait for it
    std::optional<RenderRequest> mailbox;
    Clock::time_point submitted_at;
    uint64_t newest_epoch = 0;
    bool paused = false, stop_asked = false, quit = false;
    bool republish_asked = false;
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
    // Whether frames come with maps.
    std::atomic<bool> maps_wanted{false};

    // Owned by the control thread.
    RenderRequest request;
    uint64_t epoch = 0;
    std::optional<Schedule> schedule;
    Film film;
    FilmStatistics statistics;
    ErrorHistory history;
    uint32_t measured_at_spp = 0;
    bool active = false;
    double render_seconds = 0;
    double seconds_per_path = 0;
    RayCounts rays;
    double rays_per_second = 0;
    Clock::time_point epoch_submitted, last_publish;
    uint64_t frames_published = 0;
    bool first_frame_out = false;
    double last_cancel_seconds = 0, last_first_frame_seconds = 0;
    std::string error;

    TripleBuffer<Frame> frames;
    WorkerPool pool;
    std::vector<WorkerTally> tallies;
    std::thread control;
};

void RenderSession::Impl::run_rows(const RowWork& rows) {
    std::atomic<uint32_t> next{0};
    const uint32_t height = film.extent().y;
    const std::function<void(unsigned)> job = [&](unsigned) {
        for (uint32_t begin = next.fetch_add(rows_per_chunk); begin < height; begin = next.fetch_add(rows_per_chunk)) {
            rows(begin, std::min(begin + rows_per_chunk, height));
        }
    };
    pool.run(job);
}

void RenderSession::Impl::begin_epoch(RenderRequest next, uint64_t next_epoch, Clock::time_point submitted) {
    request = std::move(next);
    epoch = next_epoch;
    epoch_submitted = submitted;
    last_publish = submitted;
    render_seconds = 0;
    rays = {};
    statistics = {};
    statistics.relative_error = statistics.relative_error_95 = std::numeric_limits<double>::quiet_NaN();
    history.clear();
    measured_at_spp = 0;
    first_frame_out = false;
    error.clear();
    active = true;
    try {
        if (film.extent() == request.view.extent) {
            run_rows([&](uint32_t begin, uint32_t end) { film.clear_rows(begin, end); });
        } else {
            film = Film();
            film = Film(request.view.extent);
        }
        schedule.emplace(request.view.extent,
                         choose_first_stride(request.view.extent, seconds_per_path, first_picture_seconds));
        // A headless render shows nothing before its end: its first frame may be interrupted.
        interruptible.store(!options.publish_frames);
    } catch (const std::bad_alloc&) {
        film = Film();
        error = "there is not enough memory for a picture of " + std::to_string(request.view.extent.x) + "x" +
                std::to_string(request.view.extent.y) + " pixels";
        active = false;
    }
}

uint32_t RenderSession::Impl::slice_tiles() const {
    if (!(seconds_per_path > 0)) return pool.size();
    // Young pictures get a new frame often; later the next one may take a tenth of the time spent so far.
    double target = longest_slice_seconds;
    if (options.publish_frames) target = std::clamp(0.1 * render_seconds, options.frame_seconds, longest_slice_seconds);
    const double tiles = target / (seconds_per_path * tile_side * tile_side);
    return static_cast<uint32_t>(std::clamp(tiles, 1.0 * pool.size(), 1e6));
}

void RenderSession::Impl::trace_slice() {
    const Slice slice = schedule->next(slice_tiles());
    const uint64_t token = work_token.load();
    std::atomic<uint32_t> next{slice.first_tile};
    const std::function<void(unsigned)> job = [&](unsigned worker) {
        WorkerTally& tally = tallies[worker];
        const bool first = !first_frame_out && options.publish_frames;
        for (uint32_t tile = next.fetch_add(1); tile < slice.end_tile; tile = next.fetch_add(1)) {
            list_tile(slice.pass, request.view.extent, tile, tally.samples);
            // The first coarse pass is finished whatever happens, so that dragging always shows pictures.
            const std::atomic<uint64_t>* cancel = first ? nullptr : &work_token;
            if (!options.trace(*request.world, request.view, request.settings, tally.samples, tally.radiance,
                               tally.rays, cancel, token)) {
                return;
            }
            for (size_t i = 0; i < tally.samples.size(); ++i) {
                const PixelSample& sample = tally.samples[i];
                const RadianceSample& traced = tally.radiance[i];
                film.add({sample.x, sample.y}, sample.index, traced.radiance, traced.alpha,
                         {traced.segments, traced.shadow_rays});
            }
            tally.paths += tally.samples.size();
        }
    };
    const Clock::time_point start = Clock::now();
    pool.run(job);
    const double seconds = seconds_between(start, Clock::now());

    // Gather what the workers counted, and learn their speed.
    const uint64_t rays_before = rays.total();
    uint64_t paths = 0;
    for (WorkerTally& tally : tallies) {
        rays += tally.rays;
        paths += tally.paths;
        tally.rays = {};
        tally.paths = 0;
    }
    render_seconds += seconds;
    if (paths > 0 && seconds > 0) {
        const double measured = seconds / static_cast<double>(paths);
        seconds_per_path = seconds_per_path > 0 ? 0.7 * seconds_per_path + 0.3 * measured : measured;
        const double rate = static_cast<double>(rays.total() - rays_before) / seconds;
        rays_per_second = rays_per_second > 0 ? 0.8 * rays_per_second + 0.2 * rate : rate;
    }
}

void RenderSession::Impl::publish() {
    Frame& frame = frames.back();
    const auto width = static_cast<int>(film.extent().x);
    const auto height = static_cast<int>(film.extent().y);
    if (frame.image.width() != width || frame.image.height() != height) frame.image = ImageRgba32f(width, height);
    run_rows([&](uint32_t begin, uint32_t end) { resolve_rows(film, begin, end, frame); });
    if (!maps_wanted.load()) {
        frame.maps = {};
    } else {
        if (frame.maps.width() != width || frame.maps.height() != height) frame.maps = ImageRgba32f(width, height);
        run_rows([&](uint32_t begin, uint32_t end) { map_rows(film, statistics.mean_luminance, begin, end, frame); });
    }
    frame.epoch = epoch;
    frame.serial = ++frames_published;
    frame.stride = schedule ? schedule->current_stride() : 1;
    frame.statistics = statistics;
    frame.history = history;
    frame.statistics.min_samples = schedule ? schedule->complete_samples() : 0;
    frame.render_seconds = render_seconds;
    frame.rays = rays.total();
    frames.publish();
    last_publish = Clock::now();
    if (!first_frame_out) {
        first_frame_out = true;
        last_first_frame_seconds = seconds_between(epoch_submitted, last_publish);
        interruptible.store(true);
    }
}

void RenderSession::Impl::measure_film() {
    statistics = measure(film, [this](uint32_t, const RowWork& work) { run_rows(work); });
    measured_at_spp = schedule->complete_samples();
    history.add({measured_at_spp, render_seconds, statistics.relative_error, statistics.relative_error_95});
}

bool RenderSession::Impl::finished_by_limits() {
    uint32_t spp_limit = 0;
    double time_limit = 0;
    {
        const std::lock_guard lock(mutex);
        if (stop_asked) return true;
        spp_limit = max_spp;
        time_limit = max_seconds;
    }
    const uint32_t spp = schedule->complete_samples();
    // The error is looked at when it has had time to change, and both replicates have as many samples.
    const bool worth_measuring = spp > measured_at_spp && spp % (spp <= 8 ? 2 : spp <= 32 ? 4 : 16) == 0;
    if (worth_measuring && (options.publish_frames || request.until_relative_error > 0)) {
        measure_film();
        if (request.until_relative_error > 0 && statistics.relative_error <= request.until_relative_error) return true;
    }
    return spp >= spp_limit || render_seconds >= time_limit;
}

void RenderSession::Impl::finish_epoch() {
    active = false;
    measure_film();
    publish();
}

void RenderSession::Impl::update_status() {
    const std::lock_guard lock(mutex);
    status.epoch = newest_epoch;
    status.spp = schedule ? schedule->complete_samples() : 0;
    status.render_seconds = render_seconds;
    status.rays = rays;
    status.rays_per_second = rays_per_second;
    status.done = !active && epoch == newest_epoch && epoch != 0;
    status.paused = paused;
    status.last_cancel_seconds = last_cancel_seconds;
    status.last_first_frame_seconds = last_first_frame_seconds;
    status.error = error;
    reported.notify_all();
}

void RenderSession::Impl::control_loop() {
    for (;;) {
        // Between slices: take what was asked for, or sleep until something is.
        std::optional<RenderRequest> next;
        Clock::time_point submitted;
        uint64_t next_epoch = 0;
        bool republish = false;
        {
            std::unique_lock lock(mutex);
            if (snapshots_made != snapshots_asked) {
                snapshot = film;
                snapshot_epoch = epoch;
                snapshots_made = snapshots_asked;
                reported.notify_all();
            }
            const auto idle = [&] {
                return !mailbox && !quit && !republish_asked && snapshots_made == snapshots_asked && !stop_asked &&
                       (!active || paused);
            };
            wake.wait(lock, [&] { return !idle(); });
            if (quit) return;
            if (snapshots_made != snapshots_asked) continue;
            republish = std::exchange(republish_asked, false);
            if (mailbox && (!active || interruptible.load())) {
                next = std::move(mailbox);
                mailbox.reset();
                submitted = submitted_at;
                next_epoch = newest_epoch;
                stop_asked = false;
                max_spp = next->max_spp;
                max_seconds = next->max_seconds;
            } else if (!active) {
                stop_asked = false;
            }
        }
        if (next) {
            last_cancel_seconds = seconds_between(submitted, Clock::now());
            begin_epoch(std::move(*next), next_epoch, submitted);
            update_status();
        } else if (republish) {
            if (first_frame_out) publish();
            continue;
        }
        if (!active) continue;

        trace_slice();
        // Workers let go only for a newer request or the end, and then the epoch is lost anyway.
        const bool replaced = [&] {
            const std::lock_guard lock(mutex);
            return quit || (mailbox && interruptible.load());
        }();
        if (replaced) continue;
        if (finished_by_limits()) {
            finish_epoch();
        } else if (options.publish_frames && schedule->first_pass_done()) {
            const double wait = std::clamp(0.1 * render_seconds, options.frame_seconds, 1.0);
            if (!first_frame_out || seconds_between(last_publish, Clock::now()) >= wait) publish();
        }
        update_status();
    }
}

RenderSession::RenderSession(const SessionOptions& options) : impl_(std::make_unique<Impl>(options)) {}

RenderSession::~RenderSession() = default;

uint64_t RenderSession::submit(RenderRequest request) {
    const Vec2u extent = request.view.extent;
    if (!request.world) throw std::invalid_argument("a render request needs a world");
    if (extent.x == 0 || extent.y == 0 || extent.x > 65535 || extent.y > 65535) {
        throw std::invalid_argument("a picture has 1 to 65535 pixels along each side");
    }
    std::optional<RenderRequest> replaced;  // dies here, outside the lock
    uint64_t epoch = 0;
    {
        const std::lock_guard lock(impl_->mutex);
        replaced = std::exchange(impl_->mailbox, std::move(request));
        epoch = ++impl_->newest_epoch;
        impl_->submitted_at = Clock::now();
        impl_->status.epoch = epoch;
        impl_->status.done = false;
        if (impl_->interruptible.load()) impl_->work_token.fetch_add(1);
    }
    impl_->wake.notify_all();
    return epoch;
}

const Frame* RenderSession::latest() {
    return impl_->frames.latest();
}

void RenderSession::pause() {
    const std::lock_guard lock(impl_->mutex);
    impl_->paused = true;
    impl_->status.paused = true;
}

void RenderSession::resume() {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->paused = false;
        impl_->status.paused = false;
    }
    impl_->wake.notify_all();
}

SessionStatus RenderSession::status() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->status;
}

bool RenderSession::wait_until_done(double timeout_s) {
    std::unique_lock lock(impl_->mutex);
    const auto done = [&] { return impl_->status.done; };
    if (!std::isfinite(timeout_s)) {
        impl_->reported.wait(lock, done);
        return true;
    }
    return impl_->reported.wait_for(lock, std::chrono::duration<double>(timeout_s), done);
}

void RenderSession::stop() {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->stop_asked = true;
        impl_->paused = false;
    }
    impl_->wake.notify_all();
}

void RenderSession::show_maps(bool wanted) {
    if (impl_->maps_wanted.exchange(wanted) == wanted || !wanted) return;
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->republish_asked = true;
    }
    impl_->wake.notify_all();
}

Film RenderSession::snapshot_film(uint64_t* epoch) {
    std::unique_lock lock(impl_->mutex);
    const uint32_t mine = ++impl_->snapshots_asked;
    impl_->wake.notify_all();
    impl_->reported.wait(lock, [&] { return impl_->snapshots_made >= mine; });
    if (epoch != nullptr) *epoch = impl_->snapshot_epoch;
    return impl_->snapshot;
}

}  // namespace candela
