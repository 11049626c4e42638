// SPDX-License-Identifier: MIT
// A click on a pixel: what is there, and the replay of its brightest sample.
#include <algorithm>
#include <utility>

#include "app/viewer/viewer.h"

namespace candela {

namespace {

// Samples that are traced again, at most, in search of the brightest.
constexpr uint32_t most_searched = 16384;

}  // namespace

void Viewer::inspect_at(const Vec2& point) {
    if (!model_.has_scene()) return;
    const View view{model_.view.camera, glm::max(size_.pixels, Vec2u(1))};
    const Vec2 at = film_uv_of(point) * Vec2(view.extent);
    if (at.x < 0 || at.y < 0 || at.x >= static_cast<float>(view.extent.x) || at.y >= static_cast<float>(view.extent.y))
        return;
    // A second click on it puts the glass away.
    const Vec2u pixel(at);
    if (model_.inspection && model_.inspection->pixel == pixel) {
        end_inspection();
    } else {
        begin_inspection(pixel);
    }
}

void Viewer::begin_inspection(Vec2u pixel) {
    Inspection inspection;
    inspection.pixel = pixel;
    inspection.view = {model_.view.camera, glm::max(size_.pixels, Vec2u(1))};
    inspection.hit =
        trace_first_hit(*model_.job.world, inspection.view, (Vec2(pixel) + 0.5f) / Vec2(inspection.view.extent));
    if (inspection.hit.material < model_.materials.size()) model_.edited_material = inspection.hit.material;
    search_.cancel();
    searched_samples_ = 0;
    model_.inspection = std::move(inspection);
    session_->show_maps(true);
    redraws_ = 2;
}

void Viewer::end_inspection() {
    model_.inspection.reset();
    search_.cancel();
    session_->show_maps(model_.map.shown);
    redraws_ = 2;
}

// Another view ends it; another world or setting begins it anew at the same pixel.
void Viewer::renew_inspection() {
    if (!model_.inspection) return;
    const View& view = model_.inspection->view;
    const bool same = view.camera == model_.view.camera && view.extent == size_.pixels;
    if (same && model_.inspection->pixel.x < view.extent.x) {
        begin_inspection(model_.inspection->pixel);
    } else {
        end_inspection();
    }
}

void Viewer::update_inspection() {
    if (wanted_inspection_ && model_.has_scene()) {
        const Vec2u pixel = *std::exchange(wanted_inspection_, std::nullopt);
        if (pixel.x < size_.pixels.x && pixel.y < size_.pixels.y) begin_inspection(pixel);
    }
    if (search_.ready()) {
        std::optional<PixelLedger> found = search_.take();
        if (found && model_.inspection && found->path.sample.x == model_.inspection->pixel.x &&
            found->path.sample.y == model_.inspection->pixel.y && search_epoch_ == model_.status.epoch) {
            model_.inspection->ledger = std::move(found);
            redraws_ = std::max(redraws_, 2);
        }
    }
    if (!model_.inspection || frame_ == nullptr || frame_->epoch != model_.status.epoch) return;
    Inspection& inspection = *model_.inspection;
    const int x = static_cast<int>(inspection.pixel.x), y = static_cast<int>(inspection.pixel.y);
    if (x >= frame_->image.width() || y >= frame_->image.height()) return;
    inspection.value = frame_->image(x, y);
    if (!frame_->maps.empty()) {
        const Vec4& maps = frame_->maps(x, y);
        inspection.error = maps[static_cast<int>(PixelMap::error)];
        inspection.samples = maps[static_cast<int>(PixelMap::samples)];
        inspection.rays = maps[static_cast<int>(PixelMap::rays)];
    }

    // The search is made again when there are four times as many samples, and at the end.
    const uint32_t samples = std::min(frame_->statistics.min_samples, most_searched);
    const bool last = model_.status.done && samples > searched_samples_;
    if (search_.busy() || samples == 0 || (samples < 4 * searched_samples_ && !last)) return;
    searched_samples_ = samples;
    search_epoch_ = model_.status.epoch;
    search_.start([request = model_.job.request, pixel = inspection.pixel,
                   samples](const std::atomic<bool>* cancel) -> std::optional<PixelLedger> {
        const World& world = *request.world;
        const std::optional<PixelSample> brightest =
            brightest_sample(world, request.view, request.settings, pixel, samples, cancel);
        if (!brightest) return std::nullopt;
        const float far_m = glm::length(world.bounds.upper - world.bounds.lower);
        Ledger path = trace_ledger(world, request.view, request.settings, *brightest, far_m);
        std::vector<LedgerRow> rows = rows_of(world, path);
        return PixelLedger{std::move(path), std::move(rows), samples};
    });
}

bool Viewer::inspection_is_missing() const {
    if (wanted_inspection_ && model_.has_scene()) return true;
    if (search_.busy()) return true;
    if (!model_.status.error.empty() || !model_.inspection || frame_ == nullptr) return false;
    if (frame_->maps.empty()) return true;
    return !model_.inspection->ledger && frame_->statistics.min_samples > 0;
}

}  // namespace candela
