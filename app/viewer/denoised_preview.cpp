// SPDX-License-Identifier: MIT
#include "app/viewer/denoised_preview.h"

#include "renderer/denoise/denoise.h"
#include "renderer/integrator/guide_rays.h"

namespace candela {

namespace {

// Both replicates need a sample before anything is known of the noise.
constexpr uint32_t fewest_samples = 2;
// A view that passes by is not worth the work.
constexpr double settled_seconds = 0.3;
constexpr uint32_t most_guide_passes = 16;

// A young picture does not wait for guides that are better than it.
uint32_t guide_passes(uint32_t spp, bool last) {
    return std::min({spp, most_guide_passes, last ? most_guide_passes : std::max(spp / 4, 4u)});
}

}  // namespace

void DenoisedPreview::clear() {
    task_.stop();
    picture_.reset();
    failed_epoch_ = 0;
}

const DenoisedPicture* DenoisedPreview::picture(uint64_t epoch) const {
    return picture_ && picture_->epoch == epoch ? &*picture_ : nullptr;
}

bool DenoisedPreview::is_last(const SessionStatus& status) const {
    if (!status.done || task_.busy()) return false;
    if (status.spp < fewest_samples || failed_epoch_ == status.epoch) return true;
    const DenoisedPicture* now = picture(status.epoch);
    return now != nullptr && now->last;
}

bool DenoisedPreview::update(const RenderRequest& request, const SessionStatus& status, const Frame& newest) {
    bool came = false;
    if (task_.ready()) {
        if (std::optional<DenoisedPicture> made = task_.take()) {
            came = made->epoch == status.epoch;
            picture_ = std::move(made);
        } else if (started_epoch_ == status.epoch) {
            failed_epoch_ = status.epoch;
        }
    }
    if (task_.busy()) {
        if (started_epoch_ != status.epoch) task_.cancel();
        return came;
    }
    const DenoisedPicture* now = picture(status.epoch);
    const uint32_t spp = newest.statistics.min_samples;
    if (newest.epoch != status.epoch || spp < fewest_samples || failed_epoch_ == status.epoch) return came;
    if (!status.done) {
        if (now == nullptr && newest.render_seconds < settled_seconds) return came;
        if (now != nullptr && spp < now->spp + now->spp / 2) return came;
    } else if (now != nullptr && now->last) {
        return came;
    }

    // The film is copied on the task's thread: that waits for a slice.
    started_epoch_ = status.epoch;
    Guides guides = now != nullptr ? std::move(picture_->guides) : Guides();
    if (guides.passes == 0) guides = Guides(request.view.extent);
    task_.start([&session = session_, request, epoch = status.epoch, last = status.done,
                 guides = std::move(guides)](const std::atomic<bool>* cancel) -> std::optional<DenoisedPicture> {
        uint64_t film_epoch = 0;
        const Film film = session.snapshot_film(&film_epoch);
        if (film_epoch != epoch || film.extent() != request.view.extent) return std::nullopt;
        DenoisedPicture out;
        out.epoch = epoch;
        out.last = last;
        out.spp = 0xffffffffu;
        for (const FilmPixel& pixel : film.pixels())
            out.spp = std::min(out.spp, pixel.count + pixel.non_finite);
        out.guides = guides;
        if (!add_guides(*request.world, request.view, request.settings, guide_passes(out.spp, last), out.guides,
                        cancel)) {
            return std::nullopt;
        }
        out.image = denoise(film, out.guides, cancel);
        if (out.image.empty()) return std::nullopt;
        return out;
    });
    return came;
}

}  // namespace candela
