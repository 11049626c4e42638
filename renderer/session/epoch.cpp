// SPDX-License-Identifier: MIT
// One view after the other: beginning with it, tracing its slices, leaving it.
#include <utility>

#include "renderer/session/render_session_impl.h"

namespace candela {

namespace {

// The first lattice may take this part of a frame's time: what is left goes to letting go of the old view, to resolving
// the picture and to drawing it.
constexpr double first_lattice_share = 0.3;
// That and reprojecting the view before together.
constexpr double first_picture_share = 0.5, least_lattice_share = 0.15;
// A slice never lasts longer than this, so that commands are heard.
constexpr double longest_slice_seconds = 0.1;

}  // namespace

bool RenderSession::Impl::worth_keeping() {
    if (options.kept_bytes == 0 || now->complete_samples() == 0) return false;
    if (now->render_seconds >= options.keep_after_seconds) return true;
    return left_bookmarked;
}

// Memory for the next view is made while there is time, not when the person moves.
void RenderSession::Impl::prepare_spare() {
    if (spare != nullptr || !(worth_keeping() || own_anchor.samples != nullptr)) return;
    try {
        auto next = std::make_shared<ViewSamples>();
        next->film = Film(now->film.extent(), now->film.light_groups());
        spare = std::move(next);
    } catch (const std::bad_alloc&) {
        spare = nullptr;
    }
}

void RenderSession::Impl::leave_view() {
    const bool is_anchor = own_anchor.samples != nullptr && own_anchor.guided_rows == request.view.extent.y;
    const bool is_kept = worth_keeping();
    if (is_kept) kept.keep({request.world, request.view, request.settings, request.light_groups}, now, left_bookmarked);
    if (is_anchor) anchor = std::move(own_anchor);
    own_anchor = {};
    if (!is_kept && !is_anchor && now != anchor.samples) return;
    now = spare != nullptr ? std::exchange(spare, nullptr) : std::make_shared<ViewSamples>();
}

void RenderSession::Impl::start_anew() {
    now->render_seconds = 0;
    now->rays = {};
    now->statistics = {};
    now->statistics.relative_error = now->statistics.relative_error_95 = std::numeric_limits<double>::quiet_NaN();
    now->history.clear();
    now->measured_at_spp = 0;
    try {
        const size_t groups = request.light_groups ? request.light_groups->size() : 0;
        if (now->film.extent() == request.view.extent && now->film.light_groups() == groups) {
            run_rows([&](uint32_t begin, uint32_t end) { now->film.clear_rows(begin, end); });
        } else {
            now->film = Film();
            now->film = Film(request.view.extent, groups);
        }
        // The cost of a path in the lattices before foretells this one's; in passes it is a little less.
        const double cost = first_seconds_per_path > 0 ? first_seconds_per_path : seconds_per_path;
        const double frame = frame_seconds.load();
        const double rest = first_picture_share * frame - (anchor.serves(request) ? reproject_seconds : 0);
        const double lattice_seconds = std::clamp(rest, least_lattice_share * frame, first_lattice_share * frame);
        now->schedule.emplace(request.view.extent, choose_first_stride(request.view.extent, cost, lattice_seconds),
                              request.settings.may_reuse_paths() && groups == 0);
        // A headless render shows nothing before its end: its first frame may be interrupted.
        interruptible.store(!options.publish_frames);
    } catch (const std::bad_alloc&) {
        now->film = Film();
        now->schedule.reset();
        error = "there is not enough memory for a picture of " + std::to_string(request.view.extent.x) + "x" +
                std::to_string(request.view.extent.y) + " pixels";
        active = false;
    }
}

void RenderSession::Impl::begin_epoch(RenderRequest next, uint64_t next_epoch, Clock::time_point submitted) {
    leave_view();
    request = std::move(next);
    epoch = next_epoch;
    epoch_submitted = submitted;
    last_publish = submitted;
    first_frame_out = false;
    error.clear();
    active = true;
    is_reprojected = false;
    std::shared_ptr<ViewSamples> again;
    if (request.resumes) again = kept.take({request.world, request.view, request.settings, request.light_groups});
    resumed_samples = again != nullptr ? again->complete_samples() : 0;
    if (again == nullptr) {
        start_anew();
        return;
    }
    now = std::move(again);
    if (finished_by_limits()) {
        finish_epoch();
    } else {
        publish();
    }
    trace_guides();
}

uint32_t RenderSession::Impl::slice_tiles() const {
    if (!(seconds_per_path > 0)) return pool.size();
    // Young pictures get a new frame often; later the next one may take a tenth of the time spent so far.
    double target = longest_slice_seconds;
    if (options.publish_frames)
        target = std::clamp(0.1 * now->render_seconds, frame_seconds.load(), longest_slice_seconds);
    const double tiles = target / (seconds_per_path * tile_side * tile_side);
    return static_cast<uint32_t>(std::clamp(tiles, 1.0 * pool.size(), 1e6));
}

// The samples of one tile; false once a newer request came.
bool RenderSession::Impl::trace_tile(WorkerTally& tally, const std::atomic<uint64_t>* cancel) {
    if (request.light_groups == nullptr) {
        return options.trace(*request.world, request.view, request.settings, tally.samples, tally.radiance, tally.rays,
                             cancel, slice_token);
    }
    tally.by_light.resize(max_batch * request.light_groups->size());
    return trace_grouped(*request.world, request.view, request.settings, *request.light_groups, tally.samples,
                         tally.radiance, tally.by_light, tally.rays, cancel, slice_token);
}

void RenderSession::Impl::trace_slice() {
    const Slice slice = now->schedule->next(slice_tiles());
    std::vector<uint8_t> traced_tiles(slice.size());
    std::atomic<uint32_t> next{0};
    const unsigned used = workers_used.load();
    const std::function<void(unsigned)> job = [&](unsigned worker) {
        if (worker >= used) return;
        WorkerTally& tally = tallies[worker];
        const bool first = !first_frame_out && options.publish_frames;
        for (uint32_t t = next.fetch_add(1); t < slice.size(); t = next.fetch_add(1)) {
            now->schedule->list(slice, slice.tile(t), tally.samples);
            // The first coarse pass is finished whatever happens, so that dragging always shows pictures.
            const std::atomic<uint64_t>* cancel = first ? nullptr : &work_token;
            if (!trace_tile(tally, cancel)) return;
            const size_t groups = now->film.light_groups();
            for (size_t i = 0; i < tally.samples.size(); ++i) {
                const PixelSample& sample = tally.samples[i];
                const RadianceSample& traced = tally.radiance[i];
                now->film.add({sample.x, sample.y}, sample.index, traced.radiance, traced.alpha,
                              {traced.segments, traced.shadow_rays},
                              std::span<const Vec3>(tally.by_light).subspan(i * groups, groups));
            }
            now->schedule->note(slice.tile(t), tally.samples, tally.radiance);
            tally.paths += tally.samples.size();
            traced_tiles[t] = 1;
        }
    };
    const Clock::time_point start = Clock::now();
    pool.run(job);
    const double seconds = seconds_between(start, Clock::now());

    // What a newer request cut off comes first if the person goes back to this view.
    std::vector<uint32_t> untraced;
    for (uint32_t t = 0; t < slice.size(); ++t) {
        if (traced_tiles[t] == 0) untraced.push_back(slice.tile(t));
    }
    if (!untraced.empty()) now->schedule->give_back(slice, std::move(untraced));

    // Gather what the workers counted, and learn their speed.
    const uint64_t rays_before = now->rays.total();
    uint64_t paths = 0;
    for (WorkerTally& tally : tallies) {
        now->rays += tally.rays;
        paths += tally.paths;
        tally.rays = {};
        tally.paths = 0;
    }
    now->render_seconds += seconds;
    if (paths > 0 && seconds > 0) {
        const double measured = seconds / static_cast<double>(paths);
        const bool is_first = slice.pass.sample_index == 0 && slice.pass.done_stride == 0;
        double& known = is_first ? first_seconds_per_path : seconds_per_path;
        known = known > 0 ? 0.7 * known + 0.3 * measured : measured;
        const double rate = static_cast<double>(now->rays.total() - rays_before) / seconds;
        rays_per_second = rays_per_second > 0 ? 0.8 * rays_per_second + 0.2 * rate : rate;
    }
}

}  // namespace candela
