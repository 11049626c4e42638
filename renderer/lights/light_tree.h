// SPDX-License-Identifier: MIT
// A binary tree over the lights that have a place: from the root down, each branch is taken with about the share of
// light that it may send to the receiver (Conty Estévez and Kulla 2018, "Importance Sampling of Many Lights with
// Adaptive Tree Splitting", without the splitting).
#pragma once

#include <span>
#include <vector>

#include "renderer/math/bounds.h"
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
    // Inner nodes hold the index of their second child, the first follows them; leaves the index of their light.
    struct Node {
        Vec3 center{0};
        float radius_squared = 0;  // of the sphere around the box
        Vec3 axis{0, 0, 1};
        float cos_normals = 1;
        float cos_emission = 0;
        float sin_normals = 0;
        float intensity = 0;
        uint32_t child_or_light = 0;
        bool is_leaf = false;
        bool two_sided = false;
    };
    struct Build;

    static float importance(const Node& node, const LightReceiver& receiver) noexcept;

    std::vector<Node> nodes_;
    // By light: the way from the root, lowest bit first, 1 for a second child; and whether there is one.
    std::vector<uint64_t> ways_;
    std::vector<uint8_t> reachable_;
};

}  // namespace candela
