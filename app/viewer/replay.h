// SPDX-License-Identifier: MIT
// Plays a recording to a viewer, to the same picture to the bit on any machine: instead of the wall clock it waits for
// what the session had seen, and gives the clock of the recording.
#pragma once

#include "app/gl/osmesa_context.h"
#include "app/viewer/recording.h"
#include "app/viewer/viewer.h"

namespace candela {

// How a viewer behaves that is the same everywhere: on that clock, without what depends on the machine's speed.
ViewerOptions replayed_viewer(std::function<double()> now_s);

class Replay {
  public:
    // options: those of the recording, as they are meant now. Throws CommandError, GlError.
    Replay(const Recording& recording, const RenderOptions& options);

    // Plays all of it, and lets the picture settle; called between: whenever something may be shown of the progress,
    // returns whether to go on. Throws CommandError (unreadable scene) where the recording waits for what never comes.
    void play(const std::function<bool()>& between = {});
    // What the window shows now, with the panels or without.
    ImageRgba8 picture(bool with_interface);

    const Viewer& viewer() const { return *viewer_; }

  private:
    void wait_for_samples(const RecordedFrame& frame);
    void take_loads(const RecordedFrame& frame);
    bool pause();

    const Recording& recording_;
    double now_s_ = 0;
    std::function<bool()> between_;
    bool stopped_ = false;
    OsmesaContext context_;
    std::unique_ptr<Viewer> viewer_;
};

}  // namespace candela
