// SPDX-License-Identifier: MIT
// Writes numbered pictures beside the window: a turn around the scene, or its animation. The window stays as it is.
#pragma once

#include "app/render_job.h"
#include "app/viewer/background_task.h"

namespace candela {

enum class SequenceKind : uint8_t { turntable, animation };

// What the panel asks for.
struct SequenceSettings {
    SequenceKind kind = SequenceKind::turntable;
    uint32_t pictures = 36;  // of a turn
    double fps = 24;         // of an animation: picture k shows the time k / fps
    uint32_t spp = 64;
};

class FrameWriter {
  public:
    struct Order {
        SequenceSettings settings;
        RenderJob job;          // as it is shown: with its edits, and its request
        RenderOptions options;  // of the job, its tone that of the display
        Vec3 pivot{0};          // of a turn
        uint32_t animation = 0;
        uint32_t count = 0;               // of pictures
        std::vector<Vec3> light_weights;  // of its light groups
        std::string path;                 // of which each picture's is numbered
    };
    // What there was to say at the end: a line.
    struct Outcome {
        std::string words;
        bool failed = false;
    };

    void start(Order order);
    // Those that are complete stay.
    void stop() { task_.cancel(); }
    bool busy() const { return task_.busy(); }
    uint32_t written() const { return written_; }
    uint32_t count() const { return count_; }
    std::optional<Outcome> take() { return task_.take(); }

  private:
    std::optional<Outcome> write(Order order, const std::atomic<bool>* cancel);

    std::atomic<uint32_t> written_{0};
    uint32_t count_ = 0;
    BackgroundTask<Outcome> task_;
};

// How many pictures that is for an animation of that length.
uint32_t picture_count(const SequenceSettings& settings, double duration_s);
// NAME-turn-001.png, or another number: one of which no picture is there yet.
std::string free_sequence_path(const std::string& scene_path, SequenceKind kind);

}  // namespace candela
