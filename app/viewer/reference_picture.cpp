// SPDX-License-Identifier: MIT
#include "app/viewer/reference_picture.h"

namespace candela {

void ReferencePicture::load(const std::string& path, const DecodeLimits& limits) {
    ImageRgba32f read = read_any_as_linear(path, limits);
    task_.stop();
    reading_.reset();
    image_ = std::move(read);
    path_ = path;
}

void ReferencePicture::clear() {
    task_.stop();
    reading_.reset();
    image_ = {};
    path_.clear();
}

bool ReferencePicture::fits(const ImageRgba32f& picture) const {
    return !empty() && picture.width() == image_.width() && picture.height() == image_.height();
}

bool ReferencePicture::is_of(const Frame& frame, const ImageRgba32f* stand_in) const {
    return reading_ && reading_->serial == frame.serial && reading_->denoised == (stand_in != nullptr);
}

bool ReferencePicture::update(const Frame& frame, const ImageRgba32f* stand_in, bool done) {
    bool came = false;
    if (task_.ready()) {
        if (std::optional<ReferenceReading> made = task_.take()) {
            reading_ = std::move(made);
            came = true;
        }
    }
    const ImageRgba32f& picture = stand_in != nullptr ? *stand_in : frame.image;
    if (task_.busy() || frame.stride != 1 || !fits(picture) || is_of(frame, stand_in)) return came;
    // A picture that settles is looked at ever more seldom, and at its end.
    const double samples = frame.statistics.mean_samples;
    const bool another = reading_ && (reading_->denoised != (stand_in != nullptr) || samples < reading_->mean_samples);
    if (reading_ && !another && !done && samples < 1.1 * reading_->mean_samples) return came;
    task_.start([this, test = picture, serial = frame.serial, samples,
                 denoised = stand_in != nullptr](const std::atomic<bool>*) -> std::optional<ReferenceReading> {
        return ReferenceReading{compare_with_maps(test, image_), serial, samples, denoised};
    });
    return came;
}

}  // namespace candela
