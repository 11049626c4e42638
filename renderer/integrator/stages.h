// SPDX-License-Identifier: MIT
// The steps of one path. Each is a total function over one path; a driver calls them in the order
// begin, (extend, draw, shade, connect)*, finish — for one path after the other or for a batch of paths step by step.
#pragma once

#include "renderer/integrator/path_reuse.h"
#include "renderer/integrator/path_state.h"
#include "renderer/integrator/vertex_record.h"

namespace candela {

// The camera ray of a pixel sample.
PathState begin_path(const View& view, const IntegratorSettings& settings, PixelSample sample) noexcept;

// Follows path.ray to the nearest surface.
Hit extend(const World& world, const PathState& path, RayCounts& counts) noexcept;

// The random numbers of the vertex at the end of the segment, at fixed dimensions of the path's sequence: first what
// matters most.
struct VertexPoints {
    static constexpr size_t pairs = 4;

    Vec2 direction;
    float lobe_choice = 0, light_choice = 0;
    Vec2 light;
    float roulette = 0, wavelength = 0;
};

// Sets the path's sampler to the first of them.
void start_vertex(PathState& path) noexcept;
VertexPoints draw_vertex(PathState& path) noexcept;
// The same from what a PointBatch drew for the path's sampler.
VertexPoints vertex_points(const PointBatch& batch, size_t i) noexcept;

// At the end of the segment: gathers emission, plans a light connection, draws the next direction or ends the path.
// reuse: where to put what others may share of the path; null: nobody shares it.
ShadowRequest shade(const World& world, const IntegratorSettings& settings, const Hit& hit, const VertexPoints& u,
                    PathState& path, ReusablePath* reuse) noexcept;
// The same to the bit for a path that nobody shares, and what was decided.
ShadowRequest shade_recorded(const World& world, const IntegratorSettings& settings, const Hit& hit,
                             const VertexPoints& u, PathState& path, VertexRecord& record) noexcept;

// Adds the planned light if it comes through.
void connect(const World& world, const ShadowRequest& request, PathState& path, ReusablePath* reuse,
             RayCounts& counts) noexcept;

// What the path itself has gathered; with what is shared, reuse is complete.
RadianceSample finish(const PathState& path, ReusablePath* reuse) noexcept;

}  // namespace candela
