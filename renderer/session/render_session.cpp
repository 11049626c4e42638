// SPDX-License-Identifier: MIT
#include "renderer/session/render_session.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "renderer/session/render_session_impl.h"

namespace candela {

namespace {

unsigned worker_count(unsigned asked) {
    return asked != 0 ? asked : std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace

RenderSession::Impl::Impl(const SessionOptions& session_options)
    : options(session_options),
      kept(session_options.kept_bytes),
      frame_seconds(session_options.frame_seconds),
      pool(worker_count(session_options.threads)),
      tallies(pool.size()),
      control([this] { control_loop(); }) {}

RenderSession::Impl::~Impl() {
    {
        const std::lock_guard lock(mutex);
        quit = true;
        work_token.fetch_add(1);
    }
    wake.notify_all();
    control.join();
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
    const uint32_t spp = now->schedule->complete_samples();
    // The error is looked at when it has had time to change, and both replicates have as many samples.
    const bool worth_measuring = spp > now->measured_at_spp && spp % (spp <= 8 ? 2 : spp <= 32 ? 4 : 16) == 0;
    if (worth_measuring && (options.publish_frames || request.until_relative_error > 0)) {
        measure_film();
    }
    if (request.until_relative_error > 0 && now->statistics.relative_error <= request.until_relative_error) return true;
    return spp >= spp_limit || now->render_seconds >= time_limit;
}

void RenderSession::Impl::finish_epoch() {
    active = false;
    measure_film();
    publish();
}

void RenderSession::Impl::update_status() {
    const std::lock_guard lock(mutex);
    status.epoch = newest_epoch;
    status.spp = now->schedule ? now->schedule->complete_samples() : 0;
    status.render_seconds = now->render_seconds;
    status.rays = now->rays;
    status.rays_per_second = rays_per_second;
    status.done = !active && epoch == newest_epoch && epoch != 0;
    status.paused = paused;
    status.last_cancel_seconds = last_cancel_seconds;
    status.last_first_frame_seconds = last_first_frame_seconds;
    status.last_reproject_seconds = first_frame_out && is_reprojected ? last_reproject_seconds : 0;
    status.error = error;
    status.resumed_samples = resumed_samples;
    status.kept_views = static_cast<uint32_t>(kept.count());
    status.kept_bytes = kept.bytes();
    reported.notify_all();
}

void RenderSession::Impl::control_loop() {
    for (;;) {
        // Between slices: take what was asked for, or sleep until something is.
        std::optional<RenderRequest> next;
        Clock::time_point submitted;
        uint64_t next_epoch = 0;
        bool republish = false, only_guides = false;
        {
            std::unique_lock lock(mutex);
            const bool guides_left = own_anchor.samples != nullptr && own_anchor.guided_rows < own_anchor.view.extent.y;
            if (snapshots_made != snapshots_asked) {
                snapshot = now->film.reweighted(weights);
                snapshot_epoch = epoch;
                snapshots_made = snapshots_asked;
                reported.notify_all();
            }
            const auto idle = [&] {
                return !mailbox && !quit && !republish_asked && snapshots_made == snapshots_asked && !stop_asked &&
                       (!active || paused) && !guides_left;
            };
            wake.wait(lock, [&] { return !idle(); });
            if (quit) return;
            if (snapshots_made != snapshots_asked) continue;
            only_guides = !mailbox && !republish_asked && (!active || paused);
            republish = std::exchange(republish_asked, false);
            weights = weights_asked;
            weighing = weighings_asked;
            // A submit from now on makes workers let go of the slice that follows.
            slice_token = work_token.load();
            if (mailbox && (!active || interruptible.load())) {
                next = std::move(mailbox);
                mailbox.reset();
                left_bookmarked = std::exchange(bookmarked, next->bookmarked);
                submitted = submitted_at;
                next_epoch = newest_epoch;
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
            if (is_reprojected) reproject(1);
            if (first_frame_out) publish();
            continue;
        }
        if (only_guides) {
            trace_guides();
            continue;
        }
        if (!active) continue;

        trace_slice();
        // Workers let go only for a newer request or the end, and then the epoch is lost anyway.
        trace_guides();
        prepare_spare();
        const bool replaced = [&] {
            const std::lock_guard lock(mutex);
            return quit || (mailbox && interruptible.load());
        }();
        if (replaced) continue;
        if (finished_by_limits()) {
            finish_epoch();
        } else if (options.publish_frames && now->schedule->first_pass_done()) {
            const double wait = std::clamp(0.1 * now->render_seconds, frame_seconds.load(), 1.0);
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
        impl_->stop_asked = false;  // which was about what came before
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

void RenderSession::bookmark_view() {
    const std::lock_guard lock(impl_->mutex);
    (impl_->mailbox ? impl_->mailbox->bookmarked : impl_->bookmarked) = true;
}

void RenderSession::set_frame_seconds(double seconds) {
    impl_->frame_seconds.store(seconds);
}

void RenderSession::use_workers(unsigned count) {
    impl_->workers_used.store(std::max(count, 1u));
}

uint64_t RenderSession::weigh_lights(std::vector<Vec3> weights) {
    uint64_t weighing = 0;
    {
        const std::lock_guard lock(impl_->mutex);
        // Lights as they are need no sums over groups, and are shown to the bit.
        if (std::all_of(weights.begin(), weights.end(), [](const Vec3& weight) { return weight == Vec3(1); }))
            weights.clear();
        if (weights == impl_->weights_asked) return impl_->weighings_asked;
        weighing = ++impl_->weighings_asked;
        impl_->weights_asked = std::move(weights);
        impl_->republish_asked = true;
    }
    impl_->wake.notify_all();
    return weighing;
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
