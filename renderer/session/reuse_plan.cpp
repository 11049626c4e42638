// SPDX-License-Identifier: MIT
#include "renderer/session/reuse_plan.h"

#include <algorithm>
#include <cmath>

#include "renderer/integrator/path_reuse.h"

namespace candela {

namespace {

// Samples 0 and 1 are made alone, 2 and 3 in groups.
constexpr uint32_t first_shared_trial = 2;

// A segment brings a surface to be shaded, a ray to a light or a vertex only an answer; to weigh a vertex takes time
// even where no ray has to be sent.
constexpr double cost_of_segment = 2, cost_of_connection = 1, cost_of_weighing = 0.4;

// Two samples do not show how much better many fill their strata alone than in groups: sharing has to win clearly.
constexpr double required_gain = 0.8;

// Neighbouring tiles are heard too: the noise of one alone may be a single bright sample.
constexpr uint32_t reach = 1;

}  // namespace

ReusePlan::ReusePlan(Vec2u extent)
    : extent_(extent),
      tiles_((extent + reuse_tile - 1u) / reuse_tile),
      before_(size_t{extent.x} * extent.y),
      shares_(size_t{tiles_.x} * tiles_.y) {
    for (std::vector<Trial>& each : trials_)
        each.resize(shares_.size());
}

PathSharing ReusePlan::sharing(uint32_t index, uint32_t tile) const {
    if (shares_.empty()) return PathSharing::none;
    if (index < first_planned) return index < first_shared_trial ? PathSharing::alone : PathSharing::group;
    return shares_[tile] != 0 ? PathSharing::group : PathSharing::none;
}

void ReusePlan::note(uint32_t tile, std::span<const PixelSample> samples, std::span<const RadianceSample> traced) {
    if (shares_.empty() || samples.empty()) return;
    const uint32_t index = samples[0].index;
    if (index >= first_planned) return;
    // Sample 0 comes in lattices of its own tiles: only its value is kept.
    const bool is_second = index % 2 == 1;
    Trial& trial = trials_[index >= first_shared_trial ? 1 : 0][is_second ? tile : 0];
    for (size_t i = 0; i < samples.size(); ++i) {
        const RadianceSample& sample = traced[i];
        float& before = before_[size_t{samples[i].y} * extent_.x + samples[i].x];
        const float now = sample.shared_luminance;
        if (is_second) {
            trial.cost += cost_of_segment * sample.segments + cost_of_connection * sample.shadow_rays +
                          cost_of_weighing * sample.shared_with;
            const double noise = static_cast<double>(sqr(now - before));
            if (std::isfinite(noise)) trial.noise += noise;
        }
        before = now;
    }
}

void ReusePlan::decide() {
    for (uint32_t y = 0; y < tiles_.y; ++y) {
        for (uint32_t x = 0; x < tiles_.x; ++x) {
            double noise_times_cost[2];
            for (int k = 0; k < 2; ++k) {
                Trial sum;
                for (uint32_t v = y - std::min(y, reach); v <= std::min(y + reach, tiles_.y - 1); ++v) {
                    for (uint32_t u = x - std::min(x, reach); u <= std::min(x + reach, tiles_.x - 1); ++u) {
                        const Trial& trial = trials_[k][size_t{v} * tiles_.x + u];
                        sum.noise += trial.noise;
                        sum.cost += trial.cost;
                    }
                }
                noise_times_cost[k] = sum.noise * sum.cost;
            }
            shares_[size_t{y} * tiles_.x + x] = noise_times_cost[1] < required_gain * noise_times_cost[0] ? 1 : 0;
        }
    }
    before_ = {};
    trials_ = {};
}

}  // namespace candela
