// SPDX-License-Identifier: MIT
// All light that does not come from scattering: punctual lights, emissive triangles, the environment; and the sampler
// that picks one of them. Directions point from the receiver to the light; pdfs are per solid angle at the receiver.
#pragma once

#include <memory>
#include <vector>

#include "renderer/lights/environment_light.h"
#include "renderer/lights/light_tree.h"
#include "renderer/math/bounds.h"
#include "renderer/math/math.h"
#include "renderer/sampling/distribution.h"
#include "renderer/scene/scene.h"

namespace candela {

// A triangle of an emissive surface, in world space, or one of the equal cells that a triangle of uneven emission is
// cut into, so that choosing a cell by its power follows the texture.
struct EmissiveTriangle {
    Vec3 p0, edge1, edge2;
    // (u, v) of the cell are corner + scale · (u, v) in the whole triangle; scale is negative for cells upside down.
    Vec2 corner{0};
    float scale = 1;
    uint32_t surface = 0;     // World's placed primitive
    uint32_t triangle = 0;    // index in its primitive
    float mean_radiance = 0;  // mean luminance of the emission over the cell
    bool two_sided = false;
    // Set by finish_lights: the unit normal, and twice the area (0: never sampled).
    Vec3 normal{0};
    float doubled_area = 0;
};

// The cells of one triangle: cells_per_edge² entries of Lights::triangles. Row i of cells along the first edge comes
// before row i + 1; in a row upright cells and those upside down alternate.
struct EmissiveCells {
    uint32_t first = 0;
    uint32_t cells_per_edge = 1;

    // Of the cell at (u, v) of the triangle.
    uint32_t index_at(float u, float v) const;
};

// A punctual light placed in the world.
struct PlacedLight {
    LightKind kind = LightKind::point;
    Vec3 position{0};
    Vec3 direction{0, 0, -1};  // where a spot or directional light shines to
    Vec3 intensity{1};         // W/sr; perpendicular irradiance W/m² for directional lights
    float cos_inner = 1, cos_outer = 0;
};

struct LightSample {
    Vec3 wi{0};
    float distance = 0;  // infinity for environment and directional lights
    // L / pdf. For an emissive triangle L is not known here: weight is 1 / pdf, and the caller multiplies by the
    // emission found at (surface, triangle, u, v).
    Vec3 weight{0};
    float pdf = 0;  // 0: no sample. Per solid angle, choice included; the probability of the choice for delta lights
    bool is_delta = false;
    uint32_t surface = 0xffffffffu;  // set for emissive triangles
    uint32_t triangle = 0;
    float u = 0, v = 0;               // in the whole triangle
    uint32_t emissive = 0;            // index in Lights::triangles
    uint32_t punctual = 0xffffffffu;  // index in Lights::punctual, set for those
};

struct Lights {
    std::vector<PlacedLight> punctual;
    std::vector<EmissiveTriangle> triangles;
    std::vector<EmissiveCells> cells;  // by emissive surface and its triangles, as Surface::first_emissive says
    std::shared_ptr<const EnvironmentLight> environment;  // null: black

    // How one is chosen: first between the environment, the directional lights and all that have a place; then among
    // the directional ones by irradiance, or down the tree over [punctual…, triangles…].
    // The environment has two: by LightCoverage.
    float environment_probability[2] = {};
    float directional_probability = 0;  // where it is not the environment
    AliasTable directional;             // over the punctual lights
    std::shared_ptr<const LightTree> placed;

    bool empty() const { return punctual.empty() && triangles.empty() && !environment; }
};

// Which part of all directions light samples have to cover. complete: all that shines. beside_directions: where BSDF
// samples find light as well, what the environment shines everywhere alike is left to them, and light samples go to
// what stands out (Karlík et al. 2019, "MIS Compensation").
enum class LightCoverage : uint8_t { complete, beside_directions };

// Fills the choosing part from the lists. scene_bounds sets the reach of directional lights and environment for
// comparing powers.
void finish_lights(Lights& lights, const Bounds3& scene_bounds);
// The same after a change of the environment alone: the tree stays.
void weigh_lights(Lights& lights, const Bounds3& scene_bounds);

// Chooses a light with u_pick and a point or direction on it with u, seen from the receiver.
LightSample sample_light(const Lights& lights, const LightReceiver& receiver, LightCoverage coverage, float u_pick,
                         const Vec2& u) noexcept;

// The pdf with which sample_light, for the same receiver and coverage, finds the emissive cell (index in
// Lights::triangles) along the unit direction wi at that distance; 0 where it would not (back of a one-sided emitter).
float triangle_light_pdf(const Lights& lights, uint32_t emissive_index, const LightReceiver& receiver,
                         LightCoverage coverage, const Vec3& wi, float distance) noexcept;
// The same for a ray that leaves the scene.
float environment_light_pdf(const Lights& lights, LightCoverage coverage, const Vec3& wi) noexcept;

}  // namespace candela
