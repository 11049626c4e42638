// SPDX-License-Identifier: MIT
#include "app/viewer/playback.h"

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

constexpr double usual_step_s = 1.0 / 24.0;
constexpr double shortest_step_s = 1.0 / 60.5, longest_step_s = 1.0 / 11.5;
// Times in files are single precision, and often rounded to milliseconds.
constexpr double same_step = 0.05;

}  // namespace

double frame_step_s(const Animation& animation) {
    // The channel with most keys tells.
    const std::vector<float>* times = nullptr;
    for (const AnimationChannel& channel : animation.channels) {
        if (times == nullptr || channel.sampler.times_s->size() > times->size()) times = channel.sampler.times_s.get();
    }
    if (times == nullptr || times->size() < 3) return usual_step_s;
    const auto intervals = static_cast<double>(times->size() - 1);
    const double step = (static_cast<double>(times->back()) - static_cast<double>(times->front())) / intervals;
    if (step < shortest_step_s || step > longest_step_s) return usual_step_s;
    for (size_t i = 1; i < times->size(); ++i) {
        const double gap = static_cast<double>((*times)[i]) - static_cast<double>((*times)[i - 1]);
        if (std::abs(gap - step) > same_step * step) return usual_step_s;
    }
    return step;
}

double advance(double time_s, double dt_s, double duration_s) {
    if (!(duration_s > 0)) return 0;
    const double later = std::fmod(time_s + dt_s, duration_s);
    return later < 0 ? later + duration_s : later;
}

double frame_at(double time_s, double step_s, double duration_s) {
    // A time that is a frame's up to rounding is that frame's.
    return std::clamp(std::floor(time_s / step_s + 1e-6) * step_s, 0.0, std::max(duration_s, 0.0));
}

double step_frames(double time_s, int frames, double step_s, double duration_s) {
    const double count = std::floor(std::max(duration_s, 0.0) / step_s + 1e-6) + 1;
    // Back from between two frames is to the one that is on.
    const double now = time_s / step_s;
    const double on = frames < 0 ? std::ceil(now - 1e-6) : std::floor(now + 1e-6);
    const double next = std::fmod(on + frames, count);
    return std::min((next < 0 ? next + count : next) * step_s, std::max(duration_s, 0.0));
}

}  // namespace candela
