// SPDX-License-Identifier: MIT
// Comparisons: two settings that share the cores, and a reference picture.
#include <fmt/format.h>

#include <thread>

#include "app/viewer/steady_figures.h"
#include "app/viewer/viewer.h"

namespace candela {

namespace {

// Half of the cores, rounded up, for each of two sessions.
unsigned half_of(unsigned threads) {
    const unsigned all = threads != 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
    return (all + 1) / 2;
}

}  // namespace

// Both begin anew, so that they have had the same time whenever one looks.
void Viewer::show_comparison(bool shown) {
    model_.comparison.shown = shown;
    redraws_ = 2;
    if (!shown) {
        other_session_.reset();
        other_frame_ = nullptr;
        session_->use_workers(std::numeric_limits<unsigned>::max());
        model_.display.other.reset();
        return;
    }
    if (model_.map.shown) show_map({false, model_.map.map, model_.map.wipe, model_.map.metric});
    const unsigned threads = half_of(model_.options.threads);
    session_->use_workers(threads);
    SessionOptions options;
    options.threads = threads;
    other_session_ = std::make_unique<RenderSession>(options);
    dirty_ = true;
}

void Viewer::toggle_comparison() {
    ComparedSettings& other = model_.comparison.settings;
    if (other.in(model_.options.integrator) == model_.options.integrator)
        other = opposite_of(model_.options.integrator);
    show_comparison(!model_.comparison.shown);
}

void Viewer::submit_other() {
    if (!model_.comparison.shown) return;
    RenderRequest request = model_.job.request;
    request.settings = model_.comparison.settings.in(request.settings);
    other_session_->submit(std::move(request));
}

void Viewer::take_other_frame() {
    if (!model_.comparison.shown) return;
    Comparison& comparison = model_.comparison;
    comparison.status = other_session_->status();
    if (viewer_options_.steady_figures) make_steady(comparison.status);
    const Frame* frame = other_session_->latest();
    const bool is_new = frame != nullptr && (other_frame_ == nullptr || frame->serial != comparison.serial);
    other_frame_ = frame;
    if (!is_new) return;
    comparison.serial = frame->serial;
    comparison.film = frame->statistics;
    comparison.history = viewer_options_.steady_figures ? steady(frame->history) : frame->history;
    if (!reference_is_uploaded_) display_.upload_other(frame->image);
    redraws_ = std::max(redraws_, 1);
}

void Viewer::load_reference(const std::string& path) {
    try {
        reference_.load(path, image_limits(model_.options.limits));
    } catch (const ImageError& error) {
        notify(fmt::format("{}: {}", path, error.what()), true);
        return;
    }
    model_.reference = ReferenceView{path, {reference_.image().width(), reference_.image().height()}, {}, {}, false};
    notify(file_name(path) + " is the reference: hold Shift to see it, M shows how far the picture is from it");
    if (model_.reference->extent != size_.pixels) {
        notify(fmt::format(
            "{} has {}x{} pixels and the picture {}x{}: only pictures of one size are compared "
            "(--resolution)",
            file_name(path), model_.reference->extent.x, model_.reference->extent.y, size_.pixels.x, size_.pixels.y));
    }
}

// Signed difference, relative square, FLIP, and none again.
void Viewer::step_metric() {
    if (!model_.reference) {
        notify("there is no reference to measure against: --reference FILE, or Shift and drop an .exr or .hdr file");
        return;
    }
    MapView view = model_.map;
    if (!view.shown || !view.metric) {
        view.shown = true;
        view.metric = ReferenceMetric::signed_difference;
    } else if (view.metric == ReferenceMetric::flip) {
        view.shown = false;
        view.metric.reset();
    } else {
        view.metric = static_cast<ReferenceMetric>(static_cast<int>(*view.metric) + 1);
    }
    show_map(view);
}

void Viewer::update_reference() {
    if (!model_.reference || frame_ == nullptr) return;
    const DenoisedPicture* denoised = shown_denoised();
    if (!reference_.update(*frame_, denoised != nullptr ? &denoised->image : nullptr, model_.status.done)) return;
    const ReferenceReading& reading = *reference_.reading();
    model_.reference->difference = reading.comparison.difference;
    model_.reference->mean_samples = reading.mean_samples;
    display_.upload_differences(reading.comparison.maps);
    update_map();
}

bool Viewer::reference_is_missing() const {
    if (!model_.reference || frame_ == nullptr || !model_.status.error.empty()) return false;
    const DenoisedPicture* denoised = shown_denoised();
    const ImageRgba32f* stand_in = denoised != nullptr ? &denoised->image : nullptr;
    const ImageRgba32f& picture = stand_in != nullptr ? *stand_in : frame_->image;
    return reference_.fits(picture) && !reference_.is_of(*frame_, stand_in);
}

// The reference over all of the picture while Shift is held, else what stands beside it.
void Viewer::place_other_picture() {
    model_.display.other.reset();
    const bool reference = model_.reference && model_.reference->held;
    if (reference != reference_is_uploaded_) {
        if (reference) {
            display_.upload_other(reference_.image());
        } else if (other_frame_ != nullptr) {
            display_.upload_other(other_frame_->image);
        }
        reference_is_uploaded_ = reference;
    }
    if (reference) {
        model_.display.map.reset();
        model_.display.other = 0.0f;
    } else if (model_.comparison.shown && other_frame_ != nullptr) {
        model_.display.other = model_.map.wipe;
    }
}

void Viewer::hold_reference(bool held) {
    if (!model_.reference || model_.reference->held == held) return;
    model_.reference->held = held;
    update_map();
}

}  // namespace candela
