// SPDX-License-Identifier: MIT
// From film to frames: resolved, with maps, and while samples are few led over from the view before.
#include "renderer/session/render_session_impl.h"

namespace candela {

namespace {

// A view with fewer samples is not worth reprojecting.
constexpr uint32_t least_reprojected_samples = 4;
// The lattice that tells what a moved view shows: about so many points, and no nearer to each other than that.
constexpr double guide_count = 16384;
constexpr double least_guide_stride = 4;
// Reprojecting may take this part of a frame's time.
constexpr double reprojection_share = 0.45;
constexpr uint32_t rows_per_chunk = 16;

}  // namespace

void RenderSession::Impl::run_rows(const RowWork& rows) {
    std::atomic<uint32_t> next{0};
    const uint32_t height = now->film.extent().y;
    const std::function<void(unsigned)> job = [&](unsigned) {
        for (uint32_t begin = next.fetch_add(rows_per_chunk); begin < height; begin = next.fetch_add(rows_per_chunk)) {
            rows(begin, std::min(begin + rows_per_chunk, height));
        }
    };
    pool.run(job);
}

// What each pixel of this view shows, once the view is worth going out from: row by row, until something newer comes.
void RenderSession::Impl::trace_guides() {
    if (!options.reproject || !options.publish_frames || now->complete_samples() < least_reprojected_samples) return;
    if (own_anchor.samples == nullptr) {
        try {
            own_anchor.guides = GuideLattice(request.view.extent, 1);
        } catch (const std::bad_alloc&) {
            return;
        }
        own_anchor.samples = now;
        own_anchor.world = request.world;
        own_anchor.view = request.view;
        own_anchor.settings = request.settings;
        own_anchor.light_groups = request.light_groups;
    }
    const uint32_t height = request.view.extent.y;
    if (own_anchor.guided_rows == height) return;
    std::atomic<uint32_t> next{own_anchor.guided_rows};
    const Clock::time_point until = Clock::now() + std::chrono::milliseconds(20);
    const std::function<void(unsigned)> job = [&](unsigned) {
        while (work_token.load(std::memory_order_relaxed) == slice_token && Clock::now() < until) {
            const uint32_t row = next.fetch_add(1);
            if (row >= height) return;
            own_anchor.guides.trace_row(*request.world, request.view, row);
        }
    };
    pool.run(job);
    own_anchor.guided_rows = std::min(next.load(), height);
}

uint32_t RenderSession::Impl::affordable_reprojection_step() const {
    const double pixels = static_cast<double>(request.view.extent.x) * request.view.extent.y;
    uint32_t step = 1;
    while (step < 8 && pixels / (step * step) * reproject_seconds_per_point > reprojection_share * frame_seconds.load())
        step *= 2;
    return step;
}

// With an epoch's first picture as finely as there is time for, and once more in full with the next.
void RenderSession::Impl::reproject(uint32_t step) {
    if (!options.reproject || !anchor.serves(request) || anchor.view == request.view) return;
    const Clock::time_point start = Clock::now();
    const Vec2u extent = request.view.extent;
    try {
        const double spacing = std::sqrt(static_cast<double>(extent.x) * extent.y / guide_count);
        GuideLattice lattice(extent, static_cast<uint32_t>(std::max(std::round(spacing), least_guide_stride)));
        std::atomic<uint32_t> next{0};
        const std::function<void(unsigned)> job = [&](unsigned) {
            for (uint32_t row = next.fetch_add(1); row < lattice.size().y; row = next.fetch_add(1))
                lattice.trace_row(*request.world, request.view, row);
        };
        pool.run(job);
        const auto width = static_cast<int>(extent.x), height = static_cast<int>(extent.y);
        if (reprojected.width() != width || reprojected.height() != height) reprojected = ImageRgba32f(width, height);
        const ReprojectionSource source{&anchor.samples->film, &anchor.guides, anchor.view, weights};
        run_rows([&](uint32_t begin, uint32_t end) {
            reproject_rows(source, request.view, lattice, begin, end, reprojected, step);
        });
        is_reprojected = true;
        reprojected_step = step;
    } catch (const std::bad_alloc&) {
        reprojected = {};
    }
    const double seconds = seconds_between(start, Clock::now());
    const double pixels = static_cast<double>(extent.x) * extent.y;
    reproject_seconds_per_point = seconds * (step * step) / pixels;
    if (!first_frame_out) last_reproject_seconds = reproject_seconds = seconds;
}

void RenderSession::Impl::publish() {
    if (!first_frame_out && resumed_samples == 0 && active) {
        reproject(affordable_reprojection_step());
    } else if (is_reprojected && reprojected_step > 1 && active) {
        reproject(1);
    }
    Frame& frame = frames.back();
    const auto width = static_cast<int>(now->film.extent().x);
    const auto height = static_cast<int>(now->film.extent().y);
    if (frame.image.width() != width || frame.image.height() != height) frame.image = ImageRgba32f(width, height);
    run_rows([&](uint32_t begin, uint32_t end) { resolve_rows(now->film, begin, end, frame, weights); });
    if (!maps_wanted.load()) {
        frame.maps = {};
    } else {
        if (frame.maps.width() != width || frame.maps.height() != height) frame.maps = ImageRgba32f(width, height);
        run_rows([&](uint32_t begin, uint32_t end) {
            map_rows(now->film, now->statistics.mean_luminance, begin, end, frame);
        });
    }
    // What is done is shown as it is.
    frame.is_reprojected = is_reprojected && active && now->complete_samples() < most_reprojected_samples;
    if (frame.is_reprojected) {
        if (frame.reprojected.width() != width || frame.reprojected.height() != height)
            frame.reprojected = ImageRgba32f(width, height);
        run_rows([&](uint32_t begin, uint32_t end) {
            blend_reprojected_rows(now->film, frame.image, reprojected, begin, end, frame.reprojected);
        });
    } else if (!active) {
        frame.reprojected = {};
    }
    frame.weighing = weighing;
    frame.epoch = epoch;
    frame.serial = ++frames_published;
    frame.stride = now->schedule ? now->schedule->current_stride() : 1;
    frame.statistics = now->statistics;
    frame.history = now->history;
    frame.statistics.min_samples = now->schedule ? now->schedule->complete_samples() : 0;
    frame.render_seconds = now->render_seconds;
    frame.rays = now->rays.total();
    frames.publish();
    last_publish = Clock::now();
    if (!first_frame_out) {
        first_frame_out = true;
        last_first_frame_seconds = seconds_between(epoch_submitted, last_publish);
        interruptible.store(true);
    }
}

void RenderSession::Impl::measure_film() {
    now->statistics = measure(now->film, [this](uint32_t, const RowWork& work) { run_rows(work); });
    now->measured_at_spp = now->schedule->complete_samples();
    now->history.add(
        {now->measured_at_spp, now->render_seconds, now->statistics.relative_error, now->statistics.relative_error_95});
}

}  // namespace candela
