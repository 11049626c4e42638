// SPDX-License-Identifier: MIT
// Discrete and piecewise-constant distributions. Weights are non-negative and finite; a distribution whose weights are
// all 0 is uniform.
#pragma once

#include <span>
#include <vector>

#include "renderer/math/math.h"

namespace candela {

// Walker's alias method, built by Vose's algorithm: O(1) choice. Empty tables have size 0 and must not be sampled.
class AliasTable {
  public:
    struct Choice {
        uint32_t index = 0;
        float probability = 0;
        float u_remapped = 0;  // the number u uniform again in [0,1)
    };

    AliasTable() = default;
    explicit AliasTable(std::span<const float> weights);

    size_t size() const { return entries_.size(); }
    Choice sample(float u) const noexcept;
    float probability(uint32_t index) const noexcept { return entries_[index].probability; }

  private:
    struct Entry {
        float threshold = 1;
        uint32_t alias = 0;
        float probability = 0;
    };
    std::vector<Entry> entries_;
};

// Piecewise constant over the cells of a width × height grid on [0,1)².
class Distribution2D {
  public:
    Distribution2D() = default;
    // weights: rows from v = 0, width · height of them.
    Distribution2D(std::span<const float> weights, int width, int height);

    // Returns the point; pdf per unit area of [0,1)².
    Vec2 sample(const Vec2& u, float& pdf) const noexcept;
    float pdf(const Vec2& point) const noexcept;

  private:
    int width_ = 0, height_ = 0;
    std::vector<float> row_cdf_;   // height + 1 entries, 0 … 1
    std::vector<float> cell_cdf_;  // height · (width + 1) entries
};

}  // namespace candela
