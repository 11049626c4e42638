// SPDX-License-Identifier: MIT
// A picture that is taken for the truth, and how far the one that converges is from it.
#pragma once

#include "app/viewer/background_task.h"
#include "renderer/film/frame.h"
#include "renderer/image/codec.h"
#include "renderer/image/compare.h"

namespace candela {

struct ReferenceReading {
    PictureComparison comparison;
    uint64_t serial = 0;  // of the frame that was compared
    double mean_samples = 0;
    bool denoised = false;
};

class ReferencePicture {
  public:
    // Reads a picture of any kind as linear. Throws ImageError, and keeps the one before then.
    void load(const std::string& path, const DecodeLimits& limits = {});
    void clear();
    bool empty() const { return image_.empty(); }
    const ImageRgba32f& image() const { return image_; }
    const std::string& path() const { return path_; }
    // Whether a picture of that extent can be compared.
    bool fits(const ImageRgba32f& picture) const;

    // Fetches what is ready, and compares the frame's picture, or what stands in for it, where it is another one than
    // last time. True where a reading came.
    bool update(const Frame& frame, const ImageRgba32f* stand_in, bool done);
    const std::optional<ReferenceReading>& reading() const { return reading_; }
    bool busy() const { return task_.busy(); }
    // Whether the reading is of that frame.
    bool is_of(const Frame& frame, const ImageRgba32f* stand_in) const;

  private:
    ImageRgba32f image_;
    std::string path_;
    std::optional<ReferenceReading> reading_;
    BackgroundTask<ReferenceReading> task_;
};

}  // namespace candela
