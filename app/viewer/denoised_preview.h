// SPDX-License-Identifier: MIT
// The denoised picture of what a session renders: made beside it, now and then, and never the truth.
#pragma once

#include "app/viewer/background_task.h"
#include "renderer/denoise/guides.h"
#include "renderer/session/render_session.h"

namespace candela {

struct DenoisedPicture {
    ImageRgba32f image;
    uint64_t epoch = 0;
    uint32_t spp = 0;   // complete passes in it
    bool last = false;  // of a render that is done
    Guides guides;      // go on with the next picture of the epoch
};

class DenoisedPreview {
  public:
    explicit DenoisedPreview(RenderSession& session) : session_(session) {}

    // Fetches what is ready, and starts the next picture where there is one to make that would look better: at first
    // soon, then when there are half as many samples again, and when the render is done. True where a picture came.
    bool update(const RenderRequest& request, const SessionStatus& status, const Frame& newest);
    // Of that submit; null where there is none.
    const DenoisedPicture* picture(uint64_t epoch) const;
    // Whether there is nothing left to make of a render that is done.
    bool is_last(const SessionStatus& status) const;
    bool busy() const { return task_.busy(); }
    // Forgets what there is.
    void clear();

  private:
    RenderSession& session_;
    std::optional<DenoisedPicture> picture_;
    uint64_t failed_epoch_ = 0;  // of the last attempt that came to nothing
    uint64_t started_epoch_ = 0;
    BackgroundTask<DenoisedPicture> task_;
};

}  // namespace candela
