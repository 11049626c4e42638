// SPDX-License-Identifier: MIT
// A tree over the lights that have a place: from the root down, one of four branches is taken, each with about the
// share of light that it may send to the receiver (Conty Estévez and Kulla 2018, "Importance Sampling of Many Lights
// with Adaptive Tree Splitting", without the splitting). Four, since vector units weigh them in the time of one.
#pragma once

#include <span>
#include <vector>

#include "renderer/math/bounds.h"
#include "renderer/math/float4.h"
#include "renderer/math/math.h"

namespace candela {

// Where light is wanted. Directions below the normal count only where the surface transmits; without a normal all do.
struct LightReceiver {
    Vec3 position{0};
    Vec3 normal{0};  // unit, or zero
    bool both_sides = false;
};

// Bounds of one light, or of many: where it is, which way its surfaces look, and how far from there it still shines.
struct LightBounds {
    Bounds3 box;
    Vec3 axis{0, 0, 1};      // unit
    float cos_normals = 1;   // of the cone around the axis that holds all normals
    float cos_emission = 0;  // of the angle from a normal at which the light ends
    float intensity = 0;     // W/sr along the normal: of a surface, radiance times area
    bool two_sided = false;  // shines as well against its normals
};

class LightTree {
  public:
    struct Choice {
        uint32_t index = 0;
        float probability = 0;  // 0: none, as no light shines there
    };

    LightTree() = default;
    // Lights of no intensity are never chosen.
    explicit LightTree(std::span<const LightBounds> lights);

    bool empty() const { return nodes_.empty(); }

    // u in [0,1).
    Choice sample(const LightReceiver& receiver, float u) const noexcept;
    // With which sample() chooses the light of that index for the same receiver.
    float probability(uint32_t index, const LightReceiver& receiver) const noexcept;

  private:
    static constexpr uint32_t width = 4;
    static constexpr uint32_t bits_per_level = 2;

    // Bounds of the branches, side by side. A branch without light is never taken.
    struct Node {
        Float4 center[3] = {};
        Float4 radius_squared = {};  // of the sphere around the box
        Float4 axis[3] = {};
        Float4 cos_normals = {};
        Float4 sin_normals = {};
        Float4 cos_emission = {};
        Float4 intensity = {};
        Float4 two_sided = {};       // 1 or 0
        uint32_t child[width] = {};  // index of a node, or of a light
        uint8_t is_light[width] = {};
    };
    struct Build;

    // About what each branch may send to the receiver.
    static Float4 weigh(const Node& node, const LightReceiver& receiver) noexcept;

    std::vector<Node> nodes_;
    // By light: the way from the root, two bits for each branch taken, the first lowest; and whether there is one.
    std::vector<uint64_t> ways_;
    std::vector<uint8_t> reachable_;
};

}  // namespace candela
