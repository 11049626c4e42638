// SPDX-License-Identifier: MIT
// Radiance samples: one pixel sample is a pure function of (World, Camera, settings, pixel, sample index), and of the
// samples that share their paths with it. Two drivers compute it: the scalar one is the readable algorithm and the
// oracle of the batched one.
#pragma once

#include <atomic>
#include <span>

#include "renderer/integrator/settings.h"
#include "renderer/scene/camera.h"
#include "renderer/world/world.h"

namespace candela {

struct RayCounts {
    uint64_t camera = 0;
    uint64_t bounce = 0;
    uint64_t shadow = 0;

    uint64_t total() const { return camera + bounce + shadow; }
    RayCounts& operator+=(const RayCounts& o) {
        camera += o.camera;
        bounce += o.bounce;
        shadow += o.shadow;
        return *this;
    }
};

struct View {
    Camera camera;
    Vec2u extent{1};  // picture size in pixels

    bool operator==(const View&) const = default;
};

// Whether a sample shares its path with neighbours that are traced in the same call (path_reuse.h). alone: it is made
// as if it did, but has no neighbours; for comparing.
enum class PathSharing : uint8_t { none, alone, group };

struct PixelSample {
    uint16_t x = 0, y = 0;
    uint32_t index = 0;
    PathSharing sharing = PathSharing::none;
};

struct RadianceSample {
    Vec3 radiance{0};  // may be non-finite when something went wrong: the film counts it
    float alpha = 1;
    uint32_t segments = 0;       // camera and bounce rays that it took
    uint32_t shadow_rays = 0;    // and connections to lights, or to what other paths found
    uint32_t shared_with = 0;    // how often a vertex of another path was weighed, connected to it or not
    float shared_luminance = 0;  // the part of radiance that can be shared, of a sample that does
};

// The scalar driver: one path from start to end, that shares with no other.
RadianceSample trace_sample(const World& world, const View& view, const IntegratorSettings& settings,
                            PixelSample sample, RayCounts& counts) noexcept;

// The same for samples that may share their paths; at most max_batch per call.
inline constexpr size_t max_batch = 256;
void trace_samples(const World& world, const View& view, const IntegratorSettings& settings,
                   std::span<const PixelSample> samples, std::span<RadianceSample> out, RayCounts& counts) noexcept;

// The batched driver: fills out[i] for samples[i], bit for bit what trace_samples gives. Looks at *cancel (may be null)
// between steps and returns false, with out undefined, once *cancel != cancel_expected.
bool trace_batch(const World& world, const View& view, const IntegratorSettings& settings,
                 std::span<const PixelSample> samples, std::span<RadianceSample> out, RayCounts& counts,
                 const std::atomic<uint64_t>* cancel = nullptr, uint64_t cancel_expected = 0) noexcept;

}  // namespace candela
