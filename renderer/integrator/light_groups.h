// SPDX-License-Identifier: MIT
// Radiance kept apart by where its light comes from, so that lights can be made brighter, dimmer or of another colour
// after the samples were traced.
#pragma once

#include <memory>
#include <string>

#include "renderer/integrator/integrator.h"

namespace candela {

inline constexpr size_t most_light_groups = 9;

// The environment, lamps and emissive materials of a world; the last group is what is left of them, unlit surfaces and
// a background of a colour.
struct LightGroups {
    std::vector<std::string> names;
    uint8_t environment = 0;           // its group
    std::vector<uint8_t> of_punctual;  // by index in Lights::punctual
    std::vector<uint8_t> of_material;  // by index in World::materials

    size_t size() const { return names.size(); }
    uint8_t rest() const { return static_cast<uint8_t>(names.size() - 1); }
};

// The environment and the most powerful others have groups of their own.
std::shared_ptr<const LightGroups> make_light_groups(const World& world);

// What trace_sample gives, to the bit, and how it divides among the groups: group_radiance has groups.size() values for
// each sample, whose sum is its radiance but for rounding. cancel: as for trace_batch.
bool trace_grouped(const World& world, const View& view, const IntegratorSettings& settings, const LightGroups& groups,
                   std::span<const PixelSample> samples, std::span<RadianceSample> out, std::span<Vec3> group_radiance,
                   RayCounts& counts, const std::atomic<uint64_t>* cancel = nullptr,
                   uint64_t cancel_expected = 0) noexcept;

}  // namespace candela
