// SPDX-License-Identifier: MIT
// Path reuse (Bekaert, Sbert and Halton 2002, "Accelerating Path Tracing by Re-Using Paths"): the first vertices of a
// group of neighbouring pixels are all connected to the second vertices of each other's paths, or to the environment
// where those ended. What comes from there is traced once and serves the whole group, weighted by the balance heuristic
// over all paths of the group that could have come there. Unbiased. Light samples of the first vertex, and lamps that
// its directions run into, stay a path's own.
#pragma once

#include <array>
#include <span>

#include "renderer/bsdf/stack.h"
#include "renderer/integrator/integrator.h"

namespace candela {

struct SurfacePoint;

// A vertex of a path, as it is needed to scatter light there anew.
struct PathVertex {
    Vec3 position{0}, geometric_normal{0, 0, 1};  // the normal is on the side of wo
    float error_m = 0;
    OrthonormalFrame shading;
    Bsdf bsdf;
};

// Emission that a path ran into, and with which pdf a light sample would have chosen that direction.
struct FoundLight {
    Vec3 radiance{0};
    float light_pdf = 0;
};

// What the others of a group may know of a path.
struct ReusablePath {
    // Set where the path scatters first on a surface that is seen from one side, in no body: it can be connected to the
    // second vertices of others.
    bool has_first = false;
    PathVertex first;
    BsdfStack first_stack;
    Vec3 first_wo{0, 0, 1};  // local

    // Set where its next segment ended on a surface that looks the same for others.
    bool has_second = false;
    PathVertex second;
    // A light sample there: the radiance that arrives over its pdf, and its direction, local.
    Vec3 light{0}, light_wi{0, 0, 1};
    float light_pdf = 0;
    bool light_is_delta = false;
    // Or set where it ended in the environment instead, along that direction; found is what shines there.
    bool escapes = false;
    Vec3 escape_direction{0, 0, 1};
    // Where it went on from the second vertex, local, and what came back along that direction: emission of the next
    // surface, or of several where it passed clear glass, and all light of later vertices.
    bool goes_on = false;
    Vec3 onward_wi{0, 0, 1};
    std::array<FoundLight, 4> found;
    uint32_t found_count = 0;
    Vec3 later{0};

    // Radiance of the path that is not shared.
    Vec3 own{0};

    void clear() {
        has_first = has_second = escapes = goes_on = false;
        light = later = own = Vec3(0);
        found_count = 0;
    }
};

// Groups are lattices of reuse_columns by reuse_rows pixels of one sample index, within tiles of reuse_tile² pixels.
// They leave out every second pixel each way: neighbours of one group would share their noise, and the eye would see
// spots. The same pixels share at every index, so that each group has the whole of its pixels' low-discrepancy
// sequences. A call of a driver must hold all pixels of a tile that are to share, or it forms smaller groups.
inline constexpr uint32_t reuse_tile = 16;
inline constexpr uint32_t reuse_columns = 4, reuse_rows = 2;
inline constexpr size_t max_reuse_group = size_t{reuse_columns} * reuse_rows;

// Which group of its tile a pixel belongs to, below reuse_tile².
uint32_t reuse_group(uint32_t x, uint32_t y) noexcept;

// The samples of a call by groups: members[first[g]] up to members[first[g + 1] - 1] are the positions in `samples` of
// group g's. Samples that do not share are left out.
struct ReuseGroups {
    std::array<uint16_t, max_batch> members;
    std::array<uint16_t, max_batch + 1> first;
    size_t count = 0;

    void form(std::span<const PixelSample> samples) noexcept;
    std::span<const uint16_t> group(size_t g) const {
        return std::span(members).subspan(first[g], size_t{first[g + 1]} - first[g]);
    }
};

// Adds to the radiance of each path of a group, out[members[i]], the light that reaches its first vertex from the
// second vertices of all of them, its own included. paths and out are indexed by members.
void reuse_paths(const World& world, const IntegratorSettings& settings, std::span<const uint16_t> members,
                 std::span<const ReusablePath> paths, std::span<RadianceSample> out, RayCounts& counts) noexcept;

}  // namespace candela
